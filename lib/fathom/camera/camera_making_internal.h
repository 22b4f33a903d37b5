#pragma once

#include <cstdint>
#include <string>

#include "fathom/camera/camera_making.h"
#include "fathom/camera/pose.h"

/// What all cameras made from a description share, whether they look at a point or have to see a
/// whole scene (scene/framing.h).
/// Fails    all of them: UsageError.
namespace fathom::camera {

void expect_finite(const Vector3& v, const std::string& name);

/// A camera with the intrinsics of a lens, at the world's origin.
Camera with_lens(const LensChoice& lens);

/// The camera, if find_fault() finds nothing.
Camera checked(Camera camera);

/// Rows right, down, forward in the world.
Matrix3 rotation_of(const View& view);

/// A path needs at least one camera, and few enough to be held in memory and written as one file.
void expect_count(std::uint32_t count);

/// The view of camera number `step` of `count` around the up axis.
View turned(View view, std::uint32_t step, std::uint32_t count);

}  // namespace fathom::camera
