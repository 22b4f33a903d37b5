#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/rays/cast.h"
#include "fathom/rays/ray.h"

/// Which points see each other, and which points cameras see, decided exactly (specification,
/// section 12): no tolerance is needed, and no sight passes through a wall.
namespace fathom {

/// The point A + v·(B − A) + w·(C − A) of a triangle ABC of the scene, exactly. v and w are the
/// weights of B and C, as in channel `bary`.
struct SurfacePoint {
  std::uint32_t triangle = 0;
  double v = 0, w = 0;
};

/// Coordinates in the world, in scene units, taken exactly; or a point of a triangle. Rounded
/// coordinates lie next to their surface, perhaps behind it: give a point of a surface by its
/// triangle.
using SightPoint = std::variant<std::array<double, 3>, SurfacePoint>;

struct SightOptions {
  /// closed: a point of an edge hides everything behind it. generic: a line of sight through an
  /// edge is decided like the ray from the eye to the point, by section 11.
  EdgeRule edges = EdgeRule::closed;
  /// Threads to use; 0: all.
  int threads = 0;
};

/// All functions below
/// Exact    every decision. The answers do not depend on the number of threads.
/// Fails    InputError if a number of a point is not finite or there is no such triangle; it names
///          the point by its number. UsageError as require_thread_count().

/// For each number, whether eye and point see each other: no triangle has a point in the open
/// segment between them. Triangles in a plane with the segment hide nothing.
/// Needs    as many points as eyes; else UsageError
std::vector<bool> sees(const RayScene& scene, std::span<const SightPoint> eyes,
                       std::span<const SightPoint> points, const SightOptions& options = {});

/// For each eye, whether it sees each point: eye i and point k are at i·points.size() + k.
std::vector<bool> sees_each(const RayScene& scene, std::span<const SightPoint> eyes,
                            std::span<const SightPoint> points, const SightOptions& options = {});

/// For each point, whether each camera sees it: point i and camera k are at i·cameras.size() + k. A
/// camera sees a point whose depth is above 0 and in range and whose image is in the closed
/// rectangle of the image, if no triangle that culling keeps, its edges included, has a smaller
/// depth in range there. It sees no point of a triangle that it sees edge on or that culling leaves
/// out.
/// Fails    InputError for a camera with a fault; UsageError for one whose lens bends rays.
std::vector<bool> seen_by(const RayScene& scene, std::span<const SightPoint> points,
                          std::span<const Camera> cameras, Cull cull = Cull::none, int threads = 0);

}  // namespace fathom
