#pragma once

#include "subimpact/case/case.h"
#include "subimpact/simulate/result.h"

namespace subimpact::python {

/// A run that ended, and the case that it was of, with every choice made.
struct Finished {
  Case input;
  Result result;
  bool interrupted = false;  ///< by Ctrl-C
  bool timed_out = false;
};

}  // namespace subimpact::python
