#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "apps/study/study.h"
#include "fathom/camera/camera.h"
#include "fathom/scene/scene.h"

/// Two algorithms for hidden surfaces, Warnock's and the tree of planes, and the geometry that both
/// use: polygons seen by an eye at the origin that looks along +z. Corners are binary64 numbers.
/// Nothing is clipped, so all depths must be positive.
namespace fathom::studies {

using EyePoint = std::array<double, 3>;
/// Convex, in one plane.
using EyePolygon = std::vector<EyePoint>;

/// a · (b × c). Its sign is the side of the plane through the eye, a and b on which c lies.
/// Exchanging a and b changes only the sign, so that neighbours agree on a shared edge.
double volume(const EyePoint& a, const EyePoint& b, const EyePoint& c);

/// The ray through a point of the image, at depth 1.
EyePoint ray_at(const Camera& camera, double x, double y);

/// The triangles of a scene of one mesh, in their order; world and camera are the same frame.
std::vector<EyePolygon> eye_polygons(const Scene& scene);

/// Whether the ray meets the polygon, its outline included.
bool is_met(const EyePolygon& polygon, const EyePoint& ray);

/// A plane in the frame of the eye: P · normal − offset = 0.
struct EyePlane {
  EyePoint normal;
  double offset;
  [[nodiscard]] double at(const EyePoint& p) const;
};
EyePlane plane_of(const EyePolygon& polygon);

/// The result of an algorithm: the number of the triangle at each pixel's centre, or no_surface;
/// the number of steps (windows or nodes); and the number of polygons that it stored.
struct Sight {
  std::vector<std::uint32_t> ids;
  std::uint64_t steps = 0, polygons = 0;
};

/// More triangles than this are refused: the painter's algorithm compares every pair of them.
inline constexpr std::size_t most_triangles_to_paint = 20000;

/// The scene in the frame of the camera, as one mesh. Each corner is rounded once to binary64.
/// Triangles beyond far are left out, and triangles are cut off at near, where a triangle may
/// become two. The camera keeps its lens.
/// Fails    UsageError for a camera that is orthographic or has a skew, and for more than
///          most_triangles_to_paint triangles
SceneView seen_from_eye(const SceneView& view);

/// `count` triangles of a scene of one mesh, at equal distances in their order.
Scene thinned(const Scene& scene, std::size_t count);

/// Hidden surfaces by subdivision of the image. A window is simple if no polygon reaches into it,
/// or if a polygon surrounds it and is nearer than all other polygons at its corners. Any other
/// window is divided into quarters, down to single pixels, where the nearest polygon at the centre
/// wins.
/// Source   [War69]
Sight warnock(const Scene& scene, const Camera& camera);

/// Arithmetic with which the tree computes the corners of cut polygons, decides on which side of a
/// plane a corner lies, and decides whether a ray meets a piece.
enum class TreeArithmetic {
  binary64,        ///< all in binary64
  exact_outlines,  ///< pieces in binary64, but whether a ray meets a piece is decided exactly
  exact            ///< all exact, by CGAL's lazy rational numbers
};

/// Hidden surfaces by a tree of planes. The plane of the first polygon divides the other polygons
/// into polygons in front of it and behind it, and cuts polygons that pass through it; both sides
/// are divided likewise. The tree is painted from back to front as seen from the eye: behind the
/// plane, on it, in front of it. The tree does not depend on the eye. In binary64 a corner on a
/// cutting plane may be computed next to it. Then pieces get edges that are shorter than rounding
/// errors, the side of such an edge on which a pixel lies is noise, and pixels become wrong.
/// Source   [FKN80]
Sight bsp_tree(const Scene& scene, const Camera& camera,
               TreeArithmetic arithmetic = TreeArithmetic::binary64);

}  // namespace fathom::studies
