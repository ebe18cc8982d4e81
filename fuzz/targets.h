#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

/// What the fuzzers run, each on any bytes: returns, or ends the process with a finding. Refusals
/// are no findings. The tests run the same functions on the corpus.
namespace subimpact::fuzz {

using Bytes = std::span<const std::uint8_t>;

/// A case file; after a zero byte a setting of --set, and so on.
void case_text(Bytes bytes);

/// A case whose values come from tables of extreme ones: `explain`, then a run of a few steps.
void structured_case(Bytes bytes);

}  // namespace subimpact::fuzz
