#include "fathom/attribution/faults/residuals.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <string>

#include "fathom/attribution/model/named_models.h"
#include "validation/scenes/shapes.h"

/// Held against depths of one plane that are computed here: from the ray of a pixel, its lens
/// undone by bisection, and the plane.
namespace fathom::attribution {
namespace {

using Eigen::Vector3d;
using P = Parameter;

/// A sheet that fills the image.
Mesh sheet() {
  Mesh mesh;
  mesh.vertices = {{-60, -70, -24}, {120, -60, 21}, {-40, 130, 34}};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

struct Lens {
  double k1 = 0, k2 = 0;
};

Vector3d without_lens(double x, double y, const Lens& lens) {
  const double shown = std::hypot(x, y);
  if (shown == 0) return {x, y, 1};
  double low = 0, high = 2 * shown;
  for (int i = 0; i < 80; ++i) {
    const double r = (low + high) / 2, q = r * r;
    (r * (1 + q * (lens.k1 + q * lens.k2)) < shown ? low : high) = r;
  }
  return {x * low / shown, y * low / shown, 1};
}

Vector3d corner(const Camera& camera, std::size_t k) {
  const Mesh mesh = sheet();
  Vector3d result;
  for (std::size_t r = 0; r < 3; ++r) {
    const auto& row = camera.world_to_camera[r];
    result[static_cast<int>(r)] = row[0] * mesh.vertices[k].x + row[1] * mesh.vertices[k].y +
                                  row[2] * mesh.vertices[k].z + row[3];
  }
  return result;
}

/// The depth of the sheet at a sample in the middle of a pixel.
double depth_at(const Camera& c, const Lens& lens, std::size_t pixel) {
  const Vector3d a = corner(c, 0);
  const Vector3d n = (corner(c, 1) - a).cross(corner(c, 2) - a);
  const double u = static_cast<double>(pixel % c.width) + 0.5;
  const double v = static_cast<double>(pixel / c.width) + 0.5;
  const double y = (v - c.projection.cy) / c.projection.fy,
               x = (u - c.projection.cx - c.projection.skew * y) / c.projection.fx;
  const Vector3d ray = without_lens(x, y, lens);
  return is_perspective(c.projection) ? n.dot(a) / n.dot(ray)
                                      : (n.dot(a) - n.x() * ray.x() - n.y() * ray.y()) / n.z();
}

struct Case {
  std::string name;
  ProjectionModel projection;
  double skew = 0;
  Lens lens = {};
  const char* model = "float32-ray";
};

void PrintTo(const Case& c, std::ostream* stream) {
  *stream << c.name;
}

Camera camera_of(const Case& c) {
  Camera camera{.width = 24, .height = 16, .projection = {.model = c.projection}};
  const bool perspective = c.projection == ProjectionModel::perspective;
  camera.projection.fx = perspective ? 20 : 4;
  camera.projection.fy = perspective ? 21 : 4.5;
  camera.projection.cx = 11;
  camera.projection.cy = 8.5;
  camera.projection.skew = c.skew;
  camera.near = 0.5;
  camera.far = 100;
  camera.world_to_camera = {
      {{0.96, 0.28, 0, 0.3}, {-0.28, 0.96, 0, -0.2}, {0, 0, 1, perspective ? 12.0 : 25.0}}};
  return camera;
}

class OfASheet : public testing::TestWithParam<Case> {
 protected:
  [[nodiscard]] bool is_perspective() const {
    return GetParam().projection == ProjectionModel::perspective;
  }
  [[nodiscard]] double affine(double depth) const { return is_perspective() ? 1 / depth : depth; }

  [[nodiscard]] Lens lens_of(const Deviation& d) const {
    return {GetParam().lens.k1 + of(d, P::k1), GetParam().lens.k2 + of(d, P::k2)};
  }
  /// What is expected at a pixel: of the depth that is seen, by DepthDeviation, which has a test of
  /// its own.
  [[nodiscard]] double expected(const Deviation& d, std::size_t pixel) const {
    const double depth = depth_at(deviating(camera, d), lens_of(d), pixel);
    return DepthDeviation(camera, model, d).of(affine(depth));
  }
  /// Of a map of a multiple of the affine values that are expected.
  [[nodiscard]] Residuals residuals(const Deviation& d, double multiple) const {
    OtherMap other{camera.width, camera.height, {}, {}, {}};
    for (std::size_t i = 0; i < truth.depths.size(); ++i) {
      other.depths.push_back(affine(multiple * expected(d, i)));
    }
    const Attribution found = attribute(truth, other, model);
    const ResidualSource source(truth, other, model, found);
    return source.of(seen_by(truth, deviating(camera, d)), d);
  }

  const Camera camera = camera_of(GetParam());
  const Truth truth = make_truth(bench::as_scene({sheet()}, "sheet"), camera);
  RendererModel model = [] {
    RendererModel m = model_named(GetParam().model);
    m.sample.k1 = GetParam().lens.k1;
    m.sample.k2 = GetParam().lens.k2;
    return m;
  }();
};

Deviation some_deviation(bool perspective) {
  Deviation d = Deviation::Zero();
  d.head<6>() << 1e-3, -2e-3, 3e-3, 0.01, -0.02, 0.03;
  d.segment<5>(6) << 0.01, -0.02, 0.1, -0.2, 0.3;
  if (perspective) d.segment<2>(11) << 0.02, 0.01;
  d[static_cast<int>(P::scale)] = 0.01;
  return d;
}

TEST_P(OfASheet, NoneAreLeftByWhatDeviatesTheSameWay) {
  const Residuals r = residuals(some_deviation(is_perspective()), 1);
  ASSERT_EQ(r.r.size(), 24 * 16);
  EXPECT_LT(r.r.cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_EQ(r.triangles, std::vector<std::uint32_t>(24 * 16, 0));
}

/// The map holds twice the affine value that is expected: r then is that value in the slopes' unit.
TEST_P(OfASheet, SlopesAreDerivatives) {
  const Residuals at = residuals(Deviation::Zero(), 2);
  ASSERT_EQ(at.r.size(), 24 * 16);
  for (int k = 0; k < parameter_count; ++k) {
    const double h = k == static_cast<int>(P::bias) ? 10 : 1e-5;
    Deviation up = Deviation::Zero(), down = up;
    up[k] = h;
    down[k] = -h;
    double greatest = 0, worst = 0;
    for (std::size_t i = 0; i < truth.depths.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      const double value = expected(Deviation::Zero(), i);
      const double measured = (expected(up, i) - expected(down, i)) / (2 * h) / value;
      greatest = std::max(greatest, std::abs(measured));
      worst = std::max(worst, std::abs(at.slopes(row, k) / at.r[row] - measured));
    }
    // 2⁻⁵³/h is 10⁻¹¹ of the value, h² 10⁻¹⁰ of its curvature; depths have 48 bits.
    const bool is_of_perspective = k == static_cast<int>(P::k1) || k == static_cast<int>(P::k2);
    if (is_of_perspective && !is_perspective()) continue;
    EXPECT_LE(worst, 1e-6 * greatest + 1e-9) << name_of(static_cast<P>(k));
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, OfASheet,
    testing::Values(Case{"Perspective", ProjectionModel::perspective},
                    Case{"Orthographic", ProjectionModel::orthographic},
                    Case{"Skewed", ProjectionModel::perspective, 2},
                    Case{"SkewedOrthographic", ProjectionModel::orthographic, 0.5},
                    Case{"Lens", ProjectionModel::perspective, 0, {0.05, 0.02}},
                    Case{"SkewedLens", ProjectionModel::perspective, 2, {0.05, -0.02}},
                    Case{"Window", ProjectionModel::perspective, 1, {}, "gl-unorm24"},
                    Case{"WindowOrthographic", ProjectionModel::orthographic, 0, {}, "gl-float32"}),
    [](const auto& c) { return c.param.name; });

TEST(Residuals, TheirCostLeavesOutTheWorst) {
  Residuals residuals;
  residuals.r = Eigen::VectorXd::Constant(10, -2);
  residuals.r[3] = 1e9;
  residuals.r[7] = -1e9;
  EXPECT_EQ(residuals.cost(), 4);
  EXPECT_EQ(residuals.median(), 2);
  residuals.r.resize(0);
  EXPECT_EQ(residuals.cost(), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace fathom::attribution
