#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "fathom/clipping/points.h"

/// Random simple rings on a small integer grid, so that shared vertices, vertices on edges and
/// overlapping edges abound. The test of simplicity is of its own, in integers.
namespace fathom::clipping::test {

struct GridPoint {
  int x, y;
};
using GridRing = std::vector<GridPoint>;

inline int turn(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

inline bool is_on(const GridPoint& p, const GridPoint& a, const GridPoint& b) {
  return turn(a, b, p) == 0 && (p.x - a.x) * (p.x - b.x) <= 0 && (p.y - a.y) * (p.y - b.y) <= 0;
}

inline bool meet(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d) {
  const auto opposite = [](int s, int t) { return (s > 0 && t < 0) || (s < 0 && t > 0); };
  return (opposite(turn(a, b, c), turn(a, b, d)) && opposite(turn(c, d, a), turn(c, d, b))) ||
         is_on(a, c, d) || is_on(b, c, d) || is_on(c, a, b) || is_on(d, a, b);
}

inline bool is_simple(const GridRing& ring) {
  const std::size_t n = ring.size();
  if (n < 3) return false;
  for (std::size_t i = 0; i < n; ++i) {
    const GridPoint &a = ring[i], &b = ring[(i + 1) % n], &c = ring[(i + 2) % n];
    if ((a.x == b.x && a.y == b.y) || is_on(a, b, c) || is_on(c, a, b)) return false;
    for (std::size_t j = i + 2; j < n; ++j) {
      if ((j + 1) % n == i) continue;
      if (meet(a, b, ring[j], ring[(j + 1) % n])) return false;
    }
  }
  return true;
}

class PolygonMaker {
 public:
  explicit PolygonMaker(std::uint64_t seed) : random_(seed) {}

  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }

  /// A ring of at most `corners` corners with coordinates from 0 to `size`: a triangle into which
  /// corners are inserted as long as it stays simple.
  GridRing ring(int size, int corners) {
    const auto point = [&] { return GridPoint{below(size + 1), below(size + 1)}; };
    GridRing ring;
    do ring = {point(), point(), point()};
    while (!is_simple(ring));
    for (int tries = 3 * (corners - 3); tries > 0 && static_cast<int>(ring.size()) < corners;
         --tries) {
      GridRing more = ring;
      more.insert(more.begin() + below(static_cast<int>(ring.size())), point());
      if (is_simple(more)) ring = more;
    }
    return ring;
  }

  /// One to three rings that do not cross (`crosses` is asked), in any orientation: outlines,
  /// holes, islands, and rings that touch in points and along edges.
  template <class Crosses>
  Rings<double> polygon(int size, int corners, const Crosses& crosses) {
    Rings<double> rings{to_ring(ring(size, corners))};
    for (int more = below(3); more > 0; --more) {
      rings.push_back(to_ring(ring(size, 3 + below(3))));
      if (crosses(rings)) rings.pop_back();
    }
    return rings;
  }

 private:
  static Ring<double> to_ring(const GridRing& grid) {
    Ring<double> ring;
    for (const GridPoint& p : grid) ring.push_back({double(p.x), double(p.y)});
    return ring;
  }

  std::mt19937_64 random_;
};

}  // namespace fathom::clipping::test
