#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "fathom/camera/pose.h"
#include "fathom/camera/projection.h"

namespace fathom {

/// Why most computations take no lens.
inline constexpr std::string_view computes_on_straight_edges =
    "computed only where edges are straight in the image; leave the lens out of the camera, or "
    "undistort the images";

/// A camera as the specification (section 2) defines it: where it stands, how it projects, and
/// which part of space it shows. Every number is the real number that it denotes. Valid if
/// find_fault() finds nothing.
///
/// Frame    world to camera: x right, y down, z forward; image: u right, v down.
/// Unit     lengths in scene units; for the projection see projection.h.
struct Camera {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  Projection projection;
  Pose world_to_camera{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
  /// The range of planar depth that counts.
  double near = 0;
  double far = std::numeric_limits<double>::infinity();
  /// Name of its image in UTF-8; may be empty. Does not affect the map.
  std::string name;
};

/// The fault of a camera, in one line, or nothing if width and height are at least 1, all numbers
/// are finite (far may be +∞), det R ≠ 0 exactly, fx and fy ≠ 0, near ≥ 0, far > near, and a
/// table of directions has the size of the image.
std::optional<std::string> find_fault(const Camera& camera);

/// Refuses a camera that is not valid.
/// Fails    InputError: "camera: " and the fault from find_fault().
void require_valid(const Camera& camera);

/// Refuses a camera whose lens bends rays. `why` completes the message: what needs straight edges,
/// and what to do instead.
/// Fails    UsageError: "the lens OPENCV: " and `why`.
void require_straight(const Camera& camera, std::string_view why = computes_on_straight_edges);

/// Whether the camera has the near and far between which window depths are defined: a finite far
/// and, of a perspective camera, a near that is not its own position.
bool has_clip_planes(const Camera& camera);

}  // namespace fathom
