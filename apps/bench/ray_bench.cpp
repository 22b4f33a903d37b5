#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "fathom/rays/cast.h"
#include "fathom/threads/threads.h"
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
std::vector<Ray> some_rays(const Scene& scene, std::size_t count) {
  MeshPoint low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  for (const MeshPoint& p : scene.meshes[0].vertices) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> place(-1, 1);
  const auto within = [&](double factor, double a, double b) {
    return static_cast<double>(static_cast<float>((a + b + place(random) * factor * (b - a)) / 2));
  };
  std::vector<Ray> rays(count);
  for (Ray& ray : rays) {
    const std::array<double, 3> lower{low.x, low.y, low.z}, upper{high.x, high.y, high.z};
    for (std::size_t k = 0; k < 3; ++k) {
      ray.origin[k] = within(1.5, lower[k], upper[k]);
      ray.direction[k] = static_cast<float>(within(0.8, lower[k], upper[k]) - ray.origin[k]);
    }
  }
  return rays;
}

/// One mesh in Embree.
class EmbreeScene {
 public:
  EmbreeScene(const Mesh& mesh, int threads)
      : device_(rtcNewDevice(("threads=" + std::to_string(threads)).c_str())),
        scene_(rtcNewScene(device_)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* const vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), mesh.vertices.size()));
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      const MeshPoint& p = mesh.vertices[i];
      const std::array<double, 3> x{p.x, p.y, p.z};
      for (std::size_t k = 0; k < 3; ++k) vertices[3 * i + k] = static_cast<float>(x[k]);
    }
    auto* const triangles = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), mesh.triangles.size()));
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
      std::ranges::copy(mesh.triangles[i], triangles + 3 * i);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;
  ~EmbreeScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  [[nodiscard]] std::uint32_t nearest(const Ray& ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query{};
    query.ray.org_x = static_cast<float>(ray.origin[0]);
    query.ray.org_y = static_cast<float>(ray.origin[1]);
    query.ray.org_z = static_cast<float>(ray.origin[2]);
    query.ray.dir_x = static_cast<float>(ray.direction[0]);
    query.ray.dir_y = static_cast<float>(ray.direction[1]);
    query.ray.dir_z = static_cast<float>(ray.direction[2]);
    query.ray.tfar = std::numeric_limits<float>::infinity();
    query.ray.mask = 0xFFFFFFFF;
    query.hit.geomID = query.hit.primID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context, &query);
    return query.hit.primID;
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

void measure(const std::string& name, int threads, int repeat, std::size_t count) {
  const Scene scene = bench::make_scene(name, 1920, 1080).scene;
  const std::vector<Ray> rays = some_rays(scene, count);
  std::optional<RayScene> ours;
  std::optional<EmbreeScene> theirs;
  const double our_build = seconds_of([&] { ours.emplace(scene, threads); });
  const double their_build = seconds_of([&] { theirs.emplace(scene.meshes[0], threads); });
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
            triangles[k] = theirs->nearest(rays[k]);
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
      name.c_str(), scene.meshes[0].triangles.size(), threads,
      static_cast<double>(count) / mine * 1e-6, static_cast<double>(count) / other * 1e-6,
      other / mine, our_build, their_build,
      static_cast<double>(ours->bytes()) / static_cast<double>(scene.meshes[0].triangles.size()),
      different, count);
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
