#include "fathom/clipping/even_odd.h"

#include <utility>

#include "fathom/clipping/exact_kernel.h"

namespace fathom::clipping {
namespace {

/// Mirrored at the diagonal: swaps left and right.
template <class Number>
Point2<Number> transposed(const Point2<Number>& p) {
  return {p.y, p.x};
}

/// Parities of the crossings with the ray from M towards +x.
struct Crossings {
  bool beyond = false;
  /// Of edges through M.
  bool here = false;
};

template <class Number>
void count(Crossings& crossings, const Point2<Number>& M, Point2<Number> p, Point2<Number> q) {
  if ((p.y > M.y) == (q.y > M.y)) return;
  if (p.x > M.x && q.x > M.x) {
    crossings.beyond = !crossings.beyond;
    return;
  }
  if (p.x < M.x && q.x < M.x) return;
  if (q.y < p.y) std::swap(p, q);
  const int side = sign_of(cross(p, q, M));  // positive: M lies left of the edge, so this is beyond
  if (side > 0) crossings.beyond = !crossings.beyond;
  if (side == 0) crossings.here = !crossings.here;
}

}  // namespace

template <class Number>
Beside inside_beside(const Point2<Number>& a, const Point2<Number>& b, const Rings<Number>& rings) {
  // A horizontal edge would run along the ray: there the ray goes towards +y.
  const bool upwards_ray = a.y == b.y;
  const auto seen = [&](const Point2<Number>& p) { return upwards_ray ? transposed(p) : p; };
  const Point2<Number> M = seen({a.x / 2 + b.x / 2, a.y / 2 + b.y / 2});

  Crossings crossings;
  for (const Ring<Number>& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i)
      count(crossings, M, seen(ring[i]), seen(ring[i + 1 < ring.size() ? i + 1 : 0]));

  const bool after = crossings.beyond;                     // just behind M along the ray
  const bool before = crossings.beyond != crossings.here;  // just in front of it
  // Left of an edge that runs up lies −x; left of one that runs to the right lies +y.
  const bool left_is_after = upwards_ray ? a.x < b.x : b.y < a.y;
  return left_is_after ? Beside{after, before} : Beside{before, after};
}

template Beside inside_beside(const Point2<double>&, const Point2<double>&, const Rings<double>&);
template Beside inside_beside(const Point2<Rational>&, const Point2<Rational>&,
                              const Rings<Rational>&);

}  // namespace fathom::clipping
