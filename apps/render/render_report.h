#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/render/depth_buffer_channels.h"
#include "apps/render/map_verification.h"
#include "fathom/triangle/options.h"

namespace fathom::app {

/// What `render --stats` says of a map.
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
