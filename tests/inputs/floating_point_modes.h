#pragma once

#include <gtest/gtest.h>

#include <cfenv>
#include <iterator>
#include <random>
#if defined(__SSE__)
#include <xmmintrin.h>
#endif

/// What programs around us may have done to the floating-point environment of a thread.
namespace fathom::checks {

/// How a thread rounds, and whether it takes subnormal numbers, as operands or results, for 0.
struct FloatingPointMode {
  const char* name;
  int rounding;
  bool flush;
};
inline constexpr FloatingPointMode other_modes[] = {
    {"subnormals are flushed to zero", FE_TONEAREST, true},
    {"rounds upwards", FE_UPWARD, false},
    {"rounds downwards", FE_DOWNWARD, false},
    {"rounds towards zero, flushes", FE_TOWARDZERO, true}};

/// One of them, or null for the standard one.
inline const FloatingPointMode* any_mode(std::mt19937_64& random) {
  return random() % 3 == 0 ? &other_modes[random() % std::size(other_modes)] : nullptr;
}

/// While one lives, its thread computes in the mode; null: as before.
class InMode {
 public:
  explicit InMode(const FloatingPointMode& mode) : InMode(&mode) {}
  explicit InMode(const FloatingPointMode* mode) {
    std::fegetenv(&before_);
    if (!mode) return;
    std::fesetround(mode->rounding);
#if defined(__SSE__)
    if (mode->flush) _mm_setcsr(_mm_getcsr() | 0x8040);
#endif
  }
  ~InMode() {
    std::fesetenv(&before_);
  }
  InMode(const InMode&) = delete;
  InMode& operator=(const InMode&) = delete;

 private:
  std::fenv_t before_{};
};

/// The mode of this thread, whatever exceptions have been raised.
inline unsigned current_mode() {
#if defined(__SSE__)
  return _mm_getcsr() & ~0x3FU;
#else
  return static_cast<unsigned>(std::fegetround());
#endif
}

/// What `compute` returns, numbers that can be compared, is the same in all modes, which it leaves
/// as they were. Compared out of the mode, in which subnormal numbers may equal 0.
template <class Compute>
void expect_same_in_all_modes(const Compute& compute) {
  const auto truth = compute();
  for (const FloatingPointMode& mode : other_modes) {
    SCOPED_TRACE(mode.name);
    auto found = truth;
    {
      const InMode here(mode);
      const unsigned before = current_mode();
      found = compute();
      EXPECT_EQ(current_mode(), before);
    }
    EXPECT_TRUE(found == truth);  // what has been computed may be long, and nothing to be read
  }
}

}  // namespace fathom::checks
