#pragma once

#include <vector>

#include "fathom/numeric/real.h"

/// Sums that round correctly: of many quotients, and of square roots.
namespace fathom {

// Sums of many quotients, whose exact values have long denominators. They round by an enclosure
// first; the exact sum is computed only if the enclosure does not decide.

/// The sum of the terms.
Real real_sum(std::vector<Ratio> terms);

/// The sum of `over` divided by the sum of `under`.
/// Needs    every term of `under` is positive.
Real real_quotient(std::vector<Ratio> over, std::vector<Ratio> under);

/// Encloses the quotients of all numbers of two enclosures.
/// Needs    both ends of `under` are positive.
Enclosure quotient(const Enclosure& over, const Enclosure& under);

/// A sum Σ qᵢ·√rᵢ of roots, with rational qᵢ and dyadic rᵢ > 0.
///
/// Whether it is rational is decidable: square roots of different square-free numbers are linearly
/// independent over the rational numbers [Bes40]. So terms whose rᵢ·rⱼ is a square are added, and
/// the sum is rational if all others cancel, except those whose rᵢ is a square.
class RootSum {
 public:
  /// Adds q·√r; nothing if q or r is 0.
  /// Needs    r ≥ 0.
  void add(Ratio q, Dyadic r);
  [[nodiscard]] bool is_empty() const { return terms_.empty(); }

  /// The sum, which rounds correctly.
  [[nodiscard]] Real value() const;
  /// a/b, which rounds correctly.
  /// Needs    a b that has a term, and only positive ones.
  friend Real quotient(const RootSum& a, const RootSum& b);

 private:
  struct Term {
    Ratio factor;
    Dyadic radicand;
  };
  /// The terms by classes: each has one radicand, and the sum of the factors.
  [[nodiscard]] std::vector<Term> by_classes() const;
  /// An enclosure with an error of about 2⁻ᵇⁱᵗˢ of the greatest term.
  [[nodiscard]] Enclosure enclose(long bits) const;

  std::vector<Term> terms_;
};
Real quotient(const RootSum& a, const RootSum& b);

/// √x where it is rational.
std::optional<Dyadic> exact_root(const Dyadic& x);

}  // namespace fathom
