#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/reference/probe.h"
#include "fathom/scene/scene.h"

namespace fathom::app {

/// The pixel that is probed, and the triangles found there.
struct Probe {
  const Scene& scene;
  const Camera& camera;
  std::uint32_t x = 0, y = 0;
  std::vector<CoveringTriangle> triangles;
};

/// Every triangle with its corners, signs, depth and the rule that decided about it: the answer of
/// `fathom probe`, and of the server of `fathom view`.
std::string as_text(const Probe& probe);
std::string as_json(const Probe& probe);

}  // namespace fathom::app
