#include "fathom/pipeline/scan/edge_function.h"

#include <algorithm>

namespace fathom::pipeline {
namespace {

/// The edge function of p → q, positive on the left as seen.
template <class Number>
EdgeFunction<Number> edge_between(const Point<Number>& p, const Point<Number>& q) {
  EdgeFunction<Number> e{Number(q.y - p.y), Number(p.x - q.x), Number(q.x * p.y - p.x * q.y),
                         false};
  return e;
}

template <class Number>
std::int64_t last_before(const Number& x) {
  return ceiling_of(Number(x - Number(1) / Number(2))) - 1;
}

}  // namespace

template <class Number>
std::optional<EdgeTriangle<Number>> edge_functions(const std::array<Point<Number>, 3>& p) {
  EdgeTriangle<Number> t{
      {edge_between(p[1], p[2]), edge_between(p[2], p[0]), edge_between(p[0], p[1])},
      left_of(p[0], p[1], p[2]),
      false};
  if (t.twice_area == Number(0)) return std::nullopt;
  t.turned = t.twice_area < Number(0);
  if (t.turned) t.twice_area = -t.twice_area;
  for (EdgeFunction<Number>& e : t.edges) {
    if (t.turned) e = {Number(-e.a), Number(-e.b), Number(-e.c), false};
    e.left_or_top = e.a > Number(0) || (e.a == Number(0) && e.b > Number(0));
  }
  return t;
}

template <class Number>
void rasterize_triangle(const std::array<Point<Number>, 3>& corners, const PixelWindow& window,
                        const std::function<void(const CoveredPixel<Number>&)>& visit) {
  const auto triangle = edge_functions(corners);
  if (!triangle) return;
  const auto [left, right] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
  const auto [top, bottom] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
  const std::int64_t y_begin = std::max(floor_of(top), window.y_begin);
  const std::int64_t y_end = std::min(last_before(bottom) + 2, window.y_end);
  const std::int64_t x_begin = std::max(floor_of(left), window.x_begin);
  const std::int64_t x_end = std::min(last_before(right) + 2, window.x_end);
  for (std::int64_t y = y_begin; y < y_end; ++y) {
    for (std::int64_t x = x_begin; x < x_end; ++x) {
      CoveredPixel<Number> covered{{x, y}, {}, {}};
      bool inside = true;
      for (std::size_t k = 0; k < 3 && inside; ++k) {
        const EdgeFunction<Number>& e = triangle->edges[k];
        covered.edges[k] = e.at(centre_of<Number>(x), centre_of<Number>(y));
        inside = e.contains(covered.edges[k]);
      }
      if (!inside) continue;
      for (std::size_t k = 0; k < 3; ++k)
        covered.barycentric[k] = covered.edges[k] / triangle->twice_area;
      visit(covered);
    }
  }
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type needs none
#define FATHOM_INSTANTIATE(Number)                                                          \
  template std::optional<EdgeTriangle<Number>> edge_functions(                              \
      const std::array<Point<Number>, 3>&);                                                 \
  template void rasterize_triangle(const std::array<Point<Number>, 3>&, const PixelWindow&, \
                                   const std::function<void(const CoveredPixel<Number>&)>&);
FATHOM_INSTANTIATE(Exact)
FATHOM_INSTANTIATE(double)
FATHOM_INSTANTIATE(float)
#undef FATHOM_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace fathom::pipeline
