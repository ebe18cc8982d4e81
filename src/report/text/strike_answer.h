#pragma once

#include "subimpact/report/text.h"

namespace subimpact {

/// What struck what, and how far the run went.
Answer strike_answer(const Case& input, const Result& result);

}  // namespace subimpact
