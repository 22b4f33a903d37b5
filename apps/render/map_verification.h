#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/shell/console.h"
#include "fathom/camera/camera.h"
#include "fathom/image/depth_map.h"
#include "fathom/scene/triangle_source.h"
#include "fathom/triangle/options.h"

namespace fathom::app {

/// What a map was rendered from, and how many random pixels to compute again.
struct VerificationRequest {
  TriangleSource triangles;
  const Camera& camera;
  const RenderOptions& options;
  std::uint64_t pixels;
};

/// `render --verify`: computes pixels of the map again by exact arithmetic, chosen at random and,
/// of the fast engine's map, all at which one of its bounds nearly failed to settle a decision: it
/// would have, had it been 16 times as wide. `render` renders the same map with other options. Says
/// how the map fares and notes it in the report; false where it is not exact.
bool verify_map(const DepthMap& map, const std::string& name, const VerificationRequest& request,
                const std::function<void(const RenderOptions&)>& render, const Console& console,
                nlohmann::ordered_json& report);

}  // namespace fathom::app
