#pragma once

#include "io/csv_columns.h"
#include "subimpact/simulate/result.h"

namespace subimpact {

// The columns of the tables that a run leaves.
const Columns<SubImpact>& events_columns();
const Columns<Transition>& transitions_columns();
const Columns<HistoryRow>& history_columns();
const Columns<SectionRow>& sections_columns();

}  // namespace subimpact
