#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/model/named_models.h"
#include "fathom/attribution/model/renderer_input.h"
#include "fathom/camera/camera_making.h"
#include "tests/attribution/float_rasterizer.h"
#include "tests/attribution/halfs.h"
#include "tests/attribution/hand_made.h"
#include "tests/special_values.h"
#include "validation/scenes/shapes.h"

/// Maps that were drawn by a camera that is a little off, or changed afterwards: the fault is
/// named, and how large it is.
namespace fathom::attribution {
namespace {

using testing::HasSubstr;

/// A sphere above a sheet.
const Truth& sphere_and_sheet() {
  static const Truth truth = [] {
    Mesh sheet;
    sheet.vertices = {{-1.4, -1.1, -1.2}, {1.2, -1.1, -1.1}, {1.3, -0.9, 1.0}, {-1.1, -1.05, 1.2}};
    sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
    return make_truth(bench::as_scene({bench::sphere(300), sheet}, "sphere"), test::level_camera());
  }();
  return truth;
}

/// Only depths are known of it, in binary32.
OtherMap drawn_by(const Camera& camera) {
  RasterModel model{.storage = Storage::float32, .depth_before_snap = true};
  model.matrix = clip_from_held(camera, model);
  OtherMap map =
      test::draw_in_binary32(sphere_and_sheet().mesh, camera, {.name = "drawn", .kind = model});
  map.windows.clear();
  map.triangles.clear();
  for (double& depth : map.depths) depth = double{static_cast<float>(depth)};
  map.values = map.depths;
  return map;
}

/// About one axis of the camera, as text books have it.
void turn(Camera& camera, std::size_t axis, double angle) {
  auto& rows = camera.world_to_camera;
  const auto before = rows;
  const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
  for (std::size_t k = 0; k < 4; ++k) {
    rows[i][k] = std::cos(angle) * before[i][k] - std::sin(angle) * before[j][k];
    rows[j][k] = std::sin(angle) * before[i][k] + std::cos(angle) * before[j][k];
  }
}

/// What near 0.5 and far 20 made a window depth, read with others.
double read_with(double depth, double near, double far) {
  const double z = 20 / 19.5 * (1 - 0.5 / depth);
  return near * far / (far - z * (far - near));
}

/// An Estimate that is to be found; `without` is what it is where nothing is wrong.
struct Amount {
  const char* name;
  double value, without = 0;
};

struct Injected {
  std::string name, kind;
  std::vector<Amount> amounts;
  void (*camera)(Camera&) = nullptr;
  double (*depth)(double) = nullptr;
};

void PrintTo(const Injected& fault, std::ostream* stream) {
  *stream << fault.name;
}

void expect_amounts(const Finding& finding, const std::vector<Amount>& amounts) {
  EXPECT_EQ(finding.estimates.size(), amounts.size()) << finding.text;
  for (const Amount& amount : amounts) {
    const auto estimate = std::find_if(finding.estimates.begin(), finding.estimates.end(),
                                       [&](const Estimate& e) { return e.name == amount.name; });
    ASSERT_NE(estimate, finding.estimates.end()) << amount.name << ": " << finding.text;
    const double allowed =
        std::max(6 * estimate->deviation, 0.01 * std::abs(amount.value - amount.without));
    EXPECT_NEAR(estimate->value, amount.value, allowed) << finding.text;
    EXPECT_LT(estimate->deviation, 0.1 * std::abs(amount.value - amount.without)) << finding.text;
  }
}

class InjectedFault : public testing::TestWithParam<Injected> {};

TEST_P(InjectedFault, IsNamedAndMeasured) {
  const Injected& fault = GetParam();
  const Truth& truth = sphere_and_sheet();
  Camera camera = truth.camera;
  if (fault.camera != nullptr) fault.camera(camera);
  OtherMap map = drawn_by(camera);
  if (fault.depth != nullptr) {
    for (double& depth : map.depths) {
      if (depth < infinity) depth = double{static_cast<float>(fault.depth(depth))};
    }
    map.values = map.depths;
  }
  const Attribution found = attribute_and_name(truth, map, model_named("gl-float32"));
  ASSERT_EQ(found.findings.size(), 1U);
  EXPECT_EQ(found.findings[0].kind, fault.kind) << found.findings[0].text;
  EXPECT_LE(found.count(PixelClass::unexplained) * 9, found.count(PixelClass::convention));
  expect_amounts(found.findings[0], fault.amounts);
}

const std::vector<Injected> of_the_camera{
    {"FocalLength",
     "focal-length",
     {{"focal length x", 1e-3}, {"focal length y", 1e-3}},
     [](Camera& c) { c.projection.fx *= 1.001, c.projection.fy *= 1.001; }},
    {"FocalLengthAcross",
     "aspect",
     {{"focal length x", -2e-3}},
     [](Camera& c) { c.projection.fx *= 0.998; }},
    {"Pitch", "rotation", {{"turn about x", 1e-3}}, [](Camera& c) { turn(c, 0, 1e-3); }},
    {"Yaw", "rotation", {{"turn about y", -1e-3}}, [](Camera& c) { turn(c, 1, -1e-3); }},
    {"Roll", "rotation", {{"turn about z", 2e-3}}, [](Camera& c) { turn(c, 2, 2e-3); }},
    {"Right",
     "translation",
     {{"move in x", 2e-3}},
     [](Camera& c) { c.world_to_camera[0][3] += 2e-3; }},
    {"Down",
     "translation",
     {{"move in y", -2e-3}},
     [](Camera& c) { c.world_to_camera[1][3] -= 2e-3; }},
    {"Forwards",
     "translation",
     {{"move in z", 2e-3}},
     [](Camera& c) { c.world_to_camera[2][3] += 2e-3; }},
    {"Pose",
     "pose",
     {{"turn about x", 2e-3},
      {"turn about y", 4e-3},
      {"turn about z", -3e-3},
      {"move in x", -0.02},
      {"move in y", 0.015},
      {"move in z", 0.03}},
     [](Camera& c) {
       // So small that the order of the turns makes less than half a hundredth.
       turn(c, 0, 2e-3), turn(c, 1, 4e-3), turn(c, 2, -3e-3);
       c.world_to_camera[0][3] -= 0.02;
       c.world_to_camera[1][3] += 0.015;
       c.world_to_camera[2][3] += 0.03;
     }},
    {"Skew", "skew", {{"skew", 0.2}}, [](Camera& c) { c.projection.skew += 0.2; }},
    {"Shift", "shift", {{"centre x", 0.3}, {"centre y", -0.1}}, [](Camera& c) {
       c.projection.cx += 0.3, c.projection.cy -= 0.1;
     }}};

const std::vector<Injected> of_depths{
    {"Near",
     "decoding",
     {{"near", 0.501, 0.5}},
     nullptr,
     [](double d) { return read_with(d, 0.501, 20); }},
    {"Far", "decoding", {{"far", 21, 20}}, nullptr, [](double d) { return read_with(d, 0.5, 21); }},
    {"NearAndFar",
     "decoding",
     {{"near", 0.501, 0.5}, {"far", 21, 20}},
     nullptr,
     [](double d) { return read_with(d, 0.501, 21); }},
    {"Scale", "scale", {{"scale", 1e-3}}, nullptr, [](double d) { return 1.001 * d; }},
    {"Offset", "scale", {{"offset", -3e-3}}, nullptr, [](double d) { return d - 3e-3; }},
    {"Millimetres", "scale", {{"factor", 1000, 1}}, nullptr, [](double d) { return 1000 * d; }},
    {"WholeMillimetres",
     "storage",
     {},
     nullptr,
     [](double d) { return std::nearbyint(1000 * d) / 1000; }},
    {"Halfs", "storage", {}, nullptr, test::nearest_half}};

std::string name(const testing::TestParamInfo<Injected>& fault) {
  return fault.param.name;
}
INSTANTIATE_TEST_SUITE_P(OfTheCamera, InjectedFault, testing::ValuesIn(of_the_camera), name);
INSTANTIATE_TEST_SUITE_P(OfDepths, InjectedFault, testing::ValuesIn(of_depths), name);

TEST(InjectedFaults, NoneInACleanMap) {
  for (const char* model : {"gl-float32", "gl-unorm24", "float32-ray"}) {
    const Truth& truth = sphere_and_sheet();
    const bool rays = std::string(model) == "float32-ray";
    const OtherMap map =
        rays ? test::trace_in_binary32(truth.mesh, truth.camera) : drawn_by(truth.camera);
    const Attribution found = attribute_and_name(truth, map, model_named(model));
    EXPECT_EQ(found.count(PixelClass::unexplained), 0U) << model;
    EXPECT_TRUE(found.findings.empty()) << model << ": " << found.findings[0].text;
    EXPECT_TRUE(found.notes.empty()) << model << ": " << found.notes[0].text;
  }
}

TEST(InjectedFaults, TheLens) {
  const Truth& truth = sphere_and_sheet();
  const OtherMap map = test::trace_in_binary32(truth.mesh, truth.camera, {.k1 = -0.02});
  const Attribution found = attribute_and_name(truth, map, model_named("float32-ray"));
  ASSERT_EQ(found.findings.size(), 1U);
  EXPECT_EQ(found.findings[0].kind, "distortion") << found.findings[0].text;
  expect_amounts(found.findings[0], {{"k1", -0.02}});
}

/// Pixels on the sphere, none of which touches another.
Attribution with_strays(std::size_t count, double depth) {
  const Truth& truth = sphere_and_sheet();
  OtherMap map = drawn_by(truth.camera);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t pixel = (30 + 2 * k) * 96 + 40 + 3 * k;
    EXPECT_LT(truth.depths[pixel], infinity);
    map.depths[pixel] = map.values[pixel] = depth;
  }
  return attribute_and_name(truth, map, model_named("gl-float32"));
}

TEST(InjectedFaults, SinglePixels) {
  for (const auto& [count, depth] :
       {std::pair<std::size_t, double>{1, infinity}, {1, 1.25}, {5, 1.25}, {5, infinity}}) {
    const Attribution found = with_strays(count, depth);
    ASSERT_EQ(found.findings.size(), 1U) << count << " of " << depth;
    EXPECT_EQ(found.findings[0].kind, "isolated-pixels") << found.findings[0].text;
    EXPECT_EQ(found.findings[0].pixels, count);
    EXPECT_THAT(found.findings[0].text, HasSubstr("(40, 30) shows "));
    EXPECT_EQ(found.count(PixelClass::unexplained), count) << "that they are few is no cause";
    EXPECT_EQ(found.count(PixelClass::convention), 0U);
  }
}

using Round = double (*)(double);

/// Codes of whole millimetres, as a map of integers has them.
OtherMap in_millimetres(double offset, Round round) {
  OtherMap map = drawn_by(sphere_and_sheet().camera);
  map.code_scale = 1000;
  for (double& depth : map.depths) {
    if (depth < infinity) depth = round(1000 * (depth + offset)) / 1000;
  }
  map.values = map.depths;
  return map;
}

Attribution judged_codes(double offset, Round round) {
  return attribute_and_name(sphere_and_sheet(), in_millimetres(offset, round),
                            model_named("gl-float32"));
}

TEST(InjectedFaults, CodesThatSayWhatTheyAreAreNoFault) {
  const Attribution found = judged_codes(0, std::nearbyint);
  EXPECT_EQ(found.count(PixelClass::unexplained), 0U);
  EXPECT_TRUE(found.findings.empty()) << found.findings[0].text;
}

TEST(InjectedFaults, CodesThatAreRoundedDown) {
  const Attribution found = judged_codes(0, std::floor);
  EXPECT_EQ(found.count(PixelClass::unexplained), 0U);
  ASSERT_EQ(found.findings.size(), 1U);
  EXPECT_EQ(found.findings[0].text, "depths are stored as codes, rounded down");
}

// Less than is exact on the whole, and yet not rounded down.
TEST(InjectedFaults, CodesWithAnOffset) {
  const Attribution found = judged_codes(-1.6e-3, std::nearbyint);
  ASSERT_EQ(found.findings.size(), 1U);
  EXPECT_EQ(found.findings[0].kind, "scale") << found.findings[0].text;
  expect_amounts(found.findings[0], {{"offset", -1.6e-3}});
}

TEST(InjectedFaults, ABackgroundOfZerosIsNoted) {
  const Truth& truth = sphere_and_sheet();
  OtherMap map = drawn_by(truth.camera);
  for (double& value : map.values) value = value < infinity ? value : 0;
  map.depths = map.values;
  const Attribution found = attribute_and_name(truth, map, model_named("gl-float32"));
  EXPECT_EQ(found.count(PixelClass::unexplained), 0U);
  EXPECT_TRUE(found.findings.empty());
  ASSERT_EQ(found.notes.size(), 1U);
  EXPECT_EQ(found.notes[0].kind, "background");
}

}  // namespace
}  // namespace fathom::attribution
