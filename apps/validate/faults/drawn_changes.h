#pragma once

#include <array>
#include <cstddef>
#include <functional>

#include "fathom/camera/camera.h"
#include "validation/scenes/validation_scenes.h"

/// Changed scenes and cameras that a renderer draws for the catalogue of faults.
namespace fathom::validation {

using CameraChange = std::function<void(Camera& camera, double size)>;
using SceneChange = std::function<ValidationScene(const ValidationScene& scene, double size)>;

SceneChange with_camera(CameraChange change);

/// X′ = turn (a rotation vector, rad) applied to X, plus move (scene units), in the camera's frame.
void turn_and_move(Camera& camera, const std::array<double, 3>& turn,
                   const std::array<double, 3>& move);

/// Without the `count` triangles that the most pixels show.
SceneChange without_triangles(std::size_t count);
/// Without triangles that face the camera: most visible triangles of a closed mesh.
SceneChange without_facing_triangles();

}  // namespace fathom::validation
