#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/scene/scene.h"

/// Polygons as an eye at the origin sees them that looks along +z: what Warnock's algorithm and the
/// tree of planes have in common. In binary64; nothing is clipped, so all depths must be positive.
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

}  // namespace fathom::studies
