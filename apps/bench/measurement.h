#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "fathom/rendering/options.h"
#include "validation/child/fields.h"

namespace fathom::bench {

/// What is timed, and how often.
struct Plan {
  /// A name of scenes.h.
  std::string scene;
  std::uint32_t width = 1920, height = 1080;
  int threads = 1;
  int repeat = 9;
  /// What our engines write; the others always write depths.
  std::vector<Channel> channels{Channel::Z};
};

/// One renderer on one scene.
struct Measurement {
  /// fast, fast-kept, reference, vtk, embree, embree-robust, masked-occlusion-culling, or
  /// embree-build: building the hierarchy that embree then traces.
  std::string renderer;
  /// Its version and what it runs on; "" for our engines.
  std::string description;
  /// Time of the first frame, which also fills caches and compiles shaders.
  double first_ms = 0;
  /// Times of the frames after it, in increasing order; not empty.
  std::vector<double> milliseconds;
  /// The most memory that its process had in RAM while it rendered, less what it had before it made
  /// the scene: the scene as this renderer holds it, what the renderer builds, the image.
  std::uint64_t peak_bytes = 0;
  /// Pixels that show a surface; 0 for embree-build.
  std::uint64_t covered_pixels = 0;

  [[nodiscard]] double median_ms() const;
};

struct Frames {
  double first_ms = 0;
  /// In increasing order; only the first frame's time if that took all the time there is.
  std::vector<double> milliseconds;
};

/// Times `draw` once, keeps drawing until `warm_up` has passed (threads first have to find their
/// processors, and allocators their sizes), then times it `repeat` times more. Starts no frame
/// after 20 seconds. `clear` is called before each frame and not timed.
Frames time_frames(
    int repeat, const std::function<void()>& draw, const std::function<void()>& clear = [] {},
    std::chrono::milliseconds warm_up = std::chrono::milliseconds(300));

}  // namespace fathom::bench

namespace fathom::validation {

/// The names under which a measurement comes from its process.
template <>
struct Fields<bench::Measurement> {
  template <class Visit, class S>
  static void each(Visit&& visit, S& s) {
    auto& [renderer, description, first_ms, milliseconds, peak_bytes, covered_pixels] = s;
    visit("renderer", renderer);
    visit("description", description);
    visit("first_ms", first_ms);
    visit("milliseconds", milliseconds);
    visit("peak_bytes", peak_bytes);
    visit("covered_pixels", covered_pixels);
  }
};

}  // namespace fathom::validation
