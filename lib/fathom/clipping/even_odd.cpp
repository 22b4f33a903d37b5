#include "fathom/clipping/even_odd.h"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "fathom/clipping/exact_kernel.h"

namespace fathom::clipping {
namespace {

/// One band for so many edges, as long as an edge lies in no more bands than this on average.
constexpr std::size_t edges_per_band = 8, most_bands_an_edge = 16;

/// Mirrored at the diagonal: swaps left and right, x and y.
template <class Number>
Point2<Number> transposed(const Point2<Number>& p) {
  return {p.y, p.x};
}

/// A point with a box around it.
template <class Number>
struct BoxedPoint {
  const Point2<Number>& point;
  Box box;
};

template <class Number>
bool is_same(const BoxedPoint<Number>& a, const BoxedPoint<Number>& b) {
  if (a.box.x != b.box.x || a.box.y != b.box.y) return false;
  return a.box.is_exact() || a.point == b.point;
}

/// Whether a > b, of coordinates and their bounds.
template <class Number>
bool is_greater(const Number& a, const Bounds& a_bounds, const Number& b, const Bounds& b_bounds) {
  if (b_bounds.is_below(a_bounds)) return true;
  if (a_bounds.greatest <= b_bounds.least) return false;
  return a > b;
}

/// The sign of cross(p, q, M), where the ray goes towards +x, or all mirrored.
template <class Number>
int side_of(const BoxedPoint<Number>& p, const BoxedPoint<Number>& q, const BoxedPoint<Number>& M,
            bool mirrored) {
  if constexpr (std::is_same_v<Number, Rational>) {
    const auto settled = settled_sign_of_cross(p.box, q.box, M.box);
    if (settled) return mirrored ? -*settled : *settled;
  }
  if (!mirrored) return sign_of(cross(p.point, q.point, M.point));
  return sign_of(cross(transposed(p.point), transposed(q.point), transposed(M.point)));
}

/// Whether the ray from M towards +x crosses the edge p → q strictly beyond M; mirrored: the ray
/// towards +y.
template <class Number>
bool is_crossed(const BoxedPoint<Number>& M, const BoxedPoint<Number>& p,
                const BoxedPoint<Number>& q, bool mirrored) {
  const auto across = mirrored ? &Point2<Number>::x : &Point2<Number>::y;
  const auto across_box = mirrored ? &Box::x : &Box::y;
  const auto along_box = mirrored ? &Box::y : &Box::x;
  const auto is_beyond = [&](const BoxedPoint<Number>& end) {
    return is_greater(end.point.*across, end.box.*across_box, M.point.*across, M.box.*across_box);
  };
  if (is_beyond(p) == is_beyond(q)) return false;
  const Bounds &m = M.box.*along_box, &p_along = p.box.*along_box, &q_along = q.box.*along_box;
  if (m.is_below(p_along) && m.is_below(q_along)) return true;
  if (p_along.is_below(m) && q_along.is_below(m)) return false;
  // M lies left of the edge, run upwards.
  return is_beyond(q) ? side_of(p, q, M, mirrored) > 0 : side_of(q, p, M, mirrored) > 0;
}

}  // namespace

template <class Number>
std::size_t EvenOdd<Number>::Bands::band_of(const Number& coordinate) const {
  return static_cast<std::size_t>(std::upper_bound(limits.begin(), limits.end(), coordinate) -
                                  limits.begin());
}

template <class Number>
typename EvenOdd<Number>::Bands EvenOdd<Number>::bands_of(Number Point2<Number>::*axis) const {
  Bands bands;
  std::size_t count = std::max<std::size_t>(edges_.size() / edges_per_band, 1);
  if (count > 1) {
    std::vector<Number> coordinates;
    coordinates.reserve(edges_.size());
    for (const Edge& edge : edges_) coordinates.push_back(edge.p->*axis);
    std::sort(coordinates.begin(), coordinates.end());
    for (std::size_t i = 1; i < count; ++i)
      bands.limits.push_back(coordinates[i * coordinates.size() / count]);
  }
  /// The first and the last band of each edge.
  std::vector<std::pair<std::size_t, std::size_t>> spans;
  spans.reserve(edges_.size());
  for (const Edge& edge : edges_) {
    const auto ends = std::minmax({bands.band_of(edge.p->*axis), bands.band_of(edge.q->*axis)});
    spans.emplace_back(ends.first, ends.second);
  }
  const auto entries = [&] {
    std::size_t sum = 0;
    for (const auto& [first, last] : spans) sum += last - first + 1;
    return sum;
  };
  // Where edges reach far, two bands become one.
  while (entries() > most_bands_an_edge * edges_.size()) {
    std::vector<Number> kept;
    for (std::size_t i = 1; i < bands.limits.size(); i += 2) kept.push_back(bands.limits[i]);
    bands.limits = std::move(kept);
    for (auto& [first, last] : spans) first /= 2, last /= 2;
  }
  bands.edges.resize(bands.limits.size() + 1);
  for (std::size_t e = 0; e < edges_.size(); ++e)
    for (std::size_t i = spans[e].first; i <= spans[e].second; ++i) bands.edges[i].push_back(e);
  return bands;
}

template <class Number>
EvenOdd<Number>::EvenOdd(const Rings<Number>& rings) {
  for (const Ring<Number>& ring : rings) {
    const std::size_t first = edges_.size(), n = ring.size();
    for (std::size_t i = 0; i < n; ++i)
      edges_.push_back({&ring[i], &ring[i + 1 < n ? i + 1 : 0], box_of(ring[i]), {}});
    for (std::size_t i = 0; i < n; ++i)
      edges_[first + i].at_q = edges_[first + (i + 1 < n ? i + 1 : 0)].at_p;
  }
  across_y_ = bands_of(&Point2<Number>::y);
  across_x_ = bands_of(&Point2<Number>::x);
}

template <class Number>
Beside EvenOdd<Number>::beside(const Point2<Number>& a, const Point2<Number>& b) const {
  // A horizontal edge would run along the ray; for such an edge the ray goes towards +y.
  const bool upwards_ray = a.y == b.y;
  const Point2<Number> middle{a.x / 2 + b.x / 2, a.y / 2 + b.y / 2};
  const BoxedPoint<Number> from{a, box_of(a)}, to{b, box_of(b)}, M{middle, box_of(middle)};

  bool beyond = false, here = false;
  const auto& band = upwards_ray ? across_x_.edges[across_x_.band_of(middle.x)]
                                 : across_y_.edges[across_y_.band_of(middle.y)];
  for (const std::size_t e : band) {
    const BoxedPoint<Number> p{*edges_[e].p, edges_[e].at_p}, q{*edges_[e].q, edges_[e].at_q};
    if ((is_same(p, from) && is_same(q, to)) || (is_same(p, to) && is_same(q, from)))
      here = !here;
    else if (is_crossed(M, p, q, upwards_ray))
      beyond = !beyond;
  }

  const bool after = beyond;           // just after M along the ray
  const bool before = beyond != here;  // just before it
  // To the left of an edge that runs up is −x; to the left of one that runs to the right is +y.
  const bool left_is_after = upwards_ray ? a.x < b.x : b.y < a.y;
  return left_is_after ? Beside{after, before} : Beside{before, after};
}

template class EvenOdd<double>;
template class EvenOdd<Rational>;

}  // namespace fathom::clipping
