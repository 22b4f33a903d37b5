#include "apps/bench/parts/exact_picture.h"

#include <algorithm>
#include <functional>

#include "apps/study/course/demo.h"

namespace fathom::bench {
namespace {

int sign_of(std::int64_t x) {
  return (x > 0) - (x < 0);
}

/// On which side of the line from p to q a place is; on the line, the side of a place just to the
/// right or, if that is on it too, just below.
int side(const GridPlace& p, const GridPlace& q, const GridPlace& place, EdgeRule rule) {
  const int certain = sign_of((q.x - p.x) * (place.y - p.y) - (q.y - p.y) * (place.x - p.x));
  if (certain != 0 || rule == EdgeRule::closed) return certain;
  return p.y != q.y ? sign_of(p.y - q.y) : sign_of(q.x - p.x);
}

bool has_area(const SnappedTriangle& t) {
  return side(t.corners[0], t.corners[1], t.corners[2], EdgeRule::closed) != 0;
}

/// visit(number, column, row) for each pixel that each triangle covers, in order of the triangles.
void for_each_covered(
    const SnappedScene& scene, EdgeRule rule,
    const std::function<void(std::uint32_t, std::uint32_t, std::uint32_t)>& visit) {
  for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
    const SnappedTriangle& t = scene.triangles[i];
    // The pixels around the triangle, and one more on each side.
    const auto [left, right] = std::minmax({t.corners[0].x, t.corners[1].x, t.corners[2].x});
    const auto [top, bottom] = std::minmax({t.corners[0].y, t.corners[1].y, t.corners[2].y});
    const auto begin = [](std::int64_t place) {
      return std::max<std::int64_t>(place / steps_per_pixel - 1, 0);
    };
    const auto end = [](std::int64_t place, std::uint32_t size) {
      return std::min<std::int64_t>(place / steps_per_pixel + 2, size);
    };
    for (std::int64_t row = begin(top); row < end(bottom, scene.height); ++row) {
      for (std::int64_t column = begin(left); column < end(right, scene.width); ++column) {
        if (covers(t, column, row, rule)) {
          visit(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(column),
                static_cast<std::uint32_t>(row));
        }
      }
    }
  }
}

}  // namespace

bool covers(const SnappedTriangle& t, std::int64_t column, std::int64_t row, EdgeRule rule) {
  if (!has_area(t)) return false;
  const GridPlace centre{column * steps_per_pixel + steps_per_pixel / 2,
                         row * steps_per_pixel + steps_per_pixel / 2};
  bool all_left = true, all_right = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const int s = side(t.corners[k], t.corners[(k + 1) % 3], centre, rule);
    all_left &= s >= 0;
    all_right &= s <= 0;
  }
  return all_left || all_right;
}

Picture exact_layers(const SnappedScene& scene, EdgeRule rule) {
  Picture layers(std::size_t{scene.width} * scene.height);
  for_each_covered(scene, rule, [&](std::uint32_t i, std::uint32_t column, std::uint32_t row) {
    layers[std::size_t{row} * scene.width + column] += EdgeSetup{.number = i}.weight();
  });
  return layers;
}

Picture exact_nearest(const SnappedScene& scene) {
  const std::size_t pixels = std::size_t{scene.width} * scene.height;
  Picture nearest(pixels, 1);
  nearest.resize(2 * pixels, 0);
  const std::vector<EdgeSetup> planes = set_up_edges(scene);
  std::size_t next = 0;
  for_each_covered(scene, EdgeRule::half_open,
                   [&](std::uint32_t i, std::uint32_t column, std::uint32_t row) {
                     while (planes[next].number != i) ++next;
                     const EdgeSetup& s = planes[next];
                     const double x = column - static_cast<double>(s.first_column);
                     const double y = row - static_cast<double>(s.first_row);
                     const double depth = (s.depth + s.depth_down * y) + s.depth_right * x;
                     const std::size_t pixel = std::size_t{row} * scene.width + column;
                     if (!(depth < nearest[pixel])) return;
                     nearest[pixel] = depth;
                     nearest[pixels + pixel] = i + 1.0;
                   });
  return nearest;
}

std::uint64_t covered_pixels(const SnappedScene& scene, EdgeRule rule) {
  std::uint64_t count = 0;
  for_each_covered(scene, rule, [&](std::uint32_t, std::uint32_t, std::uint32_t) { ++count; });
  return count;
}

std::vector<RuleCounts> closed_edges_of_demo() {
  const studies::Demo demo = studies::demo();
  return {{"demo, near triangle", demo.near_fragments, demo.near_closed},
          {"demo, far triangle", demo.far_fragments, demo.far_closed}};
}

RuleCounts closed_edges(const std::string& name, const SnappedScene& scene) {
  return {name, covered_pixels(scene, EdgeRule::half_open),
          covered_pixels(scene, EdgeRule::closed)};
}

}  // namespace fathom::bench
