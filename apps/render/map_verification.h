#pragma once

#include <cstdint>
#include <functional>
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
  /// Renders the same map with other options.
  std::function<void(const RenderOptions&)> render;
};

struct MapVerification {
  /// Pixels that were computed again, and how many of them differ.
  std::uint64_t verified = 0, differing = 0;
  /// Of the verified ones, those at which a bound of the fast engine nearly failed to settle a
  /// decision.
  std::uint64_t nearly_unsettled = 0;

  [[nodiscard]] bool agrees() const { return differing == 0; }
};

/// `render --verify`: computes pixels of the map again by exact arithmetic, chosen at random and,
/// of the fast engine's map, all at which one of its bounds nearly failed to settle a decision: it
/// would have, had it been 16 times as wide. Says how the map, called `name`, fares.
MapVerification verify_map(const DepthMap& map, const std::string& name,
                           const VerificationRequest& request, const Console& console);

}  // namespace fathom::app
