#pragma once

namespace fathom {

/// Whether the processor has fused multiply-adds.
inline bool processor_has_fma() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("fma") != 0;
#elif defined(__FP_FAST_FMA)
  return true;
#else
  return false;
#endif
}

}  // namespace fathom

/// Compiles a function, and everything that it calls, with fused multiply-adds (where std::fma is
/// written: nothing is contracted): the build may not use the instruction everywhere, so that it is
/// allowed function by function. Only to be called where processor_has_fma(), or it is slow.
#if defined(__x86_64__)
#define FATHOM_WITH_FMA [[gnu::target("fma"), gnu::flatten]]
#else
#define FATHOM_WITH_FMA [[gnu::flatten]]
#endif
