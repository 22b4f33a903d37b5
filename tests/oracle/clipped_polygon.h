#pragma once

#include <vector>

#include "tests/oracle/areas.h"

namespace fathom::oracle {

using Polygon = std::vector<Point>;

/// Sutherland and Hodgman's cut in rational numbers: where a·x + b·y + c ≥ 0.
inline Polygon clipped(const Polygon& polygon, const Q& a, const Q& b, const Q& c) {
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const Q f = a * p[0] + b * p[1] + c, g = a * q[0] + b * q[1] + c;
    if (sgn(f) >= 0) result.push_back(p);
    if (sgn(f) * sgn(g) >= 0) continue;
    const Q t = f / (f - g);
    result.push_back({p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])});
  }
  return result;
}

/// Without points that others repeat or that lie between their neighbours.
inline Polygon without_superfluous(Polygon polygon) {
  for (std::size_t i = 0; i < polygon.size() && polygon.size() > 2;) {
    const std::size_t n = polygon.size();
    const Polygon corner{polygon[(i + n - 1) % n], polygon[i], polygon[(i + 1) % n]};
    if (sgn(twice_area(corner)) == 0) {
      polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(i));
      i = 0;
    } else {
      ++i;
    }
  }
  return polygon;
}

}  // namespace fathom::oracle
