#pragma once

#include <cfenv>
#include <cfloat>
#include <limits>

// Proofs and roundings rely on unmodified IEEE 754: every operation is rounded once to its type.
#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || \
    defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || defined(__NO_SIGNED_ZEROS__)
#error "fathom is exact only in IEEE 754 arithmetic: compile it without -ffast-math and its parts"
#endif

namespace fathom {

static_assert(std::numeric_limits<double>::is_iec559 && std::numeric_limits<float>::is_iec559);
static_assert(FLT_EVAL_METHOD == 0, "intermediate results must not have excess precision");

/// During its lifetime, its thread computes in the floating-point environment of IEEE 754: rounding
/// to nearest, subnormal numbers kept, no traps. The destructor restores the previous environment
/// with its flags. Every entry point creates an object of this class, and so does every worker
/// thread, because the calling program may flush subnormals to zero or round upwards.
class StandardArithmetic {
 public:
  StandardArithmetic() {
    std::fegetenv(&before_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~StandardArithmetic() { std::fesetenv(&before_); }
  StandardArithmetic(const StandardArithmetic&) = delete;
  StandardArithmetic& operator=(const StandardArithmetic&) = delete;

 private:
  std::fenv_t before_{};
};

/// Half the distance from 1 to the next number, 2⁻⁵³ for binary64 and 2⁻²⁴ for binary32: the
/// relative error of one rounding to nearest whose result is a normal number.
template <class Real>
inline constexpr double unit_roundoff = static_cast<double>(std::numeric_limits<Real>::epsilon()) /
                                        2;

}  // namespace fathom
