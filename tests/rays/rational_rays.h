#pragma once

#include <vector>

#include "fathom/rays/ray.h"
#include "fathom/scene/scene.h"
#include "tests/oracle/generic_rays.h"

/// Scenes and rays of the library as the oracle takes them.
namespace fathom::rays::test {

std::vector<oracle::Triangle> rational_triangles(const Scene& scene);
oracle::GivenRay rational_ray(const Ray& ray);
oracle::Stretch rational_stretch(const CastOptions& options);

/// The number rounded once by MPFR.
double rounded(const oracle::Q& q);
/// Numbers that are the same, the signs of zeros included.
bool is_same(double a, double b);

}  // namespace fathom::rays::test
