#include "apps/render/map_warnings.h"

#include <fmt/core.h>

#include "fathom/image/depth_map.h"
#include "fathom/scene/scene_segments.h"
#include "fathom/text/counted.h"
#include "fathom/triangle/segment_channels.h"

namespace fathom::app {

void warn_of(const RenderStatistics& statistics, const Console& console) {
  if (statistics.triangles == 0) {
    console.warn("the scene has no triangle: the map is background");
  } else if (statistics.degenerate_triangles > 0) {
    console.warn(fmt::format("{} of {} {}", statistics.degenerate_triangles,
                             text::counted(statistics.triangles, "triangle"),
                             statistics.degenerate_triangles == 1
                                 ? "is degenerate or seen edge on and covers nothing"
                                 : "are degenerate or seen edge on and cover nothing"));
  }
}

void warn_of_missing_segments(const TriangleSource& triangles, const std::vector<Channel>& channels,
                              const Console& console) {
  const std::vector<Segmentation> wanted = segmentations_of(channels);
  if (wanted.empty()) return;
  const SceneSegments segments(triangles, wanted);
  for (const Segmentation by : wanted) {
    if (!segments.is_empty(by)) continue;
    const std::string_view name = description_of(channel_of(by)).name;
    console.warn(fmt::format("no triangle of the scene has a {}: channel {} is {} at all surfaces",
                             name, name, no_segment));
  }
}

}  // namespace fathom::app
