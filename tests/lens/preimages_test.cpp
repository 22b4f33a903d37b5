// Preimages against the oracle: where there is a ray, and which.
#include "fathom/lens/preimages.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/effort.h"
#include "tests/lens/lens_oracle.h"
#include "tests/special_values.h"

namespace fathom::lens {
namespace {

using oracle::ArbBall;
using oracle::NamedParameters;
using Point = oracle::OraclePoint<ArbBall>;

std::string described(const Lens& lens) {
  std::string text(name_of(lens.model));
  for (const double x : lens.distortion) text += " " + std::to_string(x);
  return text;
}

/// Whether the direction's box and enclosures contain the oracle's, and how narrow the box is.
void expect_same(const ExactDirection& direction, const Point& m) {
  for (const long bits : {30L, 100L, 300L}) {
    const auto d = direction.enclosure(bits);
    EXPECT_TRUE(ArbBall::hull(d[0].low, d[0].high).meets(m.x)) << bits;
    EXPECT_TRUE(ArbBall::hull(d[1].low, d[1].high).meets(m.y)) << bits;
    EXPECT_TRUE(d[2].low == Dyadic(1.0) && d[2].high == Dyadic(1.0));
    const ArbBall width = ArbBall(d[0].high) - ArbBall(d[0].low);
    const ArbBall size = (m.x * m.x + m.y * m.y).root();
    EXPECT_LT(width.approximate(), 4 * std::ldexp(size.approximate(), static_cast<int>(-bits)));
  }
  const auto& box = direction.box();
  EXPECT_TRUE(ArbBall::hull(box[0].lower, box[0].upper).meets(m.x));
  EXPECT_TRUE(ArbBall::hull(box[1].lower, box[1].upper).meets(m.y));
}

struct Case {
  Lens lens;
  Projection camera;
};

Case random_case(std::uint64_t seed, LensModel model) {
  std::mt19937_64 random(seed);
  const double size = std::array{0.05, 0.3, 1.0}[seed % 3];
  Case made{oracle::random_lens(random, model, size), {}};
  made.camera = oracle::random_camera(random);
  return made;
}

class StageModels : public ::testing::TestWithParam<LensModel> {};
INSTANTIATE_TEST_SUITE_P(Lenses, StageModels, ::testing::ValuesIn(oracle::stage_models),
                         [](const auto& model) { return std::string(name_of(model.param)); });

TEST_P(StageModels, HaveThePreimagesOfTheOracle) {
  int found = 0, none = 0;
  for (std::uint64_t seed = 0; seed < 24 / checks::effort + 1; ++seed) {
    const auto [lens, camera] = random_case(seed, GetParam());
    SCOPED_TRACE(described(lens));
    const Preimages preimages(camera, lens);
    const NamedParameters numbers(lens);
    for (const auto& [u, v] :
         {std::pair{640.5, 360.5}, {0.5, 0.5}, {100.25, 600.75}, {900.5, 12.5}}) {
      const auto direction = preimages.of(u, v);
      if (std::isfinite(preimages.disc())) {
        const int expected = oracle::windings(camera, numbers, u, v, preimages.disc());
        EXPECT_EQ(direction.has_value(), expected == 1) << u << " " << v;
      }
      if (!direction) {
        ++none;
        continue;
      }
      ++found;
      const auto m = oracle::preimage(camera, numbers, u, v, preimages.disc());
      ASSERT_TRUE(m.has_value());
      expect_same(*direction, *m);
    }
  }
  EXPECT_GT(found, 0);
  if (checks::effort == 1) {
    EXPECT_GT(none, 0);
  }
}

/// The sample of a point at this angle whose |m|² is Q·(1 ± 2⁻⁷⁰), rounded to 300 bits; nullopt if
/// the sensor does not show it.
std::optional<std::pair<Dyadic, Dyadic>> sample_at_edge(const Case& c, double q, double angle,
                                                        int side) {
  const ArbBall factor = ArbBall(1.0) + ArbBall(side * 0x1p-70);
  const ArbBall x(std::cos(angle)), y(std::sin(angle));
  const ArbBall r = (ArbBall(q) * factor / (x * x + y * y)).root();
  const Point m{r * x, r * y};
  const NamedParameters numbers(c.lens);
  if (!oracle::is_shown(numbers, m)) return std::nullopt;
  const Point sample = oracle::sample_of(c.camera, numbers, m);
  return std::pair{sample.x.rounded(300), sample.y.rounded(300)};
}

TEST_P(StageModels, EndAtQ) {
  for (std::uint64_t seed = 100; seed < 112; ++seed) {
    const Case c = random_case(seed, GetParam());
    SCOPED_TRACE(described(c.lens));
    const Preimages preimages(c.camera, c.lens);
    if (std::isinf(preimages.disc())) continue;
    for (const double angle : {0.3, 2.1, 4.0}) {
      const auto shown = sample_at_edge(c, preimages.disc(), angle, -1);
      if (!shown) continue;
      const auto [u, v] = *shown;
      const auto inside = preimages.of(u, v);
      ASSERT_TRUE(inside.has_value());
      const auto m = oracle::preimage(c.camera, NamedParameters(c.lens), u, v, preimages.disc());
      if (m) expect_same(*inside, *m);
      const auto [u_outside, v_outside] = sample_at_edge(c, preimages.disc(), angle, 1).value();
      EXPECT_FALSE(preimages.of(u_outside, v_outside).has_value());
    }
  }
}

TEST_P(StageModels, EndAtMaxRadius) {
  Case c = random_case(3, GetParam());
  for (double& x : c.lens.distortion) x /= 64;  // the disc reaches farther
  c.lens.max_radius = 0.25 + 0x1p-40;
  const Preimages preimages(c.camera, c.lens);
  ASSERT_GT(preimages.disc(), 0.1);
  const double q = c.lens.max_radius * c.lens.max_radius;  // rounded, within 2⁻⁵³ of the limit
  for (const double angle : {0.1, 3.3}) {
    const auto [u, v] = sample_at_edge(c, q * (1 - 0x1p-50), angle, -1).value();
    EXPECT_TRUE(preimages.of(u, v).has_value());
    const auto [u_outside, v_outside] = sample_at_edge(c, q * (1 + 0x1p-50), angle, 1).value();
    EXPECT_FALSE(preimages.of(u_outside, v_outside).has_value());
  }
}

TEST(Preimages, OnTheCircleOfMaxRadiusBelong) {
  Lens lens;
  lens.model = LensModel::simple_radial;
  lens.distortion[0] = 0.5;
  lens.max_radius = 0.625;  // m = (3, 4)/8, L = 1 + 25/128
  Projection camera;
  const double L = 1 + 25.0 / 128;
  EXPECT_TRUE(Preimages(camera, lens).of(0.375 * L, 0.5 * L).has_value());
  lens.max_radius = std::nextafter(0.625, 0);
  EXPECT_FALSE(Preimages(camera, lens).of(0.375 * L, 0.5 * L).has_value());
}

TEST(Preimages, OfHugeAndTinyNumbersEnd) {
  Lens lens;
  lens.model = LensModel::opencv;
  for (const double k : {1e300, -1e300, 1e-300, -1e-300}) {
    lens.distortion = {k, 0, k / 2, k / 4};
    Projection camera;
    camera.fx = 1e-3;
    camera.fy = 1e3;
    const Preimages preimages(camera, lens);
    for (const double u : {0.0, 1e-160, 1e-3, 1e200}) {
      const auto direction = preimages.of(u, u / 3);
      if (!direction) continue;
      EXPECT_EQ(direction->sign_of(ExactVector3{1.0, 0.0, 0.0}), sign_of(u > 0)) << k << " " << u;
    }
  }
}

TEST(Preimages, OfTheAxisIsRational) {
  Lens lens;
  lens.model = LensModel::opencv_14;
  lens.distortion = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8};
  const Preimages preimages({}, lens);
  const auto direction = preimages.of(0.0, 0.0);
  ASSERT_TRUE(direction.has_value());
  ASSERT_NE(direction->rational(), nullptr);
  EXPECT_EQ(direction->sign_of(ExactVector3{1.0, 0.0, 0.0}), Sign::zero);
  EXPECT_EQ(preimages.of(0.1, 0.0)->rational(), nullptr);
  EXPECT_EQ(Preimages({}, Lens()).disc(), infinity);
}

}  // namespace
}  // namespace fathom::lens
