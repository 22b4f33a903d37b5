#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "apps/validate/faults/fault.h"
#include "fathom/camera/camera.h"
#include "validation/scenes/validation_scenes.h"

/// What becomes of right maps, for the catalogue.
namespace fathom::validation {

using MapChange = std::function<void(attribution::OtherMap&, const RightMap&, double)>;

/// Every depth of a surface becomes `f(depth)`, rounded to binary32; the background stays.
MapChange each_depth(std::function<double(double depth, double size, const Camera& camera)> f);
/// The background becomes a value.
MapChange background_as(double value);
/// The value of the background that depends on the camera.
MapChange background_of(std::function<double(const Camera& camera)> value);
/// One change after the other.
MapChange both(MapChange first, MapChange second);
/// The map as it is `columns`, `rows` further.
MapChange moved_by(int columns, int rows);
MapChange mirrored(bool x, bool y);
/// Each pixel is the mean of `size` × `size` ones about it, the background counting as far.
MapChange averaged(int size);
/// `count` pixels with a surface become `f(depth)`, at random but always the same.
MapChange some_pixels(std::size_t count, std::function<double(double depth)> f);
/// A share of the pixels with a surface.
MapChange share_of_pixels(double share, std::function<double(double depth)> f);
/// Rows (or columns) from `first` to `last`, as parts of the image, hold a value.
MapChange lines_as(bool rows, double first, double last, double value);
/// One row (or column), at a part of the image, holds a value.
MapChange line_as(bool rows, double at, double value);
/// Removes surfaces nearer (or farther) than a quantile of the depths.
MapChange clipped_at(bool near, double share);
/// Depth is interpolated linearly in the image over each triangle.
MapChange affine_depths();
/// Distances along the rays.
MapChange ray_distances();

/// The window depth of [0, 1] of a perspective camera, 0 at near and 1 at far, and back.
double to_window(double depth, double near, double far);
double from_window(double window, double near, double far);

// Changed scenes and cameras that a renderer draws for the catalogue of faults.

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
