#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "apps/shell/console.h"
#include "fathom/image/deep_map.h"
#include "fathom/scene/view_warnings.h"

namespace fathom::app {

/// What is probably not meant about the cameras of a path, each kind of it told once.
class CameraWarnings {
 public:
  /// Of a camera whose map shows the scene in so many pixels.
  void note(const Scene& scene, const Camera& camera, std::uint64_t shown_pixels) {
    of_cameras_.push_back(view_warnings(scene, camera, shown_pixels));
  }
  void note(const Scene& scene, const Camera& camera, const DeepMap& map) {
    const auto shown = std::ranges::count_if(map.counts, [](std::uint32_t n) { return n > 0; });
    note(scene, camera, static_cast<std::uint64_t>(shown));
  }
  void tell(const Console& console) const { console.warn(told_once(of_cameras_)); }

 private:
  std::vector<std::vector<ViewWarning>> of_cameras_;
};

}  // namespace fathom::app
