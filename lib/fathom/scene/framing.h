#pragma once

#include <cstdint>
#include <vector>

#include "fathom/camera/camera_making.h"
#include "fathom/scene/bounds.h"

/// Cameras that see a whole scene.
namespace fathom {

/// The camera in the direction of `view` that sees the whole of `bounds` with a margin of a
/// twentieth of the image or more on every side, looking at its middle: every point inside projects
/// into the image (proved exactly for the camera that is returned, by its eight corners). Bounds of
/// a single point are seen from a distance of 1. Lens::vertical_extent is chosen if it is not
/// given; if it is, only the distance is.
///
/// Fails    UsageError if the view or the lens cannot be; InputError if no camera with finite
///          numbers does it (bounds that reach to 1e308).
Camera frame(const WorldBounds& bounds, const View& view = {}, const Lens& lens = {});

/// A camera path around `bounds`, each camera looking at its middle from the same distance, chosen
/// so that every camera sees all of it.
/// Fails    UsageError as frame, and if count is 0.
std::vector<Camera> orbit(const View& first, std::uint32_t count, const WorldBounds& bounds,
                          const Lens& lens = {});

/// The camera that frames a scene: frame() on its world_bounds.
/// Fails    UsageError as frame; InputError if the scene has no triangle.
Camera frame_scene(const Scene& scene, const View& view = {}, const Lens& lens = {});

}  // namespace fathom
