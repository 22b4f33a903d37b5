#pragma once

#include <deque>
#include <initializer_list>
#include <random>
#include <vector>

#include "fathom/area/convex_polygon.h"
#include "tests/oracle/clipped_polygon.h"

namespace fathom::checks {

/// a·u + b·v + c ≥ 0.
struct Line {
  double a, b, c;
};

/// Half-planes that stay where they are, and polygons of them beside the same in rational numbers.
class Lines {
 public:
  const area::HalfPlane& add(const Line& l) {
    return half_planes_.emplace_back(ExactVector3{l.a, l.b, l.c});
  }

  struct Both {
    area::ConvexPolygon ours;
    oracle::Polygon exact;
  };
  /// [left, right] × [low, high]
  Both rectangle(double left, double low, double right, double high) {
    using oracle::Q;
    return {area::ConvexPolygon({&add({0, 1, -low}), &add({-1, 0, right}), &add({0, -1, high}),
                                 &add({1, 0, -left})}),
            {{Q(left), Q(low)}, {Q(right), Q(low)}, {Q(right), Q(high)}, {Q(left), Q(high)}}};
  }
  /// Cuts both; returns what clip() did.
  bool clip(Both& polygon, const Line& l, TierCounts& counts) {
    polygon.exact = oracle::clipped(polygon.exact, oracle::Q(l.a), oracle::Q(l.b), oracle::Q(l.c));
    return polygon.ours.clip(add(l), counts);
  }

 private:
  std::deque<area::HalfPlane> half_planes_;
};

inline oracle::Q area_of(const oracle::Polygon& polygon) {
  return polygon.empty() ? oracle::Q(0) : oracle::Q(abs(oracle::twice_area(polygon)) / 2);
}

/// Lines of few bits, which meet each other's crossings and lie on each other often; every fourth
/// moved by next to nothing.
inline Line random_line(std::mt19937_64& random) {
  const auto number = [&](int most) {
    return static_cast<double>(static_cast<int>(random() % (2 * static_cast<unsigned>(most) + 1)) -
                               most);
  };
  Line l{number(2), number(2), number(4) / 2};
  if (l.a == 0 && l.b == 0) l.a = 1;
  if (random() % 4 == 0) l.c += 0x1p-40 * number(2);
  return l;
}

}  // namespace fathom::checks
