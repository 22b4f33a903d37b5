#pragma once

#include <memory>

#include "fathom/scene/scene.h"

namespace fathom::python {

/// The scene behind Python's Scene. Adding to it makes another one, so that a call of another
/// thread goes on with what it was given.
struct SharedScene {
  std::shared_ptr<const Scene> scene = std::make_shared<const Scene>();
};

}  // namespace fathom::python
