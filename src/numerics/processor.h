#pragma once

namespace subimpact {

/// Whether this processor has the vector instructions that the library was compiled for, where
/// these are AVX2 and FMA (CMake: SUBIMPACT_BASELINE=x86-64-v3): without them it would end by a
/// signal.
inline bool is_processor_sufficient() {
#if defined(__AVX2__) && defined(__FMA__)
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return true;
#endif
}

inline constexpr const char* insufficient_processor =
    "subimpact: this processor lacks AVX2 or FMA, for which this build was compiled; build it from "
    "source with `cmake --preset release`\n";

}  // namespace subimpact
