#pragma once

#include <memory>

#include "fathom/image/depth_map.h"
#include "fathom/scene/scene.h"

namespace fathom::python {

/// The scene behind Python's Scene. What uses it has a pointer of its own meanwhile: a scene that
/// is in use is not changed, but copied (scene.cpp).
struct SharedScene {
  std::shared_ptr<Scene> scene = std::make_shared<Scene>();
};

/// The map behind Python's Map: all of it but, where Python has taken them as arrays, its channels.
using SharedMap = std::shared_ptr<DepthMap>;

}  // namespace fathom::python
