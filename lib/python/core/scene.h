#pragma once

#include <memory>

#include "fathom/scene/scene.h"

namespace fathom::python {

/// The scene behind Python's Scene. What uses it has a pointer of its own meanwhile: a scene that
/// is in use is not changed, but copied (scene.cpp).
struct SharedScene {
  std::shared_ptr<Scene> scene = std::make_shared<Scene>();
};

}  // namespace fathom::python
