#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "fathom/numeric/rounding.h"

namespace fathom {

/// A closed interval with exact ends.
struct Enclosure {
  Ratio low, high;
};

/// A real number that rounds correctly: a quotient, or a number that can be enclosed with any
/// precision and for which it is decidable whether it is a quotient.
///
/// Rounding follows Ziv: enclose, round both ends, and go on with twice the bits while they differ.
/// This ends unless the number lies on a boundary of rounding, and boundaries are rational.
/// Therefore a number that is rational after all is recognised before the bits are raised for the
/// first time. Real has no arithmetic: functions that prove a number irrational create it.
/// Source   [Ziv91]
class Real {
 public:
  /// An enclosure whose width goes to zero as `bits` grows; `bits` is about its relative precision.
  using Enclose = std::function<Enclosure(long bits)>;
  /// The value if it is a rational number at which rounding may step; nullopt only if it is proved
  /// not to be.
  using Decide = std::function<std::optional<Ratio>()>;

  Real(Ratio value) : rational_(std::move(value)) {}
  Real(Enclose enclose, Decide decide) : enclose_(std::move(enclose)), decide_(std::move(decide)) {}

  /// The value if `decide` finds it, else nullopt.
  [[nodiscard]] std::optional<Ratio> rational() const;
  [[nodiscard]] Enclosure enclose(long bits) const;

  /// `round` of the number, for a `round` that is monotone and steps only at rational numbers.
  template <class Round>
  auto rounded(const Round& round) const {
    if (rational_) return round(*rational_);
    for (long bits = first_bits;; bits *= 2) {
      const Enclosure around = enclose_(bits);
      const auto low = round(around.low);
      if (low == round(around.high)) return low;
      if (bits > first_bits) continue;
      if (const std::optional<Ratio> exact = decide_()) return round(*exact);
    }
  }

 private:
  /// Settles all except about one in 2⁶⁰ roundings to binary32, one in 2³⁰ to binary64.
  static constexpr long first_bits = 96;

  std::optional<Ratio> rational_;
  Enclose enclose_;
  Decide decide_;
};

/// Of the numbers m·2^k in an enclosure, one with the greatest k, if it has at most 160 bits.
/// Where the enclosure is narrower than 2⁻¹²⁸ of its numbers, the only number in it at which
/// rounding to binary32, to binary64 or to an integer below 2⁵³ can step, or the square of such a
/// number: those have at most 108 bits.
/// Needs    ends of the same sign, not 0.
std::optional<Dyadic> shortest_within(const Enclosure& e);

/// Correct rounding, as in rounding.h.
float round_to_binary32(const Real& x);
double round_to_binary64(const Real& x);
Binary16 round_to_binary16(const Real& x);
std::optional<std::uint32_t> round_to_unorm(const Real& x, int bits);

/// The sign of x − y.
int compare(const Real& x, const Ratio& y);

/// offset + factor·x
Real affine(const Real& x, const Ratio& factor, const Ratio& offset);

/// A sum of any number of quotients whose exact sum would have too long a denominator: each term is
/// rounded down to a multiple of 2⁻³²⁰, and the terms that this changed are counted. The order of
/// the terms does not matter.
class EnclosedSum {
 public:
  void add(const Ratio& term);
  void add(const EnclosedSum& part);
  /// The sum from below and from above; of width 0 if no term was rounded.
  [[nodiscard]] Enclosure get() const;

 private:
  Dyadic floor_;
  double rounded_ = 0;  // an integer
};

}  // namespace fathom
