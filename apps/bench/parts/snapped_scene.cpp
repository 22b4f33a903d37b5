#include "apps/bench/parts/snapped_scene.h"

#include "fathom/pipeline/geometry/geometry_stages.h"
#include "fathom/pipeline/geometry/vertex_transform.h"

namespace fathom::bench {

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

}  // namespace fathom::bench
