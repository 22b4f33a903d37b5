#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "apps/study/study.h"
#include "fathom/camera/camera.h"
#include "fathom/scene/scene.h"

/// Polygons as an eye at the origin sees them that looks along +z: what Warnock's algorithm and the
/// tree of planes have in common, and the two algorithms. In binary64; nothing is clipped, so all
/// depths must be positive.
namespace fathom::studies {

using EyePoint = std::array<double, 3>;
/// Convex, in one plane.
using EyePolygon = std::vector<EyePoint>;

/// a · (b × c): its sign says on which side of the plane through the eye, a and b the point c lies.
/// Exchanging a and b changes the sign and no digit, so that neighbours agree on a shared edge.
double volume(const EyePoint& a, const EyePoint& b, const EyePoint& c);

/// The ray through a point of the image, at depth 1.
EyePoint ray_at(const Camera& camera, double x, double y);

/// The triangles of a scene of one mesh, in their order; world and camera are the same frame.
std::vector<EyePolygon> eye_polygons(const Scene& scene);

/// Whether the ray meets the polygon, its outline included.
bool is_met(const EyePolygon& polygon, const EyePoint& ray);

/// What is left of the eye in a plane: P · normal − offset is 0 on it.
struct EyePlane {
  EyePoint normal;
  double offset;
  [[nodiscard]] double at(const EyePoint& p) const;
};
EyePlane plane_of(const EyePolygon& polygon);

/// What an algorithm sees: the number of the triangle at each pixel's centre, no_surface where
/// there is none; how many steps it took, windows or nodes; and how many polygons it held.
struct Sight {
  std::vector<std::uint32_t> ids;
  std::uint64_t steps = 0, polygons = 0;
};

/// More triangles than this are refused: the painter's algorithm compares every pair of them.
inline constexpr std::size_t most_triangles_to_paint = 20000;

/// A scene as an eye at the origin sees it that looks along +z: one mesh in the camera's frame,
/// each corner rounded once to binary64, without triangles beyond far, and cut off at near, where a
/// triangle may become two. The camera keeps its lens.
/// Fails    UsageError for a camera that is orthographic or has a skew, and for more than
///          most_triangles_to_paint triangles
SceneView seen_from_eye(const SceneView& view);

/// Every so many triangles of a scene of one mesh, `count` in all.
Scene thinned(const Scene& scene, std::size_t count);

/// Hidden surfaces by subdivision of the image: a window is simple if no polygon reaches into it,
/// or if one surrounds it and is nearer than all others at its corners; else its quarters are
/// looked at, down to single pixels, where the nearest polygon at the centre wins.
/// Source   [War69]
Sight warnock(const Scene& scene, const Camera& camera);

/// How a tree computes the corners at which it cuts polygons, on which side of a plane a corner
/// lies, and whether a ray meets a piece.
enum class TreeArithmetic {
  binary64,        ///< all in binary64
  exact_outlines,  ///< pieces in binary64, but whether a ray meets a piece is decided exactly
  exact            ///< all exact, by CGAL's lazy rational numbers
};

/// Hidden surfaces by a tree of planes: the first polygon's plane divides the others, which are cut
/// where they pass through it, into those before and those behind, and so on; painted in the order
/// behind, on the plane, before, as seen from the eye. The tree does not depend on the eye.
/// In binary64 a corner on a cutting plane may come out beside it, so pieces get edges shorter than
/// rounding errors; on which side of such an edge a pixel lies is noise, and pixels become wrong.
/// Source   [FKN80]
Sight bsp_tree(const Scene& scene, const Camera& camera,
               TreeArithmetic arithmetic = TreeArithmetic::binary64);

}  // namespace fathom::studies
