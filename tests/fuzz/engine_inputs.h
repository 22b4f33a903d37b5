#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "fathom/fast/render_fast.h"
#include "fathom/reference/reference.h"
#include "tests/inputs/scene_building.h"

/// Scenes and cameras from bytes, for the fuzzers of the engines.
namespace fathom::fuzz {

/// Bytes as small numbers: few bits make ties, and a byte now and then moves a coordinate to its
/// neighbour or multiplies it by a power of two.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  [[nodiscard]] bool is_empty() const { return size_ == 0; }
  /// 0 at the end.
  int next() {
    if (size_ == 0) return 0;
    --size_;
    return *data_++;
  }
  int below(int n) { return next() % n; }

  double coordinate() {
    const int form = next();
    double x = std::ldexp(static_cast<std::int8_t>(next()), -form % 8);
    if (form & 64) x = std::nextafter(x, form & 32 ? 1e9 : -1e9);
    if (form & 128) x = std::ldexp(x, below(121) - 60);
    return x;
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
};

inline Camera camera_from(Bytes& bytes) {
  const int form = bytes.next();
  const auto width = static_cast<std::uint32_t>(1 + bytes.below(80));
  const auto height = static_cast<std::uint32_t>(1 + bytes.below(20));
  Camera camera = checks::camera_of(width, height, 1 + bytes.below(64));
  if (form & 1) camera.projection.model = ProjectionModel::orthographic;
  if (form & 2) camera.projection.fy = -camera.projection.fy;
  if (form & 4) camera.projection.skew = bytes.coordinate();
  if (form & 8) camera.near = std::abs(bytes.coordinate());
  if (form & 16) camera.far = camera.near + std::abs(bytes.coordinate());
  if (form & 32) {
    for (auto& row : camera.world_to_camera) {
      for (double& entry : row) entry = bytes.below(5) - 2;
    }
  }
  if (form & 64) camera.world_to_camera[2][3] = bytes.coordinate();
  return camera;
}

inline bool are_same(const DepthMap& a, const DepthMap& b) {
  for (std::size_t k = 0; k < a.channels.size(); ++k) {
    const bool same = std::visit(
        [&](const auto& values) {
          const auto& others = std::get<std::decay_t<decltype(values)>>(b.channels[k].values);
          return std::memcmp(values.data(), others.data(), values.size() * sizeof(values[0])) == 0;
        },
        a.channels[k].values);
    if (!same) return false;
  }
  return true;
}

/// Options from a byte, for a thread of its own.
inline RenderOptions options_from(Bytes& bytes) {
  RenderOptions options;
  options.threads = 1;
  options.channels = {Channel::Z, Channel::A, Channel::id};
  const int form = bytes.next();
  if (form & 1) {
    options.channels = {Channel::Z,  Channel::A, Channel::Zlow, Channel::distance,
                        Channel::id, Channel::N, Channel::P,    Channel::bary};
  }
  options.cull = form & 2 ? Cull::back : form & 4 ? Cull::front : Cull::none;
  return options;
}

/// Ends the program unless both engines give the same map, bit for bit.
inline void expect_same_maps(const Scene& scene, const Camera& camera,
                             const RenderOptions& options) {
  const DepthMap truth = render_reference(scene, camera, options).map;
  if (!are_same(render_fast(scene, camera, options).map, truth)) std::abort();
}

}  // namespace fathom::fuzz
