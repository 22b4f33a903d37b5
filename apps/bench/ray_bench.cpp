#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "fathom/attribution/model/renderer_input.h"
#include "fathom/rays/cast.h"
#include "fathom/threads/threads.h"
#include "validation/embree/embree_mesh.h"
#include "validation/scenes/scenes.h"

/// Times nearest hits of rays in random order by cast() and by Embree's rtcIntersect1() with a
/// robust scene, in turns:
///   ray_bench [SCENE…] [--threads N] [--repeat N] [--rays N]
/// Rays begin around the scene and are aimed into it. Prints medians, and how often the triangles
/// differ.
namespace {

using namespace fathom;
using Clock = std::chrono::steady_clock;

double seconds_of(const std::function<void()>& work) {
  const auto start = Clock::now();
  work();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double median(std::vector<double> times) {
  std::ranges::sort(times);
  return times[times.size() / 2];
}

/// Of binary32 numbers, which both take as they are.
std::vector<Ray> some_rays(const WorldBounds& box, std::size_t count) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> place(-1, 1);
  const auto within = [&](double factor, double a, double b) {
    return static_cast<double>(static_cast<float>((a + b + place(random) * factor * (b - a)) / 2));
  };
  std::vector<Ray> rays(count);
  for (Ray& ray : rays) {
    for (std::size_t k = 0; k < 3; ++k) {
      ray.origin[k] = within(1.5, box.lower[k], box.upper[k]);
      ray.direction[k] =
          static_cast<float>(within(0.8, box.lower[k], box.upper[k]) - ray.origin[k]);
    }
  }
  return rays;
}

std::uint32_t nearest(RTCScene scene, const Ray& ray) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query = validation::query_of(ray.origin, ray.direction);
  rtcIntersect1(scene, &context, &query);
  return query.hit.primID;
}

void measure(const std::string& name, int threads, int repeat, std::size_t count) {
  const Scene scene = bench::make_scene(name, 1920, 1080).scene;
  const attribution::WorldMesh mesh = attribution::world_mesh(scene);
  const std::vector<Ray> rays = some_rays(attribution::box_of(mesh).value(), count);
  std::optional<RayScene> ours;
  std::optional<validation::EmbreeMesh> theirs;
  RTCScene their_scene = nullptr;
  const double our_build = seconds_of([&] { ours.emplace(scene, threads); });
  const double their_build = seconds_of([&] {
    theirs.emplace(mesh, threads);
    their_scene = theirs->build(RTC_SCENE_FLAG_ROBUST);
  });
  std::vector<double> our_times, their_times;
  std::vector<RayHit> hits;
  std::vector<std::uint32_t> triangles(count);
  for (int i = 0; i < repeat; ++i) {
    our_times.push_back(seconds_of([&] { hits = cast(*ours, rays, {.threads = threads}); }));
    their_times.push_back(seconds_of([&] {
      constexpr std::size_t together = 512;
      run_with_threads(threads, [&] {
        parallel_for(std::size_t{0}, (count + together - 1) / together, [&](std::size_t piece) {
          const std::size_t end = std::min(count, (piece + 1) * together);
          for (std::size_t k = piece * together; k < end; ++k)
            triangles[k] = nearest(their_scene, rays[k]);
        });
      });
    }));
  }
  std::size_t different = 0;
  for (std::size_t i = 0; i < count; ++i) different += triangles[i] != hits[i].triangle ? 1 : 0;
  const double mine = median(our_times), other = median(their_times);
  std::printf(
      "%-14s %9zu triangles, %d threads: %.2f M rays/s, Embree %.2f, ratio %.2f; build %.3f s, "
      "Embree %.3f; %.0f bytes a triangle; %zu of %zu triangles differ\n",
      name.c_str(), mesh.triangles.size(), threads, static_cast<double>(count) / mine * 1e-6,
      static_cast<double>(count) / other * 1e-6, other / mine, our_build, their_build,
      static_cast<double>(ours->bytes()) / static_cast<double>(mesh.triangles.size()), different,
      count);
}

}  // namespace

int main(int count, char** arguments) {
  std::vector<std::string> scenes;
  int threads = 1, repeat = 9;
  std::size_t rays = 400000;
  for (int i = 1; i < count; ++i) {
    const std::string word = arguments[i];
    if (word.starts_with("--") && i + 1 < count) {
      const int number = std::atoi(arguments[++i]);
      if (word == "--threads") threads = number;
      if (word == "--repeat") repeat = std::max(1, number);
      if (word == "--rays") rays = static_cast<std::size_t>(std::max(1, number));
    } else {
      scenes.push_back(word);
    }
  }
  if (scenes.empty()) scenes = {"sphere-20k", "sphere-200k", "soup", "sphere-2m"};
  for (const std::string& name : scenes) measure(name, threads, repeat, rays);
}
