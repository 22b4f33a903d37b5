#include "fathom/depth_format/certified_format.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "fathom/numeric/certified_logarithm.h"
#include "fathom/numeric/certified_rounding.h"
#include "fathom/numeric/fused_multiply_add.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/transcendental.h"

// Constants are exact numbers rounded to double-words, with errors below ε = epsilon<T>; binary64
// takes their leading parts: also ε. Everything else is Certified, whose operations carry the
// bounds. near, far and C lie between 2⁻¹⁰⁰ and 2¹⁰⁰, depths are below 2²⁰⁰, stored values are 0 or
// above 2⁻⁴⁰⁰: so nothing overflows.
namespace fathom {
namespace {

using Constants = CertifiedFormat::Constants;

bool is_safe(double x) {
  return x >= least_safe && x <= greatest_safe;
}

/// k of f = k·N(D)/M(D), or the divisor of a quotient of logarithms.
Real constant_of(const DepthFormat& format) {
  const Ratio near = Dyadic(format.near), one = Dyadic(1.0);
  if (format.mapping == Mapping::infinite) return one;
  if (format.mapping == Mapping::reversed_infinite) return near;
  const Ratio far = Dyadic(format.far);
  switch (format.mapping) {
    case Mapping::reversed:
      return quotient(near, far - near);
    case Mapping::linear:
      return quotient(one, far - near);
    case Mapping::w:
      return quotient(one, far);
    case Mapping::log:
      return natural_logarithm(one + Ratio(Dyadic(format.c)) * far);
    case Mapping::log_ulrich:
      return natural_logarithm(quotient(far, near));
    default:
      return quotient(far, far - near);
  }
}

Constants constants_of(const DepthFormat& format) {
  Constants constants{format};
  constants.usable = is_safe(format.near) && is_safe(format.c) &&
                     (is_safe(format.far) || takes_infinite_far(format.mapping));
  if (!constants.usable) return constants;
  constants.k = to_double_word(constant_of(format));
  constants.usable = constants.k.hi > 0;
  return constants;
}

template <class T>
Certified<T> exactly(double x) {
  return {x, 0};
}

template <class T>
Certified<T> rounded(const WordPair& x) {
  return {entry<T>(x), epsilon<T> * std::abs(x.hi) * slack};
}

/// f(D) of a mapping without logarithms.
template <class T>
Certified<T> rational_value(const Constants& constants, const Certified<T>& D) {
  const DepthFormat& format = constants.format;
  const Certified<T> k = rounded<T>(constants.k);
  const auto beyond_near = [&] { return sum(D, exactly<T>(-format.near)); };
  switch (format.mapping) {
    case Mapping::reversed: {
      const Certified<T> before_far = sum(exactly<T>(format.far), {-D.value, D.error});
      return fathom::quotient(product(k, before_far), D);
    }
    case Mapping::reversed_infinite:
      return fathom::quotient(exactly<T>(format.near), D);
    case Mapping::linear:
      return product(k, beyond_near());
    case Mapping::w:
      return product(k, D);
    default:
      return fathom::quotient(product(k, beyond_near()), D);
  }
}

/// f(D) of any mapping.
template <bool fused>
Certified<DoubleWord<fused>> value(const Constants& constants,
                                   const Certified<DoubleWord<fused>>& D) {
  using T = DoubleWord<fused>;
  const DepthFormat& format = constants.format;
  if (!is_logarithmic(format.mapping)) return rational_value(constants, D);
  const Certified<T> argument = format.mapping == Mapping::log
                                    ? sum(product(D, exactly<T>(format.c)), exactly<T>(1))
                                    : fathom::quotient(D, exactly<T>(format.near));
  return fathom::quotient(logarithm(argument), rounded<T>(constants.k));
}

/// 2^power, for the exponent of a normal number.
double power_of_two(int power) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(power + 1023) << 52);
}

/// The integer nearest to every number that x and its error allow, at most 2⁵³; below `narrow_at`
/// the numbers are half as far apart.
std::optional<double> nearest_integer(const WordPair& x, double error, double narrow_at) {
  const double code = std::nearbyint(x.hi);
  // x.hi − code is exact, the sum rounds once.
  const double rest = std::abs((x.hi - code) + x.lo);
  if (!(rest * (1 + 0x1p-50) + error < (code == narrow_at ? 0.25 : 0.5))) return std::nullopt;
  return code;
}

/// round_to_storage() for a float storage: the integer significand at the exponent of x.hi. A power
/// of two is returned only from within a quarter of a step, the nearer end of its interval.
std::optional<StoredDepth> round_to_float(Storage storage, const WordPair& x, double error) {
  if (!(x.hi > 0x1p-300)) return std::nullopt;
  const int fraction_bits = bits_of(storage);
  const int least = least_exponent(storage);
  const int exponent =
      std::max(static_cast<int>(std::bit_cast<std::uint64_t>(x.hi) >> 52) - 1023, least);
  const double steps = power_of_two(fraction_bits - exponent);
  const double hidden = power_of_two(fraction_bits);
  const std::optional<double> significand =
      nearest_integer({x.hi * steps, x.lo * steps}, error * steps, hidden);
  if (!significand) return std::nullopt;
  return StoredDepth{(static_cast<std::uint64_t>(exponent - least) << fraction_bits) +
                     static_cast<std::uint64_t>(*significand)};
}

template <class T>
std::optional<StoredDepth> rounded_to_storage(Storage storage, const Certified<T>& x) {
  if (!is_unorm(storage)) {
    const std::optional<StoredDepth> stored = round_to_float(storage, words_of(x.value), x.error);
    return stored && *stored > greatest_stored(storage) ? std::nullopt : stored;
  }
  const double steps = greatest_code(storage);
  const Certified<T> scaled = product(x, exactly<T>(steps));
  const auto code = nearest_integer(words_of(scaled.value), scaled.error, -1);
  if (!code || *code < 0 || *code > steps) return std::nullopt;
  return StoredDepth{static_cast<std::uint64_t>(*code)};
}

/// A stored value s in [0, 1] as s/scale, exactly, and t/scale = 1 − s. The scale is 0 if that
/// cannot be given.
struct StoredShare {
  WordPair s, t;
  double scale = 1;
  /// Bound on the error of t.
  double t_error = 0;
};

/// Positive values below this are left to exact arithmetic: products with them might underflow.
constexpr double least_share = 0x1p-400;
/// So are depths above this.
constexpr double greatest_depth = 0x1p200;

double value_of_float(Storage storage, std::uint64_t bits) {
  switch (storage) {
    case Storage::float32:
      return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
    case Storage::float64:
      return std::bit_cast<double>(bits);
    default:
      return widen_binary16(static_cast<std::uint16_t>(bits));
  }
}

StoredShare share_of(Storage storage, StoredDepth stored) {
  if (is_unorm(storage)) {
    const double steps = greatest_code(storage), code = static_cast<double>(stored.bits);
    return {{code}, {steps - code}, steps};
  }
  const double s = value_of_float(storage, stored.bits);
  if (s != 0 && s < least_share) return {{}, {}, 0};
  return {{s}, two_sum(1, -s), 1};
}

/// Halfway between two neighbours, given the lower one. For floats: a + d with d half the distance,
/// and 1 − (a + d) = (1 − a) − d: 1 − a as two words; the second is 0 or at least as fine as a's
/// last bit.
StoredShare share_above(Storage storage, StoredDepth lower) {
  if (is_unorm(storage)) {
    const double steps = greatest_code(storage), twice = 2 * static_cast<double>(lower.bits) + 1;
    return {{twice}, {2 * steps - twice}, 2 * steps};
  }
  const double a = value_of_float(storage, lower.bits);
  const double d = (value_of_float(storage, lower.bits + 1) - a) / 2;
  if (a + d < least_share) return {{}, {}, 0};
  const WordPair one_less = two_sum(1, -a);
  const WordPair rest = two_sum(one_less.lo, -d);
  return {two_sum(a, d), two_sum(one_less.hi, rest.hi), 1, std::abs(rest.lo)};
}

/// The depth of a stored share, by a mapping without logarithms. Every sum is of numbers of one
/// sign, so no relative precision is lost.
template <class T>
Certified<T> rational_depth(const DepthFormat& format, const Certified<T>& s, const Certified<T>& t,
                            double scale) {
  const Certified<T> near = exactly<T>(format.near), far = exactly<T>(format.far);
  const Certified<T> unit = exactly<T>(scale);
  switch (format.mapping) {
    case Mapping::infinite:
      return fathom::quotient(product(near, unit), t);
    case Mapping::reversed_infinite:
      return fathom::quotient(product(near, unit), s);
    case Mapping::linear:
      return fathom::quotient(sum(product(near, t), product(far, s)), unit);
    case Mapping::w:
      return fathom::quotient(product(s, far), unit);
    case Mapping::reversed:
      return fathom::quotient(product(product(near, far), unit),
                              sum(product(near, t), product(far, s)));
    default:
      return fathom::quotient(product(product(near, far), unit),
                              sum(product(far, t), product(near, s)));
  }
}

/// A division by zero leaves NaN.
template <class T>
Certified<T> if_known(const Certified<T>& x) {
  return std::isfinite(x.error) ? x : Certified<T>{};
}

template <bool fused>
struct Wide {
  using T = DoubleWord<fused>;

  static std::optional<StoredDepth> encode(const Constants& constants,
                                           const Certified<WordPair>& depth) {
    const Certified<T> D{depth.value, depth.error};
    return rounded_to_storage(constants.format.storage, value<fused>(constants, D));
  }

  static Certified<WordPair> decode(const Constants& constants, const WordPair& s,
                                    const Certified<WordPair>& t, double scale) {
    const Certified<T> depth = this_depth(constants, {s, 0}, {t.value, t.error}, scale);
    return {depth.value, depth.error};
  }

 private:
  static Certified<T> this_depth(const Constants& constants, const Certified<T>& s,
                                 const Certified<T>& t, double scale) {
    const DepthFormat& format = constants.format;
    if (!is_logarithmic(format.mapping)) return rational_depth(format, s, t, scale);
    const Certified<T> share = fathom::quotient(s, exactly<T>(scale));
    const Certified<T> power = exponential(product(share, rounded<T>(constants.k)));
    if (format.mapping == Mapping::log_ulrich) return product(power, exactly<T>(format.near));
    return fathom::quotient(sum(power, exactly<T>(-1)), exactly<T>(format.c));
  }
};

FATHOM_WITH_FMA std::optional<StoredDepth> encode_with_fma(const Constants& constants,
                                                           const Certified<WordPair>& depth) {
  return Wide<true>::encode(constants, depth);
}
FATHOM_WITH_FMA Certified<WordPair> decode_with_fma(const Constants& constants, const WordPair& s,
                                                    const Certified<WordPair>& t, double scale) {
  return Wide<true>::decode(constants, s, t, scale);
}
const CertifiedFormat::Arithmetic& arithmetic_of_processor() {
  static const bool has_fma = processor_has_fma();
  return has_fma ? CertifiedFormat::with_fma : CertifiedFormat::without_fma;
}

}  // namespace

const CertifiedFormat::Arithmetic CertifiedFormat::with_fma{encode_with_fma, decode_with_fma};
const CertifiedFormat::Arithmetic CertifiedFormat::without_fma{Wide<false>::encode,
                                                               Wide<false>::decode};

CertifiedFormat::CertifiedFormat(const DepthFormat& format)
    : CertifiedFormat(format, arithmetic_of_processor()) {}

CertifiedFormat::CertifiedFormat(const DepthFormat& format, const Arithmetic& arithmetic)
    : constants_(constants_of(format)), arithmetic_(&arithmetic) {}

std::optional<StoredDepth> CertifiedFormat::encode(const Certified<double>& depth) const {
  if (!constants_.usable || is_logarithmic(constants_.format.mapping)) return std::nullopt;
  if (!(depth.value <= greatest_depth)) return std::nullopt;
  return rounded_to_storage(constants_.format.storage, rational_value(constants_, depth));
}

std::optional<StoredDepth> CertifiedFormat::encode(const Certified<WordPair>& depth) const {
  if (!constants_.usable || !(depth.value.hi <= greatest_depth)) return std::nullopt;
  return arithmetic_->encode(constants_, depth);
}

Certified<double> CertifiedFormat::decode(StoredDepth stored) const {
  if (!constants_.usable || is_logarithmic(constants_.format.mapping)) return {};
  const StoredShare share = share_of(constants_.format.storage, stored);
  if (share.scale == 0) return {};
  const double dropped = std::abs(share.t.lo);
  return if_known(rational_depth<double>(constants_.format, {share.s.hi, 0}, {share.t.hi, dropped},
                                         share.scale));
}

Certified<WordPair> CertifiedFormat::wide_decode(StoredDepth stored) const {
  if (!constants_.usable) return {};
  const StoredShare share = share_of(constants_.format.storage, stored);
  if (share.scale == 0) return {};
  return if_known(arithmetic_->decode(constants_, share.s, {share.t, share.t_error}, share.scale));
}

double CertifiedFormat::farthest_stored_as(StoredDepth stored) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const DepthFormat& format = constants_.format;
  const bool falls = is_reversed(format.mapping);
  if (!constants_.usable) return infinity;
  if (falls ? stored.bits == 0 : stored == greatest_stored(format.storage)) return infinity;
  const StoredShare share =
      share_above(format.storage, falls ? StoredDepth{stored.bits - 1} : stored);
  if (share.scale == 0) return infinity;
  const Certified<WordPair> end =
      arithmetic_->decode(constants_, share.s, {share.t, share.t_error}, share.scale);
  const double bound = (end.value.hi + end.error) * (1 + 0x1p-50);
  return std::isfinite(bound) ? bound : infinity;
}

std::optional<StoredDepth> certified_rounding(Storage storage, const Certified<double>& value) {
  return rounded_to_storage(storage, value);
}

}  // namespace fathom
