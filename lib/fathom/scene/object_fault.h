#pragma once

#include <optional>
#include <string>

#include "fathom/scene/scene.h"
#include "fathom/scene/streamed_scene.h"

namespace fathom::scene {

/// The part of find_fault() that looks at no mesh: whether objects name meshes that are there, and
/// their triangles can be counted.
std::optional<std::string> find_fault_of_objects(const Scene& scene);
std::optional<std::string> find_fault_of_objects(const StreamedScene& scene);

/// Fails    InputError, "scene: " and the fault, if there is one.
void require(const std::optional<std::string>& no_fault);

}  // namespace fathom::scene
