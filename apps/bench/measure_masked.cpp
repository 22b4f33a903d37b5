#include <algorithm>
#include <cmath>
#include <memory>

#include "apps/bench/masked_occlusion_culling/masked_buffer.h"
#include "apps/bench/measurement.h"
#include "apps/bench/resident_memory.h"

namespace fathom::bench {
namespace {

Frames time_drawing(MaskedBuffer& buffer, int repeat) {
  return time_frames(
      repeat, [&] { buffer.draw(); }, [&] { buffer.clear(); });
}

/// The fastest of its ways, on two frames of each.
MaskedWay fastest_way(const attribution::WorldMesh& mesh, const Camera& camera) {
  MaskedWay fastest;
  double least = INFINITY;
  for (const bool widest : {true, false}) {
    for (const bool vertices_first : {true, false}) {
      const MaskedWay way{widest, vertices_first};
      MaskedBuffer buffer(mesh, camera, way);
      const double time = time_drawing(buffer, 2).milliseconds.front();
      if (time < least) fastest = way;
      least = std::min(least, time);
    }
  }
  return fastest;
}

}  // namespace

bool masked_occlusion_culling_is_built() {
  return true;
}

std::vector<Measurement> measure_masked_occlusion_culling(BenchScene&& bench, const Plan& plan,
                                                          std::uint64_t idle_bytes) {
  if (!is_perspective(bench.camera.projection)) return {};
  attribution::WorldMesh mesh = attribution::world_mesh(bench.scene);
  bench.scene = {};
  MaskedBuffer buffer(mesh, bench.camera, fastest_way(mesh, bench.camera));
  mesh = {};
  forget_peak();

  Frames frames = time_drawing(buffer, plan.repeat);
  const std::uint64_t peak = peak_resident_bytes() - idle_bytes;
  const std::vector<float> depths = buffer.depths();
  const auto covered =
      std::count_if(depths.begin(), depths.end(), [](float depth) { return std::isfinite(depth); });
  return {{"masked-occlusion-culling", buffer.description(), frames.first_ms,
           std::move(frames.milliseconds), peak, static_cast<std::uint64_t>(covered)}};
}

}  // namespace fathom::bench
