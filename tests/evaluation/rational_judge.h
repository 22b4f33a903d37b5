#pragma once

#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/evaluation/placed_points.h"
#include "fathom/rendering/options.h"
#include "fathom/scene/scene.h"

/// The same questions answered by rational numbers, one triangle after another, by other formulas.
namespace fathom::evaluation::test {

/// Whether the camera sees the point.
bool is_seen(const Scene& scene, const SightPoint& point, const Camera& camera, Cull cull);

/// The square of the point's distance from the nearest triangle of the other scene, by CGAL,
/// rounded to nearest; none of its triangles may be without area.
double squared_distance(const Scene& scene, const SurfacePoint& point, const Scene& other);

}  // namespace fathom::evaluation::test
