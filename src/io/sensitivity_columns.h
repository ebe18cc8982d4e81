#pragma once

#include <string>
#include <vector>

#include "io/csv_columns.h"
#include "subimpact/study/sensitivity.h"

namespace subimpact {

/// The columns of sensitivity.csv of a study by these keys.
Columns<SensitivityRow> sensitivity_columns(const std::vector<std::string>& keys);

}  // namespace subimpact
