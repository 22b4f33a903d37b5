// Z and distance are rounded once from the exact number, whatever the type asked for.
#include <gmock/gmock.h>
#include <gmp.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fathom/failures/errors.h"
#include "tests/engines/tested_engine.h"
#include "tests/inputs/scene_building.h"

namespace fathom {
namespace {

/// A wall across the view at depth z.
Scene wall(double z) {
  const double r = 100 * z;
  return checks::scene_of({{-r, -r, z}, {r, -r, z}, {0, 2 * r, z}}, {{0, 1, 2}});
}

RenderOptions scaled(double scale) {
  RenderOptions options;
  options.depth_encoding = {DepthEncoding::Type::scaled_unorm16, scale};
  return options;
}

std::uint16_t code(double z, double scale) {
  const DepthMap map = checks::render_tested(wall(z), checks::camera_of(1, 1, 1), scaled(scale));
  EXPECT_EQ(map.png_scale, scale);
  return map.values<std::uint16_t>("Z")->at(0);
}

TEST(Encoding, CodesRoundHalfToEven) {
  EXPECT_EQ(code(2.5, 1), 2);
  EXPECT_EQ(code(3.5, 1), 4);
  EXPECT_EQ(code(std::nextafter(2.5, 3), 1), 3);
  EXPECT_EQ(code(1.25, 1000), 1250);
  EXPECT_EQ(code(65535.49, 1), 65535);
}

/// The integer nearest to z·scale/divisor, ties to even, by GMP's quotients alone.
std::uint16_t exact_code(double z, double scale, double divisor) {
  mpq_t exact, other;
  mpq_inits(exact, other, nullptr);
  mpq_set_d(exact, z);
  mpq_set_d(other, scale);
  mpq_mul(exact, exact, other);
  mpq_set_d(other, divisor);
  mpq_div(exact, exact, other);
  mpz_t code;
  mpz_init(code);
  mpz_fdiv_q(code, mpq_numref(exact), mpq_denref(exact));
  mpq_set_z(other, code);
  mpq_sub(exact, exact, other);
  const int side = mpq_cmp_ui(exact, 1, 2);
  const unsigned long below = mpz_get_ui(code);
  mpz_clear(code);
  mpq_clears(exact, other, nullptr);
  return static_cast<std::uint16_t>(below + (side > 0 || (side == 0 && below % 2 == 1) ? 1 : 0));
}

TEST(Encoding, CodesOfADivisorAreExactQuotientsRoundedOnce) {
  const auto code_of = [](double z, double scale, double divisor) {
    RenderOptions options = scaled(scale);
    options.depth_encoding.divisor = divisor;
    const DepthMap map = checks::render_tested(wall(z), checks::camera_of(1, 1, 1), options);
    EXPECT_EQ(map.png_scale, scale / divisor);
    return map.values<std::uint16_t>("Z")->at(0);
  };
  // 0.1 in binary64 is more than a tenth, so the quotient lies below the tie, whose even code is
  // 10008.
  EXPECT_EQ(code_of(1000.75, 1, 0.1), 10007);
  EXPECT_EQ(code_of(1000.75, 10, 1), 10008);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> any(0.001, 10);
  int otherwise = 0;
  for (int i = 0; i < 2000; ++i) {
    const double divisor = i % 3 == 0 ? 0.1 : i % 3 == 1 ? 0.001 * (1 + i % 999) : any(random);
    const double scale = i % 2 == 0 ? 1 : any(random);
    // At most two ulp beside a tie.
    double z = (static_cast<double>(1 + random() % 65000) + 0.5) * divisor / scale;
    for (unsigned k = random() % 3; k > 0; --k) z = std::nextafter(z, i % 5 < 2 ? 0 : 1e9);
    const std::uint16_t exact = exact_code(z, scale, divisor);
    ASSERT_EQ(code_of(z, scale, divisor), exact)
        << std::hexfloat << z << " " << scale << " " << divisor;
    otherwise += code(z, scale / divisor) != exact;
  }
  EXPECT_GT(otherwise, 100);  // with the quotient rounded first
}

TEST(Encoding, ADepthBeyondTheCodesIsNoneWhereThatIsAskedFor) {
  const auto code_or_none = [](double z) {
    RenderOptions options = scaled(1);
    options.depth_encoding.beyond_is_none = true;
    const DepthMap map = checks::render_tested(wall(z), checks::camera_of(1, 1, 1), options);
    return map.values<std::uint16_t>("Z")->at(0);
  };
  // Half way to 65536, which is even.
  EXPECT_EQ(code_or_none(std::nextafter(65535.5, 0)), 65535);
  EXPECT_EQ(code_or_none(65535.5), 0);
  EXPECT_EQ(code_or_none(1e300), 0);
  EXPECT_THROW(code_or_none(0.5), OutputError);
}

TEST(Encoding, ADepthThatDoesNotFitIsAnErrorThatNamesThePixel) {
  const auto message = [](double z, double scale) -> std::string {
    try {
      checks::render_tested(wall(z), checks::camera_of(3, 2, 1), scaled(scale));
    } catch (const OutputError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(message(65535.5, 1), ::testing::HasSubstr("pixel (0, 0)"));
  EXPECT_THAT(message(65535.5, 1), ::testing::HasSubstr("above 65535"));
  EXPECT_THAT(message(0.5, 1), ::testing::HasSubstr("no surface"));
  EXPECT_EQ(message(1, 1), "no error");
}

TEST(Encoding, Binary64IsRoundedFromTheExactDepth) {
  // z = 1 / (1/3-like slope): a plane whose depth at the only sample is 1/3 exactly.
  Scene scene = checks::scene_of({{-9, -9, 3}, {9, -9, 3}, {0, 18, 3}}, {{0, 1, 2}});
  Camera camera = checks::camera_of(1, 1, 1);
  camera.projection.model = ProjectionModel::perspective;
  camera.projection.cx = 0.5 - 3;                                       // the ray (3, 0, 1)
  scene.meshes[0].vertices = {{-9, -1, 10}, {9, -1, -8}, {9, 30, -8}};  // x + z = 1
  scene.meshes[0].vertices[0] = {-9, -30, 10};
  RenderOptions options;
  options.depth_encoding.type = DepthEncoding::Type::binary64;
  options.channels = {Channel::Z, Channel::distance};
  const DepthMap map = checks::render_tested(scene, camera, options);
  // (3z) + z = 1: z = 1/4; the ray distance is √10 / 4.
  EXPECT_EQ(map.values<double>("Z")->at(0), 0.25);
  EXPECT_EQ(map.values<double>("distance")->at(0), std::sqrt(10.0) / 4);
}

TEST(Encoding, DepthsBeyondBinary32OverflowAndUnderflow) {
  RenderOptions options;
  options.channels = {Channel::Z, Channel::Zlow, Channel::id};
  const DepthMap far = checks::render_tested(wall(1e100), checks::camera_of(1, 1, 1), options);
  EXPECT_EQ(far.values<float>("Z")->at(0), std::numeric_limits<float>::infinity());
  EXPECT_EQ(far.values<float>("Zlow")->at(0), 0.0F);
  EXPECT_EQ(far.values<std::uint32_t>("id")->at(0), 0U);
  const DepthMap near = checks::render_tested(wall(1e-42), checks::camera_of(1, 1, 1), options);
  EXPECT_EQ(near.values<float>("Z")->at(0), 1e-42F);  // a subnormal is kept
  const DepthMap nearest = checks::render_tested(wall(1e-60), checks::camera_of(1, 1, 1), options);
  EXPECT_EQ(nearest.values<float>("Z")->at(0), 0.0F);
  EXPECT_EQ(nearest.values<std::uint32_t>("id")->at(0), 0U);
}

TEST(Encoding, ChannelsAskedForTwiceAreWrittenOnce) {
  RenderOptions options;
  options.channels = {Channel::Z, Channel::id, Channel::Z};
  EXPECT_EQ(checks::render_tested(wall(2), checks::camera_of(1, 1, 1), options).channels.size(),
            2U);
}

TEST(Encoding, TheMapSaysHowItWasMade) {
  const DepthMap map = checks::render_tested(wall(2), checks::camera_of(4, 3, 1));
  const bool fast = checks::tested_engine() == Engine::fast;
  EXPECT_EQ(map.texts.at("fathom.engine"), fast ? "fast" : "reference");
  EXPECT_THAT(texts_of(map).at("fathom.camera"), ::testing::HasSubstr("world_to_camera"));
  EXPECT_EQ(map.object_names, std::vector<std::string>{"object"});
}

}  // namespace
}  // namespace fathom
