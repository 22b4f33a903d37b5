#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/image/depth_map.h"
#include "fathom/numeric/ratio.h"
#include "fathom/rendering/options.h"
#include "fathom/scene/scene.h"
#include "tests/oracle/areas.h"
#include "tests/oracle/lens_rays.h"
#include "tests/oracle/ray_caster.h"

namespace fathom::checks {

/// Camera and triangles as the oracle takes them.
oracle::RayCamera ray_camera(const Camera& camera);
std::vector<oracle::Triangle> triangles_of(const Scene& scene);

/// Rays through the pixels of `camera` at every triangle of the scene.
oracle::RayCaster cast_at(const Scene& scene, const Camera& camera);

/// The same through a lens whose rays have |m|² ≤ greatest_q.
oracle::RayCaster cast_at(const Scene& scene, const Camera& camera, const oracle::LensNumbers& lens,
                          double greatest_q);

/// The same along the given directions of pixels; near and far bound distances.
using DirectionOfPixel =
    std::function<std::optional<std::array<double, 3>>(std::uint32_t column, std::uint32_t row)>;
oracle::RayCaster cast_along(const Scene& scene, const Camera& camera,
                             const DirectionOfPixel& direction);

/// The areas of the pixels of `camera` that the scene covers.
oracle::Areas areas_at(const Scene& scene, const Camera& camera);
float nearest_float(const oracle::Q& q);

/// The same number by GMP.
oracle::Q rational(const Ratio& x);

/// All channels of section 6 except A.
std::vector<Channel> all_channels();

/// Holds every channel at a pixel to what the ray met, its value rounded by MPFR.
/// `normals` are those of Ns.
void expect_pixel(const DepthMap& map, int x, int y, const std::optional<oracle::Hit>& hit,
                  const Scene& scene, NormalSource normals = NormalSource::file);

/// expect_pixel() of all pixels of a map with all_channels(). Returns how many show a surface.
int expect_as_rays(const DepthMap& map, const Scene& scene, const Camera& camera,
                   NormalSource normals = NormalSource::file);

}  // namespace fathom::checks
