#pragma once

#include "io/csv_columns.h"
#include "subimpact/simulate/result.h"

namespace subimpact {

// The columns of the tables that a run leaves.
const Columns<SubImpact>& events_columns();
/// The same with `decided` of this result.
Columns<SubImpact> events_columns(const Result& result);
const Columns<Transition>& transitions_columns();
const Columns<HistoryRow>& history_columns();
const Columns<SectionRow>& sections_columns();
const Columns<PointRow>& points_columns();
const Columns<ShapeRow>& shapes_columns();
const Columns<EnvelopeRow>& envelope_columns();

}  // namespace subimpact
