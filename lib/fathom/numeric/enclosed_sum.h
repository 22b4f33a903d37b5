#pragma once

#include "fathom/numeric/real.h"

namespace fathom {

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
