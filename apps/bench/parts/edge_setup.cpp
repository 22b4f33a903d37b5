#include "apps/bench/parts/edge_setup.h"

#include <algorithm>
#include <cstdlib>
#include <optional>

#include "fathom/pipeline/geometry/geometry_stages.h"
#include "fathom/pipeline/geometry/vertex_transform.h"

namespace fathom::bench {
namespace {

/// Pixels first ≤ i < end whose centres lie between two places, and in an image of `size` pixels.
struct PixelRange {
  std::int64_t first, end;
};
PixelRange centres_between(std::int64_t least, std::int64_t greatest, std::uint32_t size) {
  constexpr std::int64_t half = steps_per_pixel / 2;
  // Shifting rounds down.
  const std::int64_t first = (least + half - 1) >> snapped_bits;
  const std::int64_t end = (greatest + half) >> snapped_bits;
  return {std::max<std::int64_t>(first, 0), std::min<std::int64_t>(end, size)};
}

std::optional<EdgeSetup> set_up(const SnappedTriangle& triangle, const SnappedScene& scene,
                                EdgeRule rule) {
  const auto& [a, b, c] = triangle.corners;
  const std::int64_t twice_area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  if (twice_area == 0) return std::nullopt;
  const PixelRange x =
      centres_between(std::min({a.x, b.x, c.x}), std::max({a.x, b.x, c.x}), scene.width);
  const PixelRange y =
      centres_between(std::min({a.y, b.y, c.y}), std::max({a.y, b.y, c.y}), scene.height);
  if (x.first >= x.end || y.first >= y.end) return std::nullopt;
  EdgeSetup s{.first_column = static_cast<std::int32_t>(x.first),
              .first_row = static_cast<std::int32_t>(y.first),
              .columns = static_cast<std::int32_t>(x.end - x.first),
              .rows = static_cast<std::int32_t>(y.end - y.first)};
  const GridPlace origin{x.first * steps_per_pixel + steps_per_pixel / 2,
                         y.first * steps_per_pixel + steps_per_pixel / 2};
  const std::int64_t sign = twice_area > 0 ? 1 : -1;
  const auto area = static_cast<double>(sign * twice_area);
  for (std::size_t k = 0; k < 3; ++k) {
    const GridPlace &p = triangle.corners[(k + 1) % 3], &q = triangle.corners[(k + 2) % 3];
    const std::int64_t by_x = sign * (p.y - q.y), by_y = sign * (q.x - p.x);
    s.start[k] = by_x * (origin.x - p.x) + by_y * (origin.y - p.y);
    s.right[k] = by_x * steps_per_pixel;
    s.down[k] = by_y * steps_per_pixel;
    const bool left_or_top = by_x > 0 || (by_x == 0 && by_y > 0);
    s.least[k] = left_or_top || rule == EdgeRule::closed ? 0 : 1;
    s.depth += static_cast<double>(s.start[k]) / area * triangle.depths[k];
    s.depth_right += static_cast<double>(s.right[k]) / area * triangle.depths[k];
    s.depth_down += static_cast<double>(s.down[k]) / area * triangle.depths[k];
  }
  return s;
}

}  // namespace

SnappedScene snapped(const BenchScene& bench) {
  pipeline::PipelineOptions options;
  options.precision = pipeline::Precision::binary64;
  options.subpixel_bits = snapped_bits;
  options.shading = pipeline::Shading::none;
  pipeline::fill_in_range(bench.scene, bench.camera, options.depth_format);
  pipeline::PipelineStatistics statistics;
  const auto primitives =
      pipeline::to_window<double>(bench.scene, bench.camera, options,
                                  pipeline::draw_rules_of(bench.scene, options), statistics);
  SnappedScene result{bench.camera.width, bench.camera.height, {}};
  result.triangles.reserve(primitives.triangles.size());
  for (const auto& triangle : primitives.triangles) {
    const auto corners = pipeline::snapped(triangle, snapped_bits);
    SnappedTriangle& t = result.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      constexpr int unused = pipeline::grid_bits - snapped_bits;
      t.corners[k] = {corners[k].x >> unused, corners[k].y >> unused};
      t.depths[k] = triangle.corners[k].z;
    }
  }
  return result;
}

bool EdgeSetup::fits_binary32() const {
  constexpr std::int64_t most = std::int64_t{1} << 24;
  for (std::size_t k = 0; k < 3; ++k) {
    // Products are multiples of 256, sums are not; all of them are greatest at an end of the box.
    const std::int64_t across = right[k] * (columns - 1), along = down[k] * (rows - 1);
    if (std::max(std::abs(across), std::abs(along)) > most * steps_per_pixel) return false;
    for (const std::int64_t sum :
         {start[k], start[k] + along, start[k] + across, start[k] + along + across}) {
      if (std::abs(sum) > most) return false;
    }
  }
  return true;
}

std::vector<EdgeSetup> set_up_edges(const SnappedScene& scene, EdgeRule rule) {
  std::vector<EdgeSetup> setups;
  for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
    if (auto setup = set_up(scene.triangles[i], scene, rule)) {
      setup->number = static_cast<std::uint32_t>(i);
      setups.push_back(*setup);
    }
  }
  return setups;
}

}  // namespace fathom::bench
