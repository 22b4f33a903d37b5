// Laws that hold bit for bit, and the rational models.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fathom/lens/preimages.h"
#include "tests/lens/lens_oracle.h"

namespace fathom::lens {
namespace {

using oracle::ArbBall;

Lens lens_of(LensModel model, std::array<double, 14> distortion = {}) {
  Lens lens;
  lens.model = model;
  lens.distortion = distortion;
  return lens;
}

/// A camera with skew, mirrored.
Projection camera() {
  std::mt19937_64 random(11);
  Projection made = oracle::random_camera(random);
  made.fx = -std::abs(made.fx);
  made.skew = 0.75;
  return made;
}

bool is_same(const std::array<Interval, 3>& a, const std::array<Interval, 3>& b) {
  for (std::size_t i = 0; i < 3; ++i)
    if (a[i].lower != b[i].lower || a[i].upper != b[i].upper) return false;
  return true;
}

bool is_same(const std::array<DyadicInterval, 3>& a, const std::array<DyadicInterval, 3>& b) {
  for (std::size_t i = 0; i < 3; ++i)
    if (!(a[i].low == b[i].low && a[i].high == b[i].high)) return false;
  return true;
}

/// Both see the same at every sample of a coarse grid.
void expect_same(const Lens& first, const Lens& second) {
  const Preimages a(camera(), first), b(camera(), second);
  EXPECT_EQ(a.disc(), b.disc());
  int rays = 0;
  for (double v = -300.5; v < 1000; v += 97)
    for (double u = -700.5; u < 2000; u += 131) {
      const auto d = a.of(u, v), e = b.of(u, v);
      ASSERT_EQ(d.has_value(), e.has_value()) << u << " " << v;
      if (!d) continue;
      ++rays;
      ASSERT_TRUE(is_same(d->box(), e->box()));
      ASSERT_TRUE(is_same(d->enclosure(100), e->enclosure(100)));
      ASSERT_EQ(d->rational() == nullptr, e->rational() == nullptr);
    }
  EXPECT_GT(rays, 20);
}

TEST(Laws, ALensWithoutDistortionIsThePinhole) {
  for (const LensModel model : oracle::stage_models) {
    SCOPED_TRACE(name_of(model));
    expect_same(lens_of(model), lens_of(LensModel::pinhole));
  }
  expect_same(lens_of(LensModel::simple_pinhole), lens_of(LensModel::pinhole));
  const auto d = Preimages(camera(), Lens()).of(10.5, 20.5);
  ASSERT_TRUE(d.has_value());
  EXPECT_NE(d->rational(), nullptr);
}

TEST(Laws, ModelsAreSpecialCasesOfOthers) {
  expect_same(lens_of(LensModel::simple_radial, {-0.1}), lens_of(LensModel::radial, {-0.1}));
  expect_same(lens_of(LensModel::radial, {-0.1, 0.02}), lens_of(LensModel::opencv, {-0.1, 0.02}));
  expect_same(lens_of(LensModel::opencv, {-0.1, 0.02, 0.003, 0.001}),
              lens_of(LensModel::opencv_14, {-0.1, 0.02, 0.003, 0.001}));
  expect_same(lens_of(LensModel::full_opencv, {-0.1, 0.02, 0.003, 0.001, 0.1, 0.2, -0.1, 0.05}),
              lens_of(LensModel::opencv_14, {-0.1, 0.02, 0.003, 0.001, 0.1, 0.2, -0.1, 0.05}));
  expect_same(lens_of(LensModel::opencv, {-0.1, 0.02, 0.003, 0.001}),
              lens_of(LensModel::brown, {-0.1, 0.02, 0, 0, 0.003, 0.001}));
}

TEST(Laws, StereographicIsADivision) {
  expect_same(lens_of(LensModel::fisheye_stereographic), lens_of(LensModel::division, {-0.25}));
  expect_same(lens_of(LensModel::simple_division, {0.3}), lens_of(LensModel::division, {0.3}));
}

TEST(Division, IsItsFormula) {
  Projection made;
  made.fx = 2;
  made.fy = 4;
  // (x_d, y_d) = (1½, ½), r² = 2½: d = (1½, ½, 1 + k·2½).
  const auto d = Preimages(made, lens_of(LensModel::division, {-0.8})).of(3.0, 2.0);
  ASSERT_TRUE(d.has_value());
  const auto [x, y, z] = d->enclosure(60);
  EXPECT_TRUE(x.low <= Dyadic(1.5) && Dyadic(1.5) <= x.high);
  EXPECT_TRUE(y.low <= Dyadic(0.5) && Dyadic(0.5) <= y.high);
  EXPECT_LT(std::abs(enclose(z.low).lower - -1), 1e-15);
  const double k = -0.8;
  EXPECT_EQ(d->sign_of(ExactVector3{2 * (Dyadic(1.0) + Dyadic(k) * Dyadic(2.5)), 0.0, -3.0}),
            Sign::zero);
  EXPECT_EQ(d->sign_of(QuadraticForm{{1.0, -9.0, 0.0, 0.0, 0.0, 0.0}}), Sign::zero);
}

TEST(Division, EndsWhereTheAngleWouldTurnBack) {
  Projection made;
  const Preimages preimages(made, lens_of(LensModel::division, {0.25}));
  EXPECT_TRUE(preimages.of(std::nextafter(2.0, 0), 0.0).has_value());
  EXPECT_FALSE(preimages.of(2.0, 0.0).has_value());
  EXPECT_TRUE(Preimages(made, lens_of(LensModel::division, {-0.25})).of(1e6, 1e6).has_value());
}

TEST(Division, MayEndAtAnAngle) {
  Lens lens = lens_of(LensModel::fisheye_stereographic);
  lens.max_radius = 2.0;  // r = 2·tan(1)
  const double edge = 2 * std::tan(1.0);
  EXPECT_TRUE(Preimages({}, lens).of(edge * (1 - 1e-15), 0.0).has_value());
  EXPECT_FALSE(Preimages({}, lens).of(edge * (1 + 1e-15), 0.0).has_value());
  lens.max_radius = std::nextafter(std::numbers::pi, 4);
  EXPECT_TRUE(Preimages({}, lens).of(1e300, 0.0).has_value());
  lens.max_radius = std::numbers::pi;
  EXPECT_TRUE(Preimages({}, lens).of(1e10, 0.0).has_value());
  EXPECT_FALSE(Preimages({}, lens).of(1e300, 0.0).has_value());
}

// A pinhole's ray is K⁻¹·(u, v, 1), exactly.
TEST(Pinhole, IsTheInverseOfItsMatrix) {
  const Projection made = camera();
  const auto d = Preimages(made, Lens()).of(100.25, 7.75);
  ASSERT_TRUE(d.has_value() && d->rational() != nullptr);
  const auto& [x, y, z] = *d->rational();
  const HomogeneousImagePoint p = to_image(made, {x, y, z});
  EXPECT_EQ(z.sign(), Sign::positive);
  EXPECT_TRUE(p.U == Dyadic(100.25) * p.W);
  EXPECT_TRUE(p.V == Dyadic(7.75) * p.W);
}

}  // namespace
}  // namespace fathom::lens
