#include <algorithm>
#include <cmath>
#include <optional>

#include "fathom/attribution/fragment_source.h"
#include "fathom/attribution/image_box.h"
#include "fathom/attribution/model/sample_grid.h"
#include "fathom/attribution/ray/model_ray.h"
#include "fathom/attribution/ray/ray_triangle.h"
#include "fathom/attribution/ray/vector3.h"
#include "fathom/numeric/unit_roundoff.h"

namespace fathom::attribution {
namespace {

constexpr double u = unit_roundoff<float>;

/// A corner in the camera frame, and the greatest of the terms that its coordinates are sums of.
struct CameraCorner {
  Vector3 position;
  double size;
};

CameraCorner in_camera(const Camera& camera, const Vector3& p) {
  const auto camera_from_world = as_matrix(camera.world_to_camera);
  const Eigen::Matrix<double, 3, 4> terms = camera_from_world * p.homogeneous().eval().asDiagonal();
  return {terms.rowwise().sum(), terms.cwiseAbs().maxCoeff()};
}

class RayFragments final : public FragmentSource {
 public:
  RayFragments(const WorldMesh& mesh, const Camera& camera, const SamplePosition& sample,
               const RayModel& model)
      : mesh_(mesh),
        sample_(sample),
        grid_(camera, sample),
        model_(model),
        rays_(camera, model, sample.error) {}

  [[nodiscard]] PixelBox box(std::uint32_t triangle) const override;
  void each(std::uint32_t triangle, const PixelBox& box, const TakeFragment& take) const override;

 private:
  [[nodiscard]] std::array<Vector3, 3> corners(std::uint32_t triangle) const {
    const CornerIndices& t = mesh_.triangles[triangle];
    const Vector3 shift = as_vector(model_.shift);
    return {as_vector(mesh_.points[t[0]]) - shift, as_vector(mesh_.points[t[1]]) - shift,
            as_vector(mesh_.points[t[2]]) - shift};
  }

  const WorldMesh& mesh_;
  SamplePosition sample_;
  SampleGrid grid_;
  RayModel model_;
  ModelRays rays_;
};

PixelBox RayFragments::box(std::uint32_t triangle) const {
  const Camera& c = rays_.camera();
  const auto [cx, cy] = principal_point(c);
  ImageBox box;
  bool before = false, behind = false;
  for (const Vector3& p : corners(triangle)) {
    const auto [q, size] = in_camera(c, p);
    const double w = c.projection == Projection::perspective ? q[2] : 1;
    if (q[2] < 64 * u * size) {
      behind = true;
      continue;
    }
    before = true;
    const double x = (c.fx * q[0] + c.skew * q[1]) / w + cx, y = c.fy * q[1] / w + cy;
    // displaced corners: 64u of the coordinates that the position is the sum of
    const double margin = (64 * u + 8 * model_.rotation_error) * size / w *
                              (std::abs(c.fx) + std::abs(c.fy) + std::abs(c.skew) +
                               std::abs(x - cx) + std::abs(y - cy)) +
                          sample_.error + 1 + grid_.reach();
    box.add(x, y, margin, margin);
  }
  if (!before) return {};
  return behind ? whole_image(c) : pixels_of(box, c, 0);
}

void RayFragments::each(std::uint32_t triangle, const PixelBox& box,
                        const TakeFragment& take) const {
  if (box.is_empty()) return;
  const std::array<Vector3, 3> points = corners(triangle);
  for (std::uint32_t row = box.first_row; row <= box.last_row; ++row) {
    for (std::uint32_t column = box.first_column; column <= box.last_column; ++column) {
      const auto [x, y] = grid_.at(column, row);
      const Ray ray = rays_.through(x, y);
      std::optional<Fragment> f = ray_on_triangle(points, ray, rays_, model_);
      if (!f) continue;
      f->triangle = triangle;
      take(column, row, *f);
    }
  }
}

}  // namespace

std::unique_ptr<FragmentSource> ray_fragments(const WorldMesh& mesh, const Camera& camera,
                                              const SamplePosition& sample, const RayModel& model) {
  return std::make_unique<RayFragments>(mesh, camera, sample, model);
}

}  // namespace fathom::attribution
