#pragma once

#include <string_view>

#include "subimpact/simulate/result.h"
#include "subimpact/study/event_errors.h"

namespace subimpact {

/// The verdict on a run compared with a reference.
enum class Verdict {
  right,        ///< completed, and every sub-impact corresponds
  wrong_count,  ///< completed, but sub-impacts are missing, merged or invented
  inaccurate,   ///< ended by one of its own checks, and the outcome reports it
  unstable,     ///< the solution grew without bound, and the outcome reports it
  failed,       ///< the solver could not continue, and the outcome reports it
  refused,      ///< the setting was not accepted
  not_run       ///< not run: it would have taken longer than allowed
};

/// "right", "wrong count", ...
std::string_view to_string(Verdict verdict);

/// The verdict on a run that was accepted.
Verdict judge(const Result& run, const EventErrors& errors);

}  // namespace subimpact
