#pragma once

#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/camera/trajectory.h"
#include "fathom/rays/ray.h"

/// The rays of a moving camera with a rolling shutter, which measures one row after the other.
namespace fathom {

/// When the rows of an image are measured, in seconds: row v of h at start + readout·v/(h − 1), and
/// the only row of an image at `start`.
struct RollingShutter {
  double start = 0;
  /// From the top row to the bottom row. 0: all rows at once. Negative: the bottom row first.
  double readout = 0;
};

/// The rays through the centres of all pixels of a moving camera: ray v·width + u is of the pixel
/// in column u and row v. t is the planar depth of the row's camera, if the camera has no lens or a
/// lens whose rays all have z > 0 (is_plane()). With another lens, the greatest component of a
/// direction in the camera's frame is 1 or −1.
///
/// path     where the camera is, if its own pose is the identity; otherwise where the frame is in
///          which the camera has its pose.
/// Exact    the pose of a row is the camera's pose after the inverse placement, each entry rounded
///          once; the rounded numbers *are* the pose. Each number of a ray is the exact one of the
///          row's camera, rounded once; without a lens as ImageRays returns it.
/// Threads  0: all.
/// Fails    InputError for an invalid camera, for a path that does not cover all rows, and for a
///          row whose pose or ray is beyond binary64; for a pixel that sees nothing by the lens.
///          UsageError for times that are not finite.
std::vector<Ray> shutter_rays(const Camera& camera, const Trajectory& path,
                              const RollingShutter& shutter, int threads = 0);

}  // namespace fathom
