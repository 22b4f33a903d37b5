// Double-words with bounds on their errors, several at once. Included once for every kind of vector
// instructions, by the files that foreach_target.h compiles for each.
//
// The operations of numeric/double_word.h, step by step, and so with its bounds, epsilon<Real>; the
// bounds on errors are as in numeric/certified_value.h, and roundings as in
// numeric/certified_rounding.h.
#if defined(FATHOM_FAST_DOUBLE_WORD_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FATHOM_FAST_DOUBLE_WORD_LANES_INL_H
#undef FATHOM_FAST_DOUBLE_WORD_LANES_INL_H
#else
#define FATHOM_FAST_DOUBLE_WORD_LANES_INL_H
#endif

#include <hwy/highway.h>

#include <limits>

#include "fathom/fast/lanes/lanes-inl.h"
#include "fathom/numeric/certified_rounding.h"
#include "fathom/numeric/certified_value.h"

HWY_BEFORE_NAMESPACE();
namespace fathom::fast::HWY_NAMESPACE {
namespace {

/// ε of double-words.
constexpr double wide_ulp = epsilon<DoubleWord<false>>;

struct WideLanes {
  V hi, lo;
};

HWY_INLINE WideLanes wide_constant(const WordPair& x) {
  return {constant(x.hi), constant(x.lo)};
}

HWY_INLINE WideLanes two_sum(V a, V b) {
  const V s = hn::Add(a, b);
  const V a_part = hn::Sub(s, b);
  const V b_part = hn::Sub(s, a_part);
  return {s, hn::Add(hn::Sub(a, a_part), hn::Sub(b, b_part))};
}

HWY_INLINE WideLanes fast_two_sum(V a, V b) {
  const V s = hn::Add(a, b);
  return {s, hn::Sub(b, hn::Sub(s, a))};
}

HWY_INLINE WideLanes split(V x) {
  const V c = hn::Add(hn::Mul(constant(0x1p27), x), x);
  const V high = hn::Sub(c, hn::Sub(c, x));
  return {high, hn::Sub(x, high)};
}

// MulSub is fused where the target has the instruction; elsewhere it rounds twice.
HWY_INLINE WideLanes two_product(V a, V b) {
  const V p = hn::Mul(a, b);
#if HWY_NATIVE_FMA
  return {p, hn::MulSub(a, b, p)};
#else
  const WideLanes x = split(a), y = split(b);
  const V rest =
      hn::Add(hn::Add(hn::Sub(hn::Mul(x.hi, y.hi), p), hn::Mul(x.hi, y.lo)), hn::Mul(x.lo, y.hi));
  return {p, hn::Add(rest, hn::Mul(x.lo, y.lo))};
#endif
}

HWY_INLINE WideLanes add(const WideLanes& x, const WideLanes& y) {
  const WideLanes s = two_sum(x.hi, y.hi);
  const WideLanes t = two_sum(x.lo, y.lo);
  const WideLanes v = fast_two_sum(s.hi, hn::Add(s.lo, t.hi));
  return fast_two_sum(v.hi, hn::Add(t.lo, v.lo));
}

HWY_INLINE WideLanes multiply(const WideLanes& x, V y) {
  const WideLanes c = two_product(x.hi, y);
  const WideLanes t = fast_two_sum(c.hi, hn::Mul(x.lo, y));
  return fast_two_sum(t.hi, hn::Add(t.lo, c.lo));
}

HWY_INLINE WideLanes multiply(const WideLanes& x, const WideLanes& y) {
  const WideLanes c = two_product(x.hi, y.hi);
  const V mixed = hn::Add(hn::Mul(x.hi, y.lo), hn::Mul(x.lo, y.hi));
  return fast_two_sum(c.hi, hn::Add(c.lo, mixed));
}

HWY_INLINE WideLanes divide(const WideLanes& x, const WideLanes& y) {
  const V t = hn::Div(x.hi, y.hi);
  const WideLanes r = multiply(y, t);
  const V rest = hn::Add(hn::Sub(x.hi, r.hi), hn::Sub(x.lo, r.lo));
  return fast_two_sum(t, hn::Div(rest, y.hi));
}

/// Of numbers from 1 on.
HWY_INLINE WideLanes square_root(const WideLanes& x) {
  const V r = hn::Sqrt(x.hi);
  const WideLanes square = two_product(r, r);
  const V d = hn::Add(hn::Sub(x.hi, square.hi), hn::Sub(x.lo, square.lo));
  return fast_two_sum(r, hn::Div(d, hn::Add(r, r)));
}

struct CertifiedWideLanes {
  WideLanes value;
  V error;
};

/// An error of +∞ means "unknown". If both errors are 0, the quotient must be exact.
HWY_INLINE CertifiedWideLanes quotient(const CertifiedWideLanes& x, const CertifiedWideLanes& y) {
  const V size = hn::Abs(y.value.hi), zero = constant(0);
  const M known =
      hn::And(hn::Gt(size, zero), hn::Le(y.error, hn::Mul(size, constant(quotient_condition))));
  const WideLanes value = divide(x.value, y.value);
  const V magnitude = hn::Abs(value.hi);
  const V of_operands =
      hn::Div(hn::Add(hn::MulAdd(magnitude, y.error, x.error), constant(most_underflow)), size);
  const V bound = hn::Mul(
      hn::Add(hn::MulAdd(constant(wide_ulp), magnitude, of_operands), constant(most_underflow)),
      constant(slack));
  const M is_exact = hn::Eq(hn::Add(x.error, y.error), zero);
  return {value, hn::IfThenElse(known, hn::IfThenZeroElse(is_exact, bound),
                                constant(std::numeric_limits<double>::infinity()))};
}

/// Of factors that are not 0.
HWY_INLINE CertifiedWideLanes product(const CertifiedWideLanes& x, const CertifiedWideLanes& y) {
  const WideLanes value = multiply(x.value, y.value);
  const V x_size = hn::Abs(x.value.hi), y_size = hn::Abs(y.value.hi);
  const V of_factors = hn::MulAdd(x_size, y.error, hn::Mul(hn::Add(y_size, y.error), x.error));
  const V of_rounding = hn::MulAdd(constant(wide_ulp), hn::Abs(value.hi), constant(most_underflow));
  return {value, hn::Mul(hn::Add(of_factors, of_rounding), constant(slack))};
}

HWY_INLINE M has_safe_size(V x) {
  const V size = hn::Abs(x);
  return hn::And(hn::Ge(size, constant(least_safe)), hn::Le(size, constant(greatest_safe)));
}

HWY_INLINE M is_exact_word(const WideLanes& x, V error) {
  const V zero = constant(0);
  return hn::And(hn::Eq(error, zero), hn::Eq(x.lo, zero));
}

/// The leading word, and whether the number is certainly rounded to it.
HWY_INLINE M rounds_to_leading_word(const WideLanes& x, V error) {
  const DU du;
  const V size = hn::Abs(x.hi);
  const V next = hn::BitCast(D(), hn::Sub(hn::BitCast(du, size), hn::Set(du, 1)));
  const V half_gap = hn::Mul(constant(0.5), hn::Sub(size, next));
  const V distance = hn::Mul(hn::Add(hn::Abs(x.lo), error), constant(distance_room));
  return hn::Or(is_exact_word(x, error), hn::And(has_safe_size(x.hi), hn::Lt(distance, half_gap)));
}

struct RoundedWideLanes {
  hn::Vec<D32> value;
  M settled;
};

HWY_INLINE RoundedWideLanes round_to_binary32(const WideLanes& x, V error) {
  const D d;
  const D32 d32;
  const hn::RebindToUnsigned<D32> du32;
  const auto candidate = to_binary32(hn::Add(x.hi, constant(0)));
  const auto size = hn::Abs(candidate);
  const auto next = hn::BitCast(d32, hn::Sub(hn::BitCast(du32, size), hn::Set(du32, 1)));
  const V half_gap =
      hn::Mul(constant(0.5), hn::Sub(hn::PromoteTo(d, size), hn::PromoteTo(d, next)));
  const V rest = hn::Add(hn::Sub(x.hi, hn::PromoteTo(d, candidate)), x.lo);
  const M near = hn::Lt(hn::MulAdd(hn::Abs(rest), constant(distance_room), error), half_gap);
  return {candidate, hn::Or(is_exact_word(x, error), hn::And(has_safe_size(x.hi), near))};
}

}  // namespace
}  // namespace fathom::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
