#pragma once

#include <string>

#include "fathom/scene/scene.h"

namespace fathom::scene {

/// The object that reaches farthest from the origin of the world, the first of several, for the
/// message that no camera frames the scene: "FILE: object NAME". The scene has a triangle.
std::string name_of_farthest_object(const Scene& scene);

}  // namespace fathom::scene
