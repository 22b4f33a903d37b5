#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "fathom/camera/camera_making.h"
#include "fathom/scene/bounds.h"

/// Cameras that see a whole scene.
namespace fathom {

/// The camera in the direction of `view` that looks at the middle of `bounds` and sees the whole of
/// them with a margin of at least a twentieth of the image on every side: every point inside
/// projects into the image (proved exactly for the returned camera, by the eight corners). Bounds
/// of a single point are seen from a distance of 1 scene unit. The vertical extent of the lens is
/// chosen if it is not given; if it is, only the distance is chosen.
///
/// Fails    UsageError if the view or the lens is not valid; InputError if no camera with finite
///          numbers does it (bounds that reach to 1e308).
Camera frame(const WorldBounds& bounds, const View& view = {}, const LensChoice& lens = {});

/// A camera path around `bounds`: each camera looks at their middle, from the same distance, chosen
/// so that every camera sees all of them. progress, if given, is called now and then with the
/// fraction done; an exception from it ends the call.
/// Fails    UsageError as frame(), and if count is 0 or above 1,000,000; InputError as frame().
std::vector<Camera> orbit(const View& first, std::uint32_t count, const WorldBounds& bounds,
                          const LensChoice& lens = {},
                          const std::function<void(double)>& progress = {});

/// The camera that frames a scene: frame() on its world_bounds().
/// Fails    UsageError as frame(); InputError also if the scene has a fault (find_fault), no
///          triangle, or reaches beyond the largest binary64 number. It names the object that lies
///          farthest out, and its file.
Camera frame_scene(const Scene& scene, const View& view = {}, const LensChoice& lens = {});

/// The camera path around a scene: orbit() around its world_bounds().
/// Fails    UsageError as orbit(); InputError as frame_scene().
std::vector<Camera> orbit_scene(const View& first, std::uint32_t count, const Scene& scene,
                                const LensChoice& lens = {},
                                const std::function<void(double)>& progress = {});

}  // namespace fathom
