#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/render/render_plan.h"
#include "apps/shell/console.h"
#include "fathom/depth_buffer/depth_buffer.h"
#include "fathom/image/channel_table.h"
#include "fathom/image/deep_map.h"
#include "fathom/rendering/options.h"
#include "fathom/rendering/rendered.h"
#include "fathom/scene/triangle_source.h"
#include "fathom/scene/view_warnings.h"

namespace fathom::app {

/// Warns if a scene shows nothing, or less than expected.
void warn_of(const RenderStatistics& statistics, const Console& console);

/// Warnings about channels that will be empty because the scene has no such data.
void warn_of_missing_segments(const TriangleSource& triangles, const std::vector<Channel>& channels,
                              const Console& console);

/// A hint for users who write their first EXR with depths into a folder, probably for other
/// programs: how OpenCV and imageio find the depth. Empty for other maps and folders.
std::string hint_for_first_exr(const std::string& map, const MapPlan& plan);

/// A hint for users who write depths seen through a lens and no other channel that gives points:
/// how to get a point cloud. Empty for other cameras and maps.
std::string hint_for_lens(const Camera& camera, const MapPlan& plan);

/// Warnings about suspicious cameras of a path, each kind once.
class CameraWarnings {
 public:
  /// Takes note of a camera whose map shows the scene in this many pixels.
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

struct MapVerification {
  /// Pixels that were computed again, and how many of them differ.
  std::uint64_t verified = 0, differing = 0;
  /// Verified pixels at which a bound of the fast engine nearly failed to settle a decision.
  std::uint64_t nearly_unsettled = 0;

  [[nodiscard]] bool agrees() const { return differing == 0; }
};

/// The depth buffer that was added to a map.
struct DepthBufferReport {
  DepthFormat format;
  bool against_exact = false;
  DepthBufferStatistics seen;
};

/// The entry of a map in `render --stats`.
struct MapReport {
  std::string map;  ///< the name of the file
  Engine engine = Engine::fast;
  std::uint32_t width = 0, height = 0;
  RenderStatistics statistics;
  std::optional<MapVerification> verification;
  std::optional<DepthBufferReport> depth_buffer;
  struct {
    double read = 0, render = 0, write = 0, verify = 0, depth_format = 0;
  } seconds;
};

/// An object for a single map, a list for several.
std::string as_json(const std::vector<MapReport>& maps);

}  // namespace fathom::app
