#pragma once

#include <CGAL/Gmpq.h>

#include <string>

#include "fathom/clipping/points.h"
#include "fathom/numeric/ratio.h"

/// The exact kernel. The only header of this module that exposes CGAL.
namespace fathom::clipping {

/// A rational number of any size, in lowest terms.
using Rational = CGAL::Gmpq;

/// `x` as a number of numeric/, which rounds and prints.
Ratio to_ratio(const Rational& x);

/// `x` rounded once to binary64, to nearest, ties to even.
double to_binary64(const Rational& x);
inline double to_binary64(double x) {
  return x;
}

/// "p/q" in lowest terms, "p" if q is 1.
std::string to_fraction(const Rational& x);

/// The same rings over the exact kernel.
Rings<Rational> to_exact(const Rings<double>& rings);
inline Rings<Rational> to_exact(const Rings<Rational>& rings) {
  return rings;
}

}  // namespace fathom::clipping
