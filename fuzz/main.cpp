#include "targets.h"

// Options of the sanitizers that cost no finding. A long stack of every allocation, and 256 MB of
// freed memory, would take most of the time of a small input.
extern "C" const char* __asan_default_options() {
  return "malloc_context_size=4:quarantine_size_mb=8:check_initialization_order=0";
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  subimpact::fuzz::SUBIMPACT_FUZZ_TARGET({data, size});
  return 0;
}
