#include "fathom/attribution/model/recorded_depth.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fathom/numeric/unit_roundoff.h"

namespace fathom::attribution {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The distance of neighbouring numbers of `bits` bits about x, none less than 2^least.
double spacing(double x, int bits, int least) {
  if (x == 0 || !std::isfinite(x)) return std::ldexp(1.0, least);
  return std::ldexp(1.0, std::max(std::ilogb(x) - bits, least));
}

}  // namespace

double term_of(DepthTerm term, double depth) {
  return term == DepthTerm::depth     ? depth
         : term == DepthTerm::inverse ? 1 / depth
                                      : std::log(depth);
}

double depth_of(DepthTerm term, double value) {
  if (term == DepthTerm::depth) return value;
  if (term == DepthTerm::logarithm) return std::exp(value);
  return value > 0 ? 1 / value : infinity;
}

double round_to_binary16(double x) {
  if (!(std::abs(x) <= 65504)) return x;
  const double unit = spacing(x, 10, -24);
  return std::nearbyint(x / unit) * unit;
}

double RecordedDepth::exact(double depth) const {
  return factor * term_of(term, depth) + offset;
}

double RecordedDepth::rounded(double recorded) const {
  if (!std::isfinite(recorded)) return recorded;
  switch (rounding) {
    case Rounding::binary32:
      return recorded;
    case Rounding::binary16:
      return round_to_binary16(recorded);
    case Rounding::nearest:
      return origin + step * std::nearbyint((recorded - origin) / step);
    case Rounding::down:
      break;
  }
  return origin + step * std::floor((recorded - origin) / step);
}

double RecordedDepth::to_depth(double recorded) const {
  return depth_of(term, (recorded - offset) / factor);
}

double RecordedDepth::step_at(double recorded) const {
  if (rounding == Rounding::binary32) return spacing(recorded, 23, -149);
  return rounding == Rounding::binary16 ? spacing(recorded, 10, -24) : step;
}

Interval RecordedDepth::read_back(const Interval& depths) const {
  const double a = exact(depths.lower), b = exact(depths.upper);
  double least = std::min(a, b), greatest = std::max(a, b);
  least = rounded(least - error);
  greatest = rounded(greatest + error);
  least -= 2 * unit_roundoff<float> * std::abs(least);
  greatest += 2 * unit_roundoff<float> * std::abs(greatest);
  const double p = to_depth(least), q = to_depth(greatest);
  return {std::min(p, q), std::max(p, q)};
}

}  // namespace fathom::attribution
