#include "fathom/triangle/image_rows.h"

#include "fathom/numeric/certified.h"

namespace fathom::triangle {

// An affine function is known from its values at four points.
std::array<std::array<Dyadic, 4>, 3> image_rows(const Object& object, const Camera& camera) {
  const auto image = [&](const MeshPoint& p) {
    const HomogeneousImagePoint a =
        to_image(camera.projection, to_camera(camera.world_to_camera, object.world_from_mesh(p)));
    return ExactVector3{a.U, a.V, a.W};
  };
  const ExactVector3 origin = image({0, 0, 0}), x = image({1, 0, 0}), y = image({0, 1, 0}),
                     z = image({0, 0, 1});
  std::array<std::array<Dyadic, 4>, 3> rows;
  for (std::size_t i = 0; i < 3; ++i) {
    rows[i] = {x[i] - origin[i], y[i] - origin[i], z[i] - origin[i], origin[i]};
  }
  return rows;
}

}  // namespace fathom::triangle
