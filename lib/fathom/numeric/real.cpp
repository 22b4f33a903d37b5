#include "fathom/numeric/real.h"

#include <bit>

#include "fathom/numeric/big_numbers.h"

namespace fathom {

std::optional<Ratio> Real::rational() const {
  return rational_ ? rational_ : decide_();
}

Enclosure Real::enclose(long bits) const {
  return rational_ ? Enclosure{*rational_, *rational_} : enclose_(bits);
}

namespace {

/// ⌊|x|·2^power⌋
void floor_of_magnitude(mpz_ptr result, const Ratio& x, long power) {
  Fraction f = magnitude_as_fraction(x);
  shift(f.numerator, f.denominator, power);
  mpz_fdiv_q(result, f.numerator, f.denominator);
}

/// The greatest integer below |x|·2^power.
void integer_below(mpz_ptr result, const Ratio& x, long power) {
  floor_of_magnitude(result, x, power);
  const Ratio floor(Dyadic::of(result, -power));
  if (floor == Ratio(abs(x.numerator), x.denominator)) mpz_sub_ui(result, result, 1);
}

}  // namespace

// Integers in [a, b] have as many trailing zeros as b without the bits below the highest one in
// which it differs from a − 1.
std::optional<Dyadic> shortest_within(const Enclosure& e) {
  const bool negative = e.high.sign() == Sign::negative;
  const Ratio& near = negative ? e.high : e.low;
  const Ratio& far = negative ? e.low : e.high;
  constexpr long bits = 160;
  const long power = bits - (far.numerator.top() - far.denominator.top());
  Integer below, last, differing;
  integer_below(below, near, power);
  floor_of_magnitude(last, far, power);
  if (mpz_cmp(below.get(), last.get()) == 0) return std::nullopt;
  mpz_xor(differing, below, last);
  const std::size_t highest = mpz_sizeinbase(differing.get(), 2) - 1;
  mpz_fdiv_q_2exp(last, last, highest);
  const Dyadic size = Dyadic::of(last, static_cast<long>(highest) - power);
  return negative ? -size : size;
}

// The ends of an enclosure are compared as bits: where a thread takes subnormal numbers for 0, two
// different ones are equal.
float round_to_binary32(const Real& x) {
  return std::bit_cast<float>(
      x.rounded([](const Ratio& r) { return std::bit_cast<std::uint32_t>(round_to_binary32(r)); }));
}

double round_to_binary64(const Real& x) {
  return std::bit_cast<double>(
      x.rounded([](const Ratio& r) { return std::bit_cast<std::uint64_t>(round_to_binary64(r)); }));
}

Binary16 round_to_binary16(const Real& x) {
  return x.rounded([](const Ratio& r) { return round_to_binary16(r); });
}

std::optional<std::uint32_t> round_to_unorm(const Real& x, int bits) {
  return x.rounded([bits](const Ratio& r) { return round_to_unorm(r, bits); });
}

int compare(const Real& x, const Ratio& y) {
  return x.rounded([&y](const Ratio& r) { return compare(r, y); });
}

Real affine(const Real& x, const Ratio& factor, const Ratio& offset) {
  const auto map = [factor, offset](const Ratio& r) { return offset + factor * r; };
  return {[x, map, falls = factor.sign() == Sign::negative](long bits) {
            const Enclosure e = x.enclose(bits);
            return falls ? Enclosure{map(e.high), map(e.low)} : Enclosure{map(e.low), map(e.high)};
          },
          [x, map]() -> std::optional<Ratio> {
            const std::optional<Ratio> r = x.rational();
            return r ? std::optional(map(*r)) : std::nullopt;
          }};
}

namespace {

constexpr long fraction_bits = 320;

}  // namespace

void EnclosedSum::add(const Ratio& term) {
  Integer numerator, denominator, quotient, remainder;
  mpz_set(numerator, term.numerator.significand());
  mpz_set(denominator, term.denominator.significand());
  shift(numerator, denominator,
        fraction_bits + term.numerator.exponent() - term.denominator.exponent());
  mpz_fdiv_qr(quotient, remainder, numerator, denominator);
  if (mpz_sgn(remainder.get()) != 0) rounded_ += 1;
  floor_ += Dyadic::of(quotient, -fraction_bits);
}

void EnclosedSum::add(const EnclosedSum& part) {
  floor_ += part.floor_;
  rounded_ += part.rounded_;
}

Enclosure EnclosedSum::get() const {
  return {floor_, floor_ + Dyadic(rounded_).scaled(-fraction_bits)};
}

}  // namespace fathom
