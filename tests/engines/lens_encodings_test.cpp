// Codes, binary64 and Zlow under lenses: the fast engine against the reference engine, bit for bit.
// Nearly all values are rounded from a bound; values at or next to a tie need exact numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "fathom/failures/errors.h"
#include "fathom/render.h"
#include "tests/adversaries.h"
#include "tests/engines/expect_same_map.h"
#include "tests/inputs/lens_scenes.h"
#include "tests/inputs/spheres.h"
#include "tests/inputs/tables_of_directions.h"

namespace fathom {
namespace {

using checks::expect_same;
using checks::expect_same_map;
using checks::Kind;

/// A lens of the model that bends rays, and sees most of the image.
Lens lens_of(LensModel model) {
  switch (model) {
    case LensModel::opencv:
      return {model, {-0.05, 0.01, 0.002, -0.003}};
    case LensModel::full_opencv:
      return {model, {-0.1, 0.02, 0.001, 0.002, 0.003, 0.05, 0.01, 0.001}};
    case LensModel::opencv_14:
      return {model, {-0.1, 0.02, 0.001, 0.002, 0, 0, 0, 0, 0.01, 0, 0.004, 0.001, 0.05, -0.03}};
    case LensModel::thin_prism_fisheye:
      return {model, {0.02, -0.01, 0.001, -0.002, 0.003, 0.001, 0.01, -0.005}};
    case LensModel::double_sphere:
      return {model, {-0.25, 0.6}};
    case LensModel::eucm:
      return {model, {0.45, 1.5}};
    case LensModel::ucm:
    case LensModel::omni:
      return {model, {0.625}};
    case LensModel::ftheta:
      return {model, {0, 1, 0.0625, -0.03125}};
    case LensModel::fisheye_stereographic:
    case LensModel::simple_fisheye:
    case LensModel::fisheye:
    case LensModel::fisheye_orthographic:
    case LensModel::fisheye_equisolid:
    case LensModel::equirectangular:
    case LensModel::cylindrical:
      return {model};
    default:
      return {model, {-0.05}};
  }
}

constexpr std::uint32_t width = 32, height = 28;

Camera camera_with(const Lens& lens) {
  Camera camera = checks::camera_of(width, height, 18);
  camera.projection.cx = 15.25;
  if (is_panorama(lens.model)) {
    camera.projection.fx = 110;
    camera.projection.fy = lens.model == LensModel::cylindrical ? 18 : 55;
  }
  camera.projection.lens = lens;
  camera.world_to_camera[2][3] = 3;
  return camera;
}

RenderOptions options_of(const DepthEncoding& encoding, LensModel model) {
  RenderOptions options;
  options.depth_encoding = encoding;
  options.channels = {Channel::distance, Channel::id};
  // Codes hold no depth of a ray that goes sideways or back.
  if (encoding.type == StoredType::binary64 || is_plane(model))
    options.channels.push_back(Channel::Z);
  if (encoding.type == StoredType::binary64) options.channels.push_back(Channel::Zlow);
  return options;
}

/// At most one pixel of 50 needs exact numbers.
void expect_fast(const Scene& scene, const Camera& camera, const DepthEncoding& encoding) {
  const RenderStatistics statistics =
      expect_same(scene, camera, options_of(encoding, camera.projection.lens->model));
  EXPECT_GT(statistics.pixels_with_surface, 30U);
  EXPECT_LE(statistics.rounding.exact * 50, statistics.pixels_with_surface);
}

const std::vector<DepthEncoding> encodings{{StoredType::binary64},
                                           {StoredType::scaled_unorm16, 1000},
                                           {StoredType::scaled_unorm16, 256, false, 3},
                                           {StoredType::scaled_unorm16, 22000, true}};

class EncodingsOf : public ::testing::TestWithParam<LensModel> {};

TEST_P(EncodingsOf, AreTheReferenceEngines) {
  const Scene scene = checks::two_spheres(16);
  for (const DepthEncoding& encoding : encodings)
    expect_fast(scene, camera_with(lens_of(GetParam())), encoding);
}

// The eye is within the scene, and rays go to all sides.
TEST_P(EncodingsOf, AreTheReferenceEnginesAllAround) {
  const Scene scene = checks::two_spheres(12);
  Camera camera = camera_with(lens_of(GetParam()));
  camera.world_to_camera[2][3] = 0.125;
  for (const std::size_t i : {0U, 1U}) expect_fast(scene, camera, encodings[i]);
}

std::string name_of_model(const ::testing::TestParamInfo<LensModel>& info) {
  return std::string(name_of(info.param));
}

INSTANTIATE_TEST_SUITE_P(FastLenses, EncodingsOf, ::testing::ValuesIn(checks::bending_models()),
                         name_of_model);

TEST(FastLensEncodings, ATableOfDirections) {
  const Camera camera = checks::with_table(
      camera_with({}), checks::DirectionMaker(7).numbers(std::size_t{width} * height));
  const Scene scene = checks::two_spheres(12);
  Camera inside = camera;
  inside.world_to_camera[2][3] = 0.125;
  for (const DepthEncoding& encoding : encodings)
    expect_same(scene, inside, options_of(encoding, LensModel::table));
}

/// A wall across the whole image, at a depth that is a sum of two binary64 numbers.
struct Wall {
  double mesh, shift;
};

DepthMap of_wall(const Wall& wall, LensModel model, const DepthEncoding& encoding) {
  const Scene scene = checks::scene_of(
      {{-60, -60, wall.mesh}, {180, -60, wall.mesh}, {-60, 180, wall.mesh}}, {{0, 1, 2}});
  Camera camera = camera_with(lens_of(model));
  camera.world_to_camera[2][3] = wall.shift;
  RenderOptions options;
  options.channels = {Channel::Z};
  options.depth_encoding = encoding;
  const DepthMap truth = render_reference(scene, camera, options).map;
  DepthMap fast = render_fast(scene, camera, options).map;
  expect_same_map(fast, truth);
  return fast;
}

constexpr std::size_t middle = 14 * width + 15;

// 2.0625 is 2062.5 codes: the tie goes to the even one; its neighbours do not.
TEST(FastLensEncodings, CodesAtATie) {
  for (const LensModel model :
       {LensModel::opencv, LensModel::opencv_fisheye, LensModel::division}) {
    const auto code = [&](const Wall& wall) {
      const DepthMap map = of_wall(wall, model, {StoredType::scaled_unorm16, 1000});
      return (*map.values<std::uint16_t>("Z"))[middle];
    };
    EXPECT_EQ(code({2.0625, 0}), 2062);
    EXPECT_EQ(code({2.0625, 0x1p-80}), 2063);
    EXPECT_EQ(code({2.0625, -0x1p-80}), 2062);
    EXPECT_EQ(code({2.1875, 0}), 2188);
    EXPECT_EQ(code({2.1875, -0x1p-80}), 2187);
  }
}

// 1 + 2⁻⁵³ is in the middle of two binary64 numbers.
TEST(FastLensEncodings, Binary64AtATie) {
  for (const LensModel model : {LensModel::opencv, LensModel::fisheye, LensModel::ucm}) {
    const auto depth = [&](const Wall& wall) {
      return (*of_wall(wall, model, {StoredType::binary64}).values<double>("Z"))[middle];
    };
    EXPECT_EQ(depth({1, 0x1p-53}), 1);
    EXPECT_EQ(depth({1, 0x1.8p-52}), 1 + 0x1p-51);
    EXPECT_EQ(depth({1 + 0x1p-52, 0x1p-53}), 1 + 0x1p-51);
    EXPECT_EQ(depth({1, 0x1.0000000000001p-53}), 1 + 0x1p-52);
    EXPECT_EQ(depth({1, 0x1.fffffffffffffp-54}), 1);
  }
}

/// The message of a depth that no code holds, or nothing.
template <class Render>
std::string fault_of(const Render& render) {
  try {
    render();
  } catch (const OutputError& error) {
    return error.what();
  }
  return {};
}

TEST(FastLensEncodings, TheSamePixelIsRefused) {
  const Scene scene = checks::two_spheres(12);
  for (const LensModel model : {LensModel::opencv, LensModel::opencv_fisheye}) {
    for (const double scale : {40000.0, 0.05}) {
      const Camera camera = camera_with(lens_of(model));
      RenderOptions options;
      options.depth_encoding = {StoredType::scaled_unorm16, scale};
      const std::string truth = fault_of([&] { render_reference(scene, camera, options); });
      EXPECT_NE(truth, "");
      EXPECT_EQ(fault_of([&] { render_fast(scene, camera, options); }), truth);
    }
  }
}

class EncodingAdversaries : public ::testing::TestWithParam<LensModel> {};

// Corners and edges on rays, neighbours of ties, and numbers that overflow.
TEST_P(EncodingAdversaries, AreTheSame) {
  checks::for_each_adversary(30, [&](std::uint64_t seed) {
    constexpr std::array kinds{Kind::few_bits, Kind::neighbours, Kind::huge, Kind::tiny};
    checks::LensCaseMaker maker(10000 * seed + 77 + static_cast<std::uint64_t>(GetParam()),
                                kinds[seed % 4]);
    const checks::LensCase c = maker.make(GetParam());
    const DepthEncoding encoding = seed % 3 == 0
                                       ? DepthEncoding{StoredType::scaled_unorm16, 0.5, true}
                                       : DepthEncoding{StoredType::binary64};
    const RenderOptions options = options_of(encoding, GetParam());
    DepthMap truth, ours;
    const std::string fault =
        fault_of([&] { truth = render_reference(c.view.scene, c.view.camera, options).map; });
    EXPECT_EQ(fault_of([&] { ours = render_fast(c.view.scene, c.view.camera, options).map; }),
              fault);
    if (fault.empty()) expect_same_map(ours, truth);
  });
}

INSTANTIATE_TEST_SUITE_P(FastLenses, EncodingAdversaries,
                         ::testing::ValuesIn(checks::bending_models()), name_of_model);

}  // namespace
}  // namespace fathom
