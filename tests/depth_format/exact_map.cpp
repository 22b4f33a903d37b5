#include "tests/depth_format/exact_map.h"

#include <bit>
#include <cmath>
#include <limits>

#include "tests/numeric/random_numbers.h"
#include "tests/oracle/mpfr_number.h"
#include "tests/special_values.h"

namespace fathom::test {
namespace {

int sign(int x) {
  return x < 0 ? -1 : x > 0 ? 1 : 0;
}

std::uint64_t greatest(Storage storage) {
  switch (storage) {
    case Storage::unorm16:
      return 0xFFFF;
    case Storage::unorm24:
      return 0xFFFFFF;
    case Storage::unorm32:
      return 0xFFFFFFFF;
    case Storage::float16:
      return 0x3C00;
    case Storage::float32:
      return std::bit_cast<std::uint32_t>(1.0F);
    case Storage::float64:
      return std::bit_cast<std::uint64_t>(1.0);
  }
  return 0;
}

/// log q.
class Logarithm {
 public:
  explicit Logarithm(long bits) : value_(bits) {}
  /// Works it out again where q is not that of the last time.
  mpfr_ptr of(const Rational& q) {
    if (compare(q, last_) == 0) return value_;
    last_ = q;
    oracle::set_log1p(value_, (q - Rational(1.0)).get());
    return value_;
  }

 private:
  oracle::MpfrNumber value_;
  Rational last_ = 0.0;
};

/// compare_logarithms() with so many bits; 0 where all but 50 of them agree.
int compare_logarithms(Logarithm& log_a, Logarithm& log_b, const Rational& a, const Rational& b,
                       const Rational& s, long bits) {
  oracle::MpfrNumber left(bits), right(bits);
  mpfr_mul_z(left, log_a.of(a), mpq_denref(s.get()), MPFR_RNDN);
  mpfr_mul_z(right, log_b.of(b), mpq_numref(s.get()), MPFR_RNDN);
  if (mpfr_eq(left, right, static_cast<unsigned long>(bits - 50)) != 0) return 0;
  return sign(mpfr_cmp(left, right));
}

/// The sign of log a / log b − s.
int compare_logarithms(const Rational& a, const Rational& b, const Rational& s) {
  static Logarithm log_a(300), log_b(300);  // one of two is asked for again and again
  if (const int sign = compare_logarithms(log_a, log_b, a, b, s, 300)) return sign;
  Logarithm finer_a(5000), finer_b(5000);
  return compare_logarithms(finer_a, finer_b, a, b, s, 5000);
}

}  // namespace

Rational::Rational(const Ratio& x) {
  mpq_init(q_);
  fathom::checks::set(q_, x);
}

Rational number(Storage storage, std::uint64_t bits) {
  switch (storage) {
    case Storage::float16: {
      const auto fraction = static_cast<double>(bits & 1023);
      const int exponent = static_cast<int>(bits >> 10);
      return exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
    }
    case Storage::float32:
      return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
    case Storage::float64:
      return std::bit_cast<double>(bits);
    default:
      return {static_cast<double>(bits), static_cast<double>(greatest(storage))};
  }
}

int compare_map(const DepthFormat& format, const Rational& depth, const Rational& value) {
  const Rational& D = depth;
  const Rational n = format.near;
  const bool finite = std::isfinite(format.far);
  const Rational f = finite ? format.far : 0.0;
  const Rational one = 1.0;
  switch (format.mapping) {
    case Mapping::standard:
    case Mapping::opengl:  // z_ndc = (f + n)/(f − n) − 2fn/(D(f − n)), then (z_ndc + 1)/2
      return sign(
          compare(((f + n) / (f - n) - Rational(2.0) * f * n / (D * (f - n)) + one) * Rational(0.5),
                  value));
    case Mapping::reversed:
      return sign(compare(one - f / (f - n) * (one - n / D), value));
    case Mapping::infinite:
      return sign(compare(one - n / D, value));
    case Mapping::reversed_infinite:
      return sign(compare(n, value * D));
    case Mapping::linear:
      return sign(compare(D - n, value * (f - n)));
    case Mapping::w:
      return sign(compare(D, value * f));
    case Mapping::log:
      return compare_logarithms(one + Rational(format.c) * D, one + Rational(format.c) * f, value);
    case Mapping::log_ulrich:
      return compare_logarithms(D / n, f / n, value);
  }
  return 0;
}

bool is_rounded_correctly(const DepthFormat& format, const Rational& depth, std::uint64_t bits) {
  const bool even = bits % 2 == 0;
  const Rational& D = depth;
  const Rational half = 0.5, here = number(format.storage, bits);
  if (bits > greatest(format.storage)) return false;
  if (bits > 0) {
    const Rational below = (here + number(format.storage, bits - 1)) * half;
    const int against = compare_map(format, D, below);
    if (against < 0 || (against == 0 && !even)) return false;
  }
  if (bits < greatest(format.storage)) {
    const Rational above = (here + number(format.storage, bits + 1)) * half;
    const int against = compare_map(format, D, above);
    if (against > 0 || (against == 0 && !even)) return false;
  }
  return true;
}

bool is_decoded_correctly(const DepthFormat& format, std::uint64_t bits, double depth) {
  const int rising = is_reversed(format.mapping) ? -1 : 1;
  const Rational value = number(format.storage, bits);
  const auto against = [&](const Rational& D) { return rising * compare_map(format, D, value); };
  // Where rounding steps from the greatest number to infinity, a tie, which goes there.
  constexpr double greatest = std::numeric_limits<double>::max();
  const Rational half = 0.5, end = Rational(greatest) + Rational(0x1p970) * half;
  if (std::isinf(depth)) return against(end) <= 0;
  const bool even = std::bit_cast<std::uint64_t>(depth) % 2 == 0;
  const Rational D = depth;
  const Rational above =
      depth == greatest ? end : (D + Rational(std::nextafter(depth, infinity))) * half;
  const int high = against(above);
  if (high < 0 || (high == 0 && !even)) return false;
  if (depth == 0) return true;  // no value stands for a negative depth
  const int low = against((D + Rational(std::nextafter(depth, -infinity))) * half);
  return even ? low <= 0 : low < 0;
}

}  // namespace fathom::test
