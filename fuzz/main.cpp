#include "targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  subimpact::fuzz::SUBIMPACT_FUZZ_TARGET({data, size});
  return 0;
}
