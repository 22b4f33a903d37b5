#include "fathom/pipeline/scan/edge_function.h"

#include <algorithm>

#include "fathom/threads/interruption.h"

namespace fathom::pipeline {
namespace {

/// The edge function of p → q, positive on the left as seen.
template <class Number>
EdgeFunction<Number> edge_between(const Point<Number>& p, const Point<Number>& q) {
  EdgeFunction<Number> e{Number(q.y - p.y), Number(p.x - q.x), Number(q.x * p.y - p.x * q.y), false,
                         false};
  return e;
}

}  // namespace

template <class Number>
std::optional<EdgeTriangle<Number>> edge_functions(const std::array<Point<Number>, 3>& p,
                                                   EdgeRule rule) {
  EdgeTriangle<Number> t{
      {edge_between(p[1], p[2]), edge_between(p[2], p[0]), edge_between(p[0], p[1])},
      left_of(p[0], p[1], p[2]),
      false};
  if (t.twice_area == Number(0)) return std::nullopt;
  t.turned = t.twice_area < Number(0);
  if (t.turned) t.twice_area = -t.twice_area;
  for (EdgeFunction<Number>& e : t.edges) {
    if (t.turned) e = {Number(-e.a), Number(-e.b), Number(-e.c), false, false};
    e.left_or_top = e.a > Number(0) || (e.a == Number(0) && e.b > Number(0));
    e.takes_zero = e.left_or_top || rule == EdgeRule::closed;
  }
  return t;
}

template <class Number>
PixelWindow bounding_box(const std::array<Point<Number>, 3>& corners, const PixelWindow& window) {
  const auto [left, right] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
  const auto [top, bottom] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
  return {std::max(floor_of(left), window.x_begin), std::max(floor_of(top), window.y_begin),
          std::min(ceiling_of(right), window.x_end), std::min(ceiling_of(bottom), window.y_end)};
}

template <class Number>
void rasterize_triangle(const std::array<Point<Number>, 3>& corners, const PixelWindow& window,
                        const std::function<void(const CoveredPixel<Number>&)>& visit,
                        EdgeRule rule) {
  const auto triangle = edge_functions(corners, rule);
  if (!triangle) return;
  const PixelWindow box = bounding_box(corners, window);
  for (std::int64_t y = box.y_begin; y < box.y_end; ++y) {
    for (std::int64_t x = box.x_begin; x < box.x_end; ++x) {
      check_interruption();
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

// NOLINTBEGIN(bugprone-macro-parentheses): a type needs no parentheses
#define FATHOM_INSTANTIATE(Number)                                                                 \
  template std::optional<EdgeTriangle<Number>> edge_functions(const std::array<Point<Number>, 3>&, \
                                                              EdgeRule);                           \
  template PixelWindow bounding_box(const std::array<Point<Number>, 3>&, const PixelWindow&);      \
  template void rasterize_triangle(const std::array<Point<Number>, 3>&, const PixelWindow&,        \
                                   const std::function<void(const CoveredPixel<Number>&)>&,        \
                                   EdgeRule);
FATHOM_INSTANTIATE(Exact)
FATHOM_INSTANTIATE(double)
FATHOM_INSTANTIATE(float)
#undef FATHOM_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace fathom::pipeline
