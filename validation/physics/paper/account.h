#pragma once

/// What both cases of the struck-beam paper are judged by.

#include <string>

#include "outcome.h"
#include "subimpact/simulate/result.h"

namespace subimpact::validation {

/// The paper's statements about energies, as rows.
void add_energies(Outcome& outcome, const Result& result);

/// A table of counts and times: the paper's, then a row per run.
std::string runs_head();
std::string runs_row(const std::string& name, const Result& result);

}  // namespace subimpact::validation
