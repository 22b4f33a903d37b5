#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "fathom/camera/camera.h"
#include "fathom/failures/errors.h"
#include "fathom/scene/scene.h"
#include "fathom/scene/streamed_scene.h"
#include "fathom/scene/triangle_source.h"

/// Checks of scenes that callers filled in, like find_fault() for cameras. Every function that
/// takes a scene checks it, once per call.
namespace fathom {

/// The fault of a scene, in one line, or nothing if
///   objects      name meshes of the scene; an unplaced object has the identity as its transform;
///                no transform exceeds the limits of object.h;
///                faces are numbered below 2³² − 1
///   meshes       have at most 2³² − 2 vertices and triangles; all coordinates are finite; corners
///                are numbers of vertices; face_of_triangle is empty or as long as `triangles`
///   attributes   are finite; attributes of vertices are as many as the vertices; texture_triangles
///                and normal_triangles are empty or as long as `triangles`, and contain indices of
///                their lists or no_index
///   segments     are at most one list for each segmentation, of one number or one for each
///                triangle; a number has a name, a label is below 2³² − 2, or it is `unsegmented`
///   in all       there are at most 2³² − 2 triangles.
/// A transform may be singular, a mesh empty or placed by no object.
/// Cost     reads every number once, with all threads of with_threads().
std::optional<std::string> find_fault(const Scene& scene);

/// The same checks of objects, and that streams exist. The content of the files was checked when
/// they were opened.
std::optional<std::string> find_fault(const StreamedScene& scene);

/// When the vertices and triangles of placed meshes are looked at: at once, or by a caller that
/// reads them anyway (scene::explaining_faults).
enum class LookAtElements { now, later };

/// Refuses a scene, in memory or in files, that is not valid.
/// Fails    InputError: "scene: " and the fault from find_fault().
void require_valid(const TriangleSource& triangles, LookAtElements when = LookAtElements::now);

/// An image of more pixels cannot be rendered: the engines number its tiles of 64×64 pixels with 32
/// bits.
inline constexpr std::uint64_t most_pixels_of_image = std::uint64_t{1} << 44;
inline constexpr std::string_view too_many_pixels = "more than 2^44 pixels";

/// The failure of a larger image.
InputError image_too_large();

/// Checks the arguments of every function that takes a scene and a camera.
/// Fails    InputError if scene or camera has a fault, or the image has more pixels than
///          most_pixels_of_image; UsageError if the camera has a lens that bends rays.
void require_renderable(const TriangleSource& triangles, const Camera& camera,
                        LookAtElements when = LookAtElements::now);
/// The same for a function that takes lenses.
void require_renderable_by_rays(const TriangleSource& triangles, const Camera& camera,
                                LookAtElements when = LookAtElements::now);

}  // namespace fathom
