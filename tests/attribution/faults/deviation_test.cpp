#include "fathom/attribution/faults/deviation.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "fathom/attribution/model/named_models.h"

namespace fathom::attribution {
namespace {

using P = Parameter;

Deviation with(std::initializer_list<std::pair<P, double>> values) {
  Deviation d = Deviation::Zero();
  for (const auto& [p, value] : values) d[static_cast<int>(p)] = value;
  return d;
}

Camera skewed_camera(ProjectionModel projection) {
  Camera camera{.width = 60, .height = 40, .projection = {.model = projection}};
  camera.projection.fx = 50;
  camera.projection.fy = -55;
  camera.projection.cx = 27.5;
  camera.projection.cy = 21;
  camera.projection.skew = 3;
  camera.near = 0.5;
  camera.far = 20;
  camera.world_to_camera = {{{0.9, 0.1, -0.2, 0.1}, {-0.1, 1.1, 0.3, -0.2}, {0.2, -0.3, 0.8, 4}}};
  return camera;
}

using Point = std::array<double, 3>;

Point in_camera(const Camera& camera, const Point& p) {
  Point result{};
  for (std::size_t r = 0; r < 3; ++r) {
    const auto& row = camera.world_to_camera[r];
    result[r] = row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3];
  }
  return result;
}

/// A turn about one axis, as text books have it.
Point turned(const Point& p, std::size_t axis, double angle) {
  Point q = p;
  const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
  q[i] = std::cos(angle) * p[i] - std::sin(angle) * p[j];
  q[j] = std::sin(angle) * p[i] + std::cos(angle) * p[j];
  return q;
}

TEST(DeviatingCamera, IsTurnedAboutItsOwnAxesAndThenMoved) {
  const Camera camera = skewed_camera(ProjectionModel::perspective);
  const Point p{0.3, -0.7, 1.1};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Deviation d = with({{P::move_x, 0.5}, {P::move_y, -0.25}, {P::move_z, 2}});
    d[static_cast<int>(axis)] = 0.3;
    const Point moved = in_camera(deviating(camera, d), p);
    const Point expected = turned(in_camera(camera, p), axis, 0.3);
    EXPECT_NEAR(moved[0], expected[0] + 0.5, 1e-14);
    EXPECT_NEAR(moved[1], expected[1] - 0.25, 1e-14);
    EXPECT_NEAR(moved[2], expected[2] + 2, 1e-14);
  }
}

TEST(DeviatingCamera, HasOtherIntrinsicParameters) {
  const Camera camera = skewed_camera(ProjectionModel::perspective);
  const Camera other = deviating(camera, with({{P::focal_x, 0.5},
                                               {P::focal_y, -0.25},
                                               {P::centre_x, 1.5},
                                               {P::centre_y, -2},
                                               {P::skew, 0.125}}));
  EXPECT_EQ(other.projection.fx, 75);
  EXPECT_EQ(other.projection.fy, -41.25);
  EXPECT_EQ(other.projection.cx, 29);
  EXPECT_EQ(other.projection.cy, 19);
  EXPECT_EQ(other.projection.skew, 3.125);
  EXPECT_EQ(other.world_to_camera, camera.world_to_camera);
  // What concerns depths and the lens is not the camera's.
  const Camera same = deviating(camera, with({{P::k1, 1}, {P::scale, 1}, {P::near, 1}}));
  EXPECT_EQ(same.projection.fx, camera.projection.fx);
  EXPECT_EQ(same.near, camera.near);
  EXPECT_EQ(same.world_to_camera, camera.world_to_camera);
}

RendererModel logarithmic_model() {
  RasterModel raster;
  raster.written = written_depth(ProjectionModel::perspective, Mapping::log_ulrich, 0.5, 20);
  return {.name = "logarithmic", .kind = raster};
}

struct DepthCase {
  std::string name;
  ProjectionModel projection;
  RendererModel model;
};

void PrintTo(const DepthCase& c, std::ostream* stream) {
  *stream << c.name;
}

class Depths : public testing::TestWithParam<DepthCase> {
 protected:
  [[nodiscard]] bool is_perspective() const {
    return GetParam().projection == ProjectionModel::perspective;
  }
  [[nodiscard]] double affine(double depth) const { return is_perspective() ? 1 / depth : depth; }
  [[nodiscard]] DepthDeviation deviation(const Deviation& d) const {
    return {camera, GetParam().model, d};
  }
  /// Whether near and far play a part.
  [[nodiscard]] bool decodes() const {
    const auto* const raster = std::get_if<RasterModel>(&GetParam().model.kind);
    return raster != nullptr && !raster->written;
  }

  const Camera camera = skewed_camera(GetParam().projection);
};

// Through the window depth: made with one near and far, biased, read with others.
TEST_P(Depths, BecomeWhatAnotherDecoderMakesOfThem) {
  const Deviation d = with({{P::scale, 0.01},
                            {P::offset, 0.03},
                            {P::near, decodes() ? 0.1 : 0},
                            {P::far, decodes() ? -0.2 : 0},
                            {P::bias, 3}});
  const DepthDeviation deviated = deviation(d);
  const auto steps = window_steps(camera, GetParam().model);
  for (const double depth : {0.6, 1.0, 3.0, 11.0, 19.5}) {
    double expected = 1.01 * depth + 0.03;
    if (steps) {
      const double window = steps->window.of_depth(expected) + 3 * steps->step;
      WindowDepth reading = steps->window;
      if (decodes()) {
        reading = window_depth(camera.projection.model,
                               std::get<RasterModel>(GetParam().model.kind).stored_mapping(),
                               deviated.near(), deviated.far());
      }
      expected = reading.to_depth(window);
    }
    EXPECT_NEAR(deviated.of(affine(depth)) / affine(expected), 1, 1e-12) << depth;
  }
}

TEST_P(Depths, TheDecodersPlanesAreRelative) {
  if (!decodes()) return;
  const DepthDeviation d = deviation(with({{P::near, 0.1}, {P::far, -0.2}}));
  EXPECT_NEAR(d.near(), is_perspective() ? 0.5 / 1.1 : 0.5 * 1.1, 1e-14);
  EXPECT_NEAR(d.far(), is_perspective() ? 20 / 0.8 : 20 * 0.8, 1e-12);
}

TEST_P(Depths, AreUndone) {
  const DepthDeviation d = deviation(
      with({{P::scale, -0.02}, {P::offset, 0.05}, {P::near, 0.05}, {P::far, 0.1}, {P::bias, -5}}));
  for (const double depth : {0.6, 1.0, 3.0, 11.0, 19.5}) {
    EXPECT_NEAR(d.undone(affine(d.of(affine(depth)))), depth, 1e-12 * depth * depth);
  }
}

// Central differences: h² of the function's curvature and 2⁻⁵³/h of itself, below 10⁻⁷ here.
TEST_P(Depths, SlopesAreDerivatives) {
  const Deviation base =
      with({{P::scale, -0.02}, {P::offset, 0.05}, {P::near, 0.05}, {P::far, 0.1}, {P::bias, -5}});
  constexpr double h = 1e-5;
  for (const double depth : {0.7, 3.0, 15.0}) {
    const double a = affine(depth);
    const DepthDeviation::Slopes slopes = deviation(base).slopes(a);
    const double by_a =
        (deviation(base).of(a * (1 + h)) - deviation(base).of(a * (1 - h))) / (2 * h * a);
    EXPECT_NEAR(slopes.a / by_a, 1, 1e-7);
    for (const auto& [p, slope, step] : {std::tuple{P::scale, slopes.scale, h},
                                         {P::offset, slopes.offset, h},
                                         {P::near, slopes.near, h},
                                         {P::far, slopes.far, h},
                                         {P::bias, slopes.bias, 10.0}}) {
      const double measured =
          (deviation(base + with({{p, step}})).of(a) - deviation(base - with({{p, step}})).of(a)) /
          (2 * step);
      EXPECT_NEAR(slope, measured, 1e-6 * std::abs(measured) + 1e-12) << name_of(p);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, Depths,
    testing::Values(
        DepthCase{"Perspective", ProjectionModel::perspective, model_named("gl-unorm24")},
        DepthCase{"Reversed", ProjectionModel::perspective, model_named("gl-float32-reversed")},
        DepthCase{"Orthographic", ProjectionModel::orthographic, model_named("gl-unorm16")},
        DepthCase{"Rays", ProjectionModel::perspective, model_named("float32-ray")},
        DepthCase{"Logarithmic", ProjectionModel::perspective, logarithmic_model()}),
    [](const auto& c) { return c.param.name; });

TEST(DeviationSets, TheSmallestAreFirst) {
  int size = 0;
  for (const DeviationSet& set : deviation_sets()) {
    EXPECT_GE(set.size(), set.one_focal ? 1 : size) << set.subject;
    size = std::max(size, set.one_focal ? size : set.size());
    const bool of_depths = set.has(P::scale) || set.has(P::offset) || set.has(P::near) ||
                           set.has(P::far) || set.has(P::bias);
    EXPECT_NE(set.moves_the_view(), of_depths) << set.subject;
  }
}

}  // namespace
}  // namespace fathom::attribution
