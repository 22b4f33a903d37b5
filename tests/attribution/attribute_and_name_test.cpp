#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/model/named_models.h"
#include "fathom/attribution/model/renderer_input.h"
#include "fathom/attribution/model/window_depth.h"
#include "fathom/camera/camera_making.h"
#include "tests/attribution/float_rasterizer.h"
#include "validation/scenes/shapes.h"

/// A renderer that is what its model says has no unexplained pixel; one with a fault has, and the
/// fault is named.
namespace fathom::attribution {
namespace {

using test::draw_in_binary32;
using test::Fault;
using test::trace_in_binary32;

Camera sphere_camera() {
  Camera camera = look_from({.azimuth = 35, .elevation = 25}, {0.1, -0.05, 0.2}, 3,
                            {.width = 200, .height = 150, .vertical_fov = 45});
  camera.near = 0.5;
  camera.far = 20;
  return camera;
}

/// A sphere above a sheet that is twice there.
Scene sphere_and_sheets() {
  Mesh sheet;
  sheet.vertices = {{-1.4, -1.1, -1.2}, {1.2, -1.1, -1.1}, {1.3, -0.9, 1.0}, {-1.1, -1.05, 1.2}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 1, 2}, {0, 2, 3}};
  return bench::as_scene({bench::sphere(800), sheet}, "sphere");
}

RendererModel model_of(Storage storage, Mapping mapping = Mapping::opengl,
                       std::optional<Mapping> written = {}) {
  RasterModel model{.mapping = mapping, .storage = storage, .depth_before_snap = true};
  if (written) model.written = written_depth(ProjectionModel::perspective, *written, 0.5, 20);
  model.matrix = clip_from_held(sphere_camera(), model);
  return {.name = "test", .equal_depths = EqualDepths::first_wins, .kind = model};
}

struct Case {
  std::string name;
  Storage storage;
  Mapping mapping;
  /// By a fragment shader, in place of the interpolated depth.
  std::optional<Mapping> written{};
};

void PrintTo(const Case& c, std::ostream* stream) {
  *stream << c.name;
}

class Faults : public testing::TestWithParam<Case> {
 protected:
  [[nodiscard]] Attribution judged(const Fault& fault) const {
    return attribute_and_name(truth, draw_in_binary32(truth.mesh, truth.camera, model, fault),
                              model);
  }
  const Scene scene = sphere_and_sheets();
  const Truth truth = make_truth(scene, sphere_camera());
  const RendererModel model = model_of(GetParam().storage, GetParam().mapping, GetParam().written);
};

void expect_named(const Attribution& found, const std::string& kind) {
  EXPECT_GT(found.count(PixelClass::unexplained) + found.count(PixelClass::convention), 0U);
  ASSERT_EQ(found.findings.size(), 1U);
  EXPECT_EQ(found.findings[0].kind, kind) << found.findings[0].text;
}

TEST_P(Faults, NoneLeavesNothingUnexplained) {
  const Attribution found = judged({});
  EXPECT_EQ(found.count(PixelClass::unexplained), 0U);
  EXPECT_TRUE(found.findings.empty());
  EXPECT_GT(found.count(PixelClass::equal), 9000U);  // the background alone has as many
  EXPECT_LT(found.sharpness.may_share, 0.05);
  RecordProperty("steps", std::to_string(found.sharpness.median_steps_width));
}

TEST_P(Faults, HalfAPixel) {
  const Attribution found = judged({.shift_x = 0.5, .shift_y = 0.5});
  expect_named(found, "shift");
  EXPECT_THAT(found.findings[0].text, testing::HasSubstr("shifted by (0."));
}

TEST_P(Faults, A64thOfAPixel) {
  const Attribution found = judged({.shift_x = 1.0 / 64});
  expect_named(found, "shift");
  EXPECT_THAT(found.findings[0].text, testing::HasSubstr("(0.01"));
}

TEST_P(Faults, MissingTriangle) {
  const std::uint32_t visible = truth.triangles[75 * 200 + 100];
  ASSERT_NE(visible, no_surface);
  const Attribution found = judged({.missing_triangle = visible});
  expect_named(found, "missing-triangle");
  EXPECT_EQ(found.findings[0].text, "triangle " + std::to_string(visible) + " is missing");
}

TEST_P(Faults, Affine) {
  expect_named(judged({.affine = true}), "affine");
}

TEST_P(Faults, TiesTheOtherWay) {
  expect_named(judged({.last_of_equals = true}), "ties");
}

// GL_LEQUAL, as VTK's windows have it.
TEST_P(Faults, ARendererMayLetTheLastOfEqualsWin) {
  RendererModel last = model;
  last.equal_depths = EqualDepths::last_wins;
  const auto judged_by_last = [&](const Fault& fault) {
    return attribute_and_name(truth, draw_in_binary32(truth.mesh, truth.camera, model, fault),
                              last);
  };
  const Attribution right = judged_by_last({.last_of_equals = true});
  EXPECT_EQ(right.count(PixelClass::unexplained) + right.count(PixelClass::convention), 0U);
  EXPECT_TRUE(right.findings.empty());
  EXPECT_GT(right.count(PixelClass::z_fight), 0U);
  expect_named(judged_by_last({}), "ties");
}

INSTANTIATE_TEST_SUITE_P(
    All, Faults,
    testing::Values(Case{"Unorm16", Storage::unorm16, Mapping::opengl},
                    Case{"Unorm24", Storage::unorm24, Mapping::opengl},
                    Case{"Float32", Storage::float32, Mapping::opengl},
                    Case{"Reversed", Storage::float32, Mapping::reversed},
                    Case{"ReversedByShader", Storage::float32, Mapping::opengl, Mapping::reversed},
                    Case{"Logarithmic24", Storage::unorm24, Mapping::opengl, Mapping::log_ulrich},
                    Case{"Logarithmic32", Storage::float32, Mapping::opengl, Mapping::log_ulrich}),
    [](const auto& c) { return c.param.name; });

/// One code of the storage; but of 24 bits made by a logarithm as many as the error that the
/// shading language allows to log2 may be worth: 6u·|log2 t|/log2(far/near), up to 6 codes.
struct BiasCase {
  Storage storage;
  std::optional<Mapping> written;
  int codes = 1;
};

void PrintTo(const BiasCase& c, std::ostream* stream) {
  *stream << name_of(c.storage) << (c.written ? " logarithmic" : "");
}

class Bias : public testing::TestWithParam<BiasCase> {};

TEST_P(Bias, OfOneCode) {
  const Truth truth = make_truth(sphere_and_sheets(), sphere_camera());
  const RendererModel model = model_of(GetParam().storage, Mapping::opengl, GetParam().written);
  for (const int codes : {-GetParam().codes, GetParam().codes}) {
    const Attribution found = attribute_and_name(
        truth, draw_in_binary32(truth.mesh, truth.camera, model, {.bias_codes = codes}), model);
    ASSERT_EQ(found.findings.size(), 1U)
        << found.bias.steps << " ± " << found.bias.deviation << " in " << found.bias.triangles;
    EXPECT_EQ(found.findings[0].kind, "bias") << found.findings[0].text;
    EXPECT_EQ(std::signbit(found.bias.steps), codes < 0);
    // Roundings that do not cancel are worth a fifth of a code here; three quarters are named.
    if (GetParam().codes == 1) {
      EXPECT_NEAR(found.bias.steps, codes, 0.25);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, Bias,
                         testing::Values(BiasCase{Storage::unorm16, {}},
                                         BiasCase{Storage::unorm24, {}},
                                         BiasCase{Storage::unorm16, Mapping::log_ulrich},
                                         BiasCase{Storage::unorm24, Mapping::log_ulrich, 6}),
                         [](const auto& c) {
                           return std::string(name_of(c.param.storage)) +
                                  (c.param.written ? "Logarithmic" : "");
                         });

/// What was done to the depths afterwards.
struct Distorted {
  std::string name, kind;
  double (*depth)(double depth, double ray_length);
};

void PrintTo(const Distorted& d, std::ostream* stream) {
  *stream << d.name;
}

class WrongFormula : public testing::TestWithParam<Distorted> {};

TEST_P(WrongFormula, IsNamed) {
  const Truth truth = make_truth(sphere_and_sheets(), sphere_camera());
  RendererModel model = model_of(Storage::unorm24);
  OtherMap map = draw_in_binary32(truth.mesh, truth.camera, model);
  map.windows.clear();
  map.triangles.clear();
  std::get<RasterModel>(model.kind).decoded_in_binary32 = true;
  const Camera& camera = truth.camera;
  for (std::size_t i = 0; i < map.depths.size(); ++i) {
    if (std::isinf(map.depths[i])) continue;
    const double x =
        (static_cast<double>(i % camera.width) + 0.5 - camera.projection.cx) / camera.projection.fx;
    const double y =
        (static_cast<double>(i / camera.width) + 0.5 - camera.projection.cy) / camera.projection.fy;
    map.depths[i] =
        static_cast<float>(GetParam().depth(map.depths[i], std::sqrt(1 + x * x + y * y)));
  }
  expect_named(attribute_and_name(truth, map, model), GetParam().kind);
}

INSTANTIATE_TEST_SUITE_P(
    All, WrongFormula,
    testing::Values(Distorted{"RayDistance", "ray-distance",
                              [](double d, double ray) { return d * ray; }},
                    Distorted{"WrongNearAndFar", "decoding",
                              [](double d, double) {
                                const double z =
                                    (20 / 19.5) * (1 - 0.5 / d);  // decoded with near 1, far 10
                                return 10 / (10 - 9 * z);
                              }},
                    Distorted{"NotDecoded", "decoding",
                              [](double d, double) { return (20 / 19.5) * (1 - 0.5 / d); }},
                    Distorted{"LogarithmNotDecoded", "decoding",
                              [](double d, double) { return std::log(d / 0.5) / std::log(40); }},
                    Distorted{"WrongNearAndFarOfALogarithm", "decoding",
                              [](double d, double) {  // decoded with near 1, far 10
                                return std::pow(10, std::log(d / 0.5) / std::log(40));
                              }},
                    Distorted{"Millimetres", "scale", [](double d, double) { return 1000 * d; }}),
    [](const auto& d) { return d.param.name; });

TEST(WrongConvention, MirroredImageIsNamed) {
  const Truth truth = make_truth(sphere_and_sheets(), sphere_camera());
  const RendererModel model = model_of(Storage::unorm24);
  OtherMap map = draw_in_binary32(truth.mesh, truth.camera, model);
  for (std::uint32_t row = 0; row < map.height / 2; ++row) {
    for (std::uint32_t x = 0; x < map.width; ++x) {
      const std::size_t i = row * map.width + x, j = (map.height - 1 - row) * map.width + x;
      std::swap(map.depths[i], map.depths[j]);
      std::swap(map.windows[i], map.windows[j]);
      std::swap(map.triangles[i], map.triangles[j]);
    }
  }
  const Attribution found = attribute_and_name(truth, map, model);
  expect_named(found, "mirrored");
  EXPECT_THAT(found.findings[0].text, testing::HasSubstr("the vertical axis is flipped"));
}

TEST(RayModel, ExplainsMoellerTrumboreAndCatchesFaults) {
  Camera camera = sphere_camera();
  camera.width = 80;
  camera.height = 60;
  camera.projection.fx = camera.projection.fy = camera.projection.fx * 0.4;
  camera.projection.cx = 40;
  camera.projection.cy = 30;
  const Truth truth = make_truth(sphere_and_sheets(), camera);
  const RendererModel model{.name = "rays", .watertight = false, .kind = RayModel{}};
  const auto judged = [&](const Fault& fault) {
    return attribute_and_name(truth, trace_in_binary32(truth.mesh, camera, fault), model);
  };
  const Attribution none = judged({});
  EXPECT_EQ(none.count(PixelClass::unexplained), 0U);
  EXPECT_LT(none.sharpness.may_share, 0.01);
  expect_named(judged({.shift_x = 0.5, .shift_y = 0.5}), "shift");
  expect_named(judged({.shift_x = 1.0 / 64}), "shift");
  const std::uint32_t visible = truth.triangles[30 * 80 + 40];
  ASSERT_NE(visible, no_surface);
  expect_named(judged({.missing_triangle = visible}), "missing-triangle");
}

// Depth 4, but 160 units across: a millionth of a radian moves depths by far more than roundings.
TEST(RayModel, TheRotationOfBlendersCameraIsKnownUpToItsRoundings) {
  Camera camera{.width = 40, .height = 30, .projection = {.model = ProjectionModel::orthographic}};
  camera.projection.fx = camera.projection.fy = 0.125;
  camera.projection.cx = 20;
  camera.projection.cy = 15;
  Mesh sheet;
  sheet.vertices = {{-190, -150, 4}, {190, -150, 4}, {190, 150, 4}, {-190, 150, 4}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  const Truth truth = make_truth(bench::as_scene({sheet}, "sheet"), camera);
  Camera turned = camera;
  turned.world_to_camera[2][0] = 1e-6;
  turned.world_to_camera[0][2] = -1e-6;
  const OtherMap map = trace_in_binary32(truth.mesh, turned);
  RendererModel model = model_named("cycles");
  model.sample.error = 1e-5;
  EXPECT_EQ(attribute(truth, map, model).count(PixelClass::unexplained), 0U);
  std::get<RayModel>(model.kind).rotation_error = 0;
  EXPECT_GT(attribute(truth, map, model).count(PixelClass::unexplained), 900U);
}

// OpenGL allows a window depth to become either of the two codes about it.
TEST(Codes, RoundedDownAreExplainedWhereTheNearestIsNotPromised) {
  const Truth truth = make_truth(sphere_and_sheets(), sphere_camera());
  const RendererModel exact = model_of(Storage::float32);
  OtherMap map = draw_in_binary32(truth.mesh, truth.camera, exact, {});
  const WindowDepth window = window_depth(ProjectionModel::perspective, Mapping::opengl, 0.5, 20);
  for (std::size_t i = 0; i < map.windows.size(); ++i) {
    if (map.windows[i] == 1) continue;
    map.windows[i] = std::floor(map.windows[i] * 65535) / 65535;
    map.depths[i] = window.to_depth(map.windows[i]);
  }
  const auto unexplained = [&](bool nearest) {
    RendererModel model = model_of(Storage::unorm16);
    std::get<RasterModel>(model.kind).nearest_codes = nearest;
    return attribute(truth, map, model).count(PixelClass::unexplained);
  };
  EXPECT_EQ(unexplained(false), 0U);
  EXPECT_GT(unexplained(true), 100U);
}

}  // namespace
}  // namespace fathom::attribution
