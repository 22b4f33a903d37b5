#include "apps/bench/measurement.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "apps/bench/machine.h"
#include "apps/bench/resident_memory.h"
#include "fathom/failures/errors.h"
#include "fathom/render.h"
#include "validation/child/in_child.h"
#include "validation/scenes/scenes.h"

namespace fathom::bench {
namespace {

using Clock = std::chrono::steady_clock;

}  // namespace

double median_of(const std::vector<double>& sorted) {
  const std::size_t half = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
}

double Measurement::median_ms() const {
  return median_of(milliseconds);
}

Frames time_frames(int repeat, const std::function<void()>& draw,
                   const std::function<void()>& clear, std::chrono::milliseconds warm_up) {
  const auto timed = [&] {
    clear();
    const Clock::time_point start = Clock::now();
    draw();
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  };
  const Clock::time_point start = Clock::now();
  Frames frames{.first_ms = timed()};
  while (Clock::now() - start < warm_up) timed();
  for (int i = 0; i < repeat && Clock::now() - start < time_there_is; ++i) {
    frames.milliseconds.push_back(timed());
  }
  if (frames.milliseconds.empty()) frames.milliseconds.push_back(frames.first_ms);
  std::sort(frames.milliseconds.begin(), frames.milliseconds.end());
  return frames;
}

namespace {

std::uint64_t covered_pixels(const DepthMap& map) {
  const Samples<float>* Z = map.values<float>("Z");
  if (Z == nullptr) return 0;
  const auto covered = std::count_if(Z->begin(), Z->end(), [](float z) { return !std::isinf(z); });
  return static_cast<std::uint64_t>(covered);
}

/// What one frame leaves to the next.
enum class Kept { nothing, map_and_memory };

std::vector<Measurement> measure_engine(const std::string& name, Engine engine, Kept kept,
                                        const BenchScene& bench, const Plan& plan,
                                        std::uint64_t idle_bytes) {
  const RenderOptions options{.engine = engine, .channels = plan.channels, .threads = plan.threads};
  RenderMemory memory;
  const RenderContext context{.kept = kept == Kept::map_and_memory ? &memory : nullptr};
  forget_peak();
  Rendered rendered;
  Frames frames = time_frames(
      plan.repeat, [&] { render_into(rendered, bench.scene, bench.camera, options, context); },
      [&] {
        if (kept == Kept::nothing) rendered = {};
      });
  return {{name, "", frames.first_ms, std::move(frames.milliseconds),
           peak_resident_bytes() - idle_bytes, covered_pixels(rendered.map)}};
}

}  // namespace

std::vector<Measurement> measure(const std::string& renderer, const Plan& plan) {
  const std::uint64_t idle_bytes = resident_bytes();
  BenchScene bench = make_scene(plan.scene, plan.width, plan.height);
  keep_to_processors(plan.threads);
  const auto engine = [&](Engine which, Kept kept) {
    return measure_engine(renderer, which, kept, bench, plan, idle_bytes);
  };
  if (renderer == "fast") return engine(Engine::fast, Kept::nothing);
  if (renderer == "fast-kept") return engine(Engine::fast, Kept::map_and_memory);
  if (renderer == "reference") return engine(Engine::reference, Kept::nothing);
  if (renderer == "vtk") return measure_vtk(std::move(bench), plan, idle_bytes);
  if (renderer == "embree") return measure_embree(std::move(bench), plan, false, idle_bytes);
  if (renderer == "embree-robust") return measure_embree(std::move(bench), plan, true, idle_bytes);
  if (renderer == "masked-occlusion-culling") {
    return measure_masked_occlusion_culling(std::move(bench), plan, idle_bytes);
  }
  throw UsageError("'" + renderer + "' is no renderer");
}

std::vector<Measurement> measure_in_child(const std::string& renderer, const Plan& plan) {
  return validation::in_child([&] { return measure(renderer, plan); });
}

std::uint64_t count_triangles_in_child(const Plan& plan) {
  return validation::in_child(
      [&] { return triangle_count(make_scene(plan.scene, plan.width, plan.height).scene); });
}

}  // namespace fathom::bench
