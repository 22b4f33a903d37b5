#pragma once

#include "fathom/numeric/real.h"

namespace fathom {

/// A sum of any number of quotients, none negative, whose exact sum would have too long a
/// denominator: each term is rounded down to a multiple of 2⁻³²⁰, and terms that this changed are
/// counted. The order in which terms come does not matter.
class EnclosedSum {
 public:
  void add(const Ratio& term);
  void add(const EnclosedSum& part);
  /// From below and from above; of width 0 if no term was rounded.
  [[nodiscard]] Enclosure get() const;

 private:
  Dyadic floor_;
  double rounded_ = 0;  // a whole number
};

}  // namespace fathom
