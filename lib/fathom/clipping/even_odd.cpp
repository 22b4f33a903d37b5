#include "fathom/clipping/even_odd.h"

#include <algorithm>

#include "fathom/clipping/exact_kernel.h"

namespace fathom::clipping {
namespace {

/// One band for so many edges, and at most so many bands.
constexpr std::size_t edges_per_band = 8, most_bands = 256;

/// Mirrored at the diagonal: swaps left and right, x and y.
template <class Number>
Point2<Number> transposed(const Point2<Number>& p) {
  return {p.y, p.x};
}

/// Whether the ray from M towards +x crosses the edge p → q strictly beyond M.
template <class Number>
bool is_crossed(const Point2<Number>& M, const Point2<Number>& p, const Point2<Number>& q) {
  if ((p.y > M.y) == (q.y > M.y)) return false;
  if (p.x > M.x && q.x > M.x) return true;
  if (p.x < M.x && q.x < M.x) return false;
  // M lies left of the edge, run upwards.
  return p.y < q.y ? cross(p, q, M) > 0 : cross(q, p, M) > 0;
}

}  // namespace

template <class Number>
std::size_t EvenOdd<Number>::Bands::band_of(const Number& coordinate) const {
  return static_cast<std::size_t>(std::upper_bound(limits.begin(), limits.end(), coordinate) -
                                  limits.begin());
}

template <class Number>
typename EvenOdd<Number>::Bands EvenOdd<Number>::bands_of(const std::vector<Edge>& edges,
                                                          Number Point2<Number>::*axis) {
  Bands bands;
  const std::size_t count = std::clamp<std::size_t>(edges.size() / edges_per_band, 1, most_bands);
  if (count > 1) {
    std::vector<Number> coordinates;
    coordinates.reserve(edges.size());
    for (const Edge& edge : edges) coordinates.push_back(edge.p->*axis);
    std::sort(coordinates.begin(), coordinates.end());
    for (std::size_t i = 1; i < count; ++i)
      bands.limits.push_back(coordinates[i * coordinates.size() / count]);
  }
  bands.edges.resize(count);
  for (const Edge& edge : edges) {
    const auto [least, greatest] = std::minmax(edge.p->*axis, edge.q->*axis);
    for (std::size_t i = bands.band_of(least); i <= bands.band_of(greatest); ++i)
      bands.edges[i].push_back(edge);
  }
  return bands;
}

template <class Number>
EvenOdd<Number>::EvenOdd(const Rings<Number>& rings) {
  std::vector<Edge> edges;
  for (const Ring<Number>& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i)
      edges.push_back({&ring[i], &ring[i + 1 < ring.size() ? i + 1 : 0]});
  across_y_ = bands_of(edges, &Point2<Number>::y);
  across_x_ = bands_of(edges, &Point2<Number>::x);
}

template <class Number>
Beside EvenOdd<Number>::beside(const Point2<Number>& a, const Point2<Number>& b) const {
  // A horizontal edge would run along the ray; for such an edge the ray goes towards +y.
  const bool upwards_ray = a.y == b.y;
  const auto seen = [&](const Point2<Number>& p) { return upwards_ray ? transposed(p) : p; };
  const Point2<Number> M = seen({a.x / 2 + b.x / 2, a.y / 2 + b.y / 2});

  const Bands& bands = upwards_ray ? across_x_ : across_y_;
  bool beyond = false, here = false;
  for (const auto& [p, q] : bands.edges[bands.band_of(M.y)])
    if ((*p == a && *q == b) || (*p == b && *q == a))
      here = !here;
    else if (is_crossed(M, seen(*p), seen(*q)))
      beyond = !beyond;

  const bool after = beyond;           // just after M along the ray
  const bool before = beyond != here;  // just before it
  // To the left of an edge that runs up is −x; to the left of one that runs to the right is +y.
  const bool left_is_after = upwards_ray ? a.x < b.x : b.y < a.y;
  return left_is_after ? Beside{after, before} : Beside{before, after};
}

template class EvenOdd<double>;
template class EvenOdd<Rational>;

}  // namespace fathom::clipping
