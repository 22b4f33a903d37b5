#pragma once

#include <cstdint>
#include <string>

#include "fathom/camera/camera_making.h"
#include "fathom/camera/pose.h"

/// What cameras made from a description have in common, whether they look at a point or are to see
/// a whole scene (scene/framing.h).
/// Fails    all of them: UsageError.
namespace fathom::camera {

void expect_finite(const Vector3& v, const std::string& name);

/// A camera with the intrinsics of a lens, at the world's origin.
Camera with_lens(const Lens& lens);

/// The camera, if find_fault() finds none.
Camera checked(Camera camera);

/// Rows right, down, forward in the world.
Matrix3 rotation_of(const View& view);

/// A path has at least one camera, and not too many to be held in memory and written as one file.
void expect_count(std::uint32_t count);

/// The view of camera number `step` of `count` around the up axis.
View turned(View view, std::uint32_t step, std::uint32_t count);

}  // namespace fathom::camera
