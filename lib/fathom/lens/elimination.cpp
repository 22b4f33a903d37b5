#include "fathom/lens/elimination.h"

#include <algorithm>
#include <limits>

#include "fathom/numeric/certified.h"
#include "fathom/numeric/certified_value.h"

namespace fathom::lens {
namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();

using Point = HomogeneousPoint<Certified<double>>;

/// y with c = 1.
Point certified_point(const DistortedPoint& y) {
  const Interval c = enclose(y.c);
  return {to_certified(quotient(enclose(y.a), c)), to_certified(quotient(enclose(y.b), c)), {1, 0}};
}

/// F without bounds, for the search.
class ApproximateF {
 public:
  ApproximateF(const PolynomialStage& stage, const Point& y)
      : numbers_(stage.numbers), y_{y.a.value, y.b.value, 1} {}
  double operator()(double q) const { return eliminate(numbers_, y_, q).f; }
  /// |y|²: the root, if the stage changes nothing.
  [[nodiscard]] double first_guess() const { return y_.a * y_.a + y_.b * y_.b; }

 private:
  const StageNumbers<double>& numbers_;
  HomogeneousPoint<double> y_;
};

/// The root of F in (0, limit], if F is negative at 0; more than `limit` if F is negative there.
/// NaN if there are numbers on the way that are none.
/// Regula falsi with the weights of the Illinois method; every fourth step is a bisection.
double root_near(const ApproximateF& F, double limit) {
  double low = 0, high = std::min(F.first_guess(), limit);
  double f_low = F(low), f_high = F(high);
  while (f_high < 0) {
    if (high >= limit) return no_limit;
    low = high;
    f_low = f_high;
    high = std::min(2 * high, limit);
    f_high = F(high);
  }
  Sign before = Sign::zero;
  for (int step = 0; step < 200 && high - low > 0x1p-50 * high; ++step) {
    const double secant = low - f_low * ((high - low) / (f_high - f_low));
    const double q = step % 4 != 3 && secant > low && secant < high ? secant : low / 2 + high / 2;
    const double f = F(q);
    const Sign sign = f < 0 ? Sign::negative : Sign::positive;
    if (sign == Sign::negative) {
      low = q;
      f_low = f;
      if (sign == before) f_high /= 2;
    } else {
      high = q;
      f_high = f;
      if (sign == before) f_low /= 2;
    }
    before = sign;
  }
  return low / 2 + high / 2;
}

/// A ball that contains [low, high].
Certified<double> around(double low, double high) {
  return to_certified({low, high});
}

}  // namespace

RootEstimate estimate_root(const PolynomialStage& stage, const DistortedPoint& distorted) {
  const Point y = certified_point(distorted);
  const Interval limit = stage.limit ? enclose(*stage.limit) : Interval{no_limit, no_limit};
  const auto at = [&](const Certified<double>& q) { return eliminate(stage.certified, y, q); };
  const double root = root_near(ApproximateF(stage, y), limit.lower);
  if (root == no_limit) {
    const bool is_outside = certain_sign(at(around(limit.lower, limit.upper)).f) == Sign::negative;
    return {is_outside ? Existence::no : Existence::unknown};
  }
  for (const double width : {0x1p-46, 0x1p-44, 0x1p-40, 0x1p-32}) {
    const double low = root * (1 - width), high = std::min(root * (1 + width), limit.lower);
    if (certain_sign(at({low, 0}).f) != Sign::negative) continue;
    if (certain_sign(at({high, 0}).f) != Sign::positive) continue;
    const auto [x, y_component, z] = at(around(low, high)).direction;
    if (certain_sign(z) != Sign::positive) continue;
    return {Existence::yes, low, high, {enclose(x / z), enclose(y_component / z), {1, 1}}};
  }
  return {};
}

}  // namespace fathom::lens
