#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "apps/bench/measurement.h"
#include "apps/bench/resident_memory.h"
#include "fathom/attribution/model/renderer_input.h"
#include "validation/embree/embree_tracer.h"
#include "validation/vtk/vtk_renderer.h"

namespace fathom::bench {
namespace {

using attribution::WorldMesh;
using validation::EmbreeTracer;
using validation::RayStream;
using validation::VtkRenderer;

/// The scene as peers take it; it itself goes.
WorldMesh handed_over(Scene& scene) {
  WorldMesh mesh = attribution::world_mesh(scene);
  scene = {};
  return mesh;
}

/// The faster of the two ways to hand rays to Embree, on two frames of each.
RayStream faster_stream(const EmbreeTracer& tracer, const Camera& camera,
                        std::vector<float>& depths) {
  const auto best = [&](RayStream stream) {
    return time_frames(2, [&] { tracer.trace(camera, stream, depths); }).milliseconds.front();
  };
  return best(RayStream::packets) < best(RayStream::arrays) ? RayStream::packets
                                                            : RayStream::arrays;
}

}  // namespace

bool peers_are_built() {
  return true;
}

std::vector<Measurement> measure_vtk(BenchScene bench, const Plan& plan, std::uint64_t idle_bytes) {
  // Read by Mesa's software renderer when the context is made; 16 is the most it takes.
  ::setenv("LP_NUM_THREADS", std::to_string(std::min(plan.threads, 16)).c_str(), 1);
  WorldMesh mesh = handed_over(bench.scene);
  VtkRenderer renderer(mesh, bench.camera, attribution::clip_range(mesh, bench.camera));
  mesh = {};
  forget_peak();

  Frames frames = time_frames(plan.repeat, [&] { renderer.draw(); });
  const std::uint64_t peak = peak_resident_bytes() - idle_bytes;
  const std::vector<float> depths = renderer.window_depths();
  const auto covered =
      std::count_if(depths.begin(), depths.end(), [](float depth) { return depth < 1; });
  return {{"vtk", renderer.description(), frames.first_ms, std::move(frames.milliseconds), peak,
           static_cast<std::uint64_t>(covered)}};
}

std::vector<Measurement> measure_embree(BenchScene bench, const Plan& plan, bool robust,
                                        std::uint64_t idle_bytes) {
  WorldMesh mesh = handed_over(bench.scene);
  EmbreeTracer tracer(mesh, {.robust = robust, .threads = plan.threads});
  mesh = {};
  forget_peak();

  const std::string description = EmbreeTracer::description();
  std::vector<Measurement> measurements;
  Frames builds = time_frames(robust ? 0 : std::min(plan.repeat, 5), [&] { tracer.build(); });
  if (!robust) {
    measurements.push_back({"embree-build", description, builds.first_ms,
                            std::move(builds.milliseconds), peak_resident_bytes() - idle_bytes, 0});
  }
  std::vector<float> depths;
  const RayStream stream = faster_stream(tracer, bench.camera, depths);
  Frames frames = time_frames(plan.repeat, [&] { tracer.trace(bench.camera, stream, depths); });
  const auto covered =
      std::count_if(depths.begin(), depths.end(), [](float depth) { return std::isfinite(depth); });
  measurements.push_back({robust ? "embree-robust" : "embree", description, frames.first_ms,
                          std::move(frames.milliseconds), peak_resident_bytes() - idle_bytes,
                          static_cast<std::uint64_t>(covered)});
  return measurements;
}

}  // namespace fathom::bench
