// Directions with a square root against the published forward models and an oracle in Arb: samples,
// signs of forms, ties, and where images end.
#include "fathom/lens/root_direction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fathom/lens/preimages.h"
#include "tests/effort.h"
#include "tests/lens/expect_direction.h"
#include "tests/lens/lens_oracle.h"

namespace fathom::lens {
namespace {

using oracle::ArbBall;
using oracle::Direction;
using Point = oracle::OraclePoint<ArbBall>;

const ArbBall one(1.0), two(2.0), half(0.5);

/// (x_d, y_d) of a direction, as the publications of the models have it: x_d = X/n, y_d = Y/n.
Point projected(const Lens& lens, const Direction& d) {
  const ArbBall &z = d[2], aside = d[0] * d[0] + d[1] * d[1], length = (aside + z * z).root();
  const auto over = [&d](const ArbBall& n) { return Point{d[0] / n, d[1] / n}; };
  const oracle::NamedParameters numbers(lens);
  const ArbBall alpha(numbers["alpha"]), xi(numbers["xi"]);
  switch (lens.model) {
    case LensModel::fisheye_orthographic:  // r = sin θ
      return over(length);
    case LensModel::fisheye_equisolid:  // r = 2·sin(θ/2), 2·sin²(θ/2) = 1 − cos θ
      return over(aside.root() / (two * (one - z / length)).root());
    case LensModel::ucm:
      return over(alpha * length + (one - alpha) * z);
    case LensModel::eucm:
      return over(alpha * (ArbBall(numbers["beta"]) * aside + z * z).root() + (one - alpha) * z);
    case LensModel::double_sphere: {
      const ArbBall ahead = xi * length + z, second = (aside + ahead * ahead).root();
      return over(alpha * second + (one - alpha) * ahead);
    }
    default:  // OMNI
      return over(z + xi * length);
  }
}

/// The direction that (x, y) sees, as the specification has it.
Direction direction_of(const Lens& lens, const Point& y) {
  const oracle::NamedParameters numbers(lens);
  const ArbBall r2 = y.x * y.x + y.y * y.y, alpha(numbers["alpha"]), xi(numbers["xi"]);
  const ArbBall beta(lens.model == LensModel::eucm ? numbers["beta"] : 1);
  switch (lens.model) {
    case LensModel::fisheye_orthographic:
      return {y.x, y.y, (one - r2).root()};
    case LensModel::fisheye_equisolid: {
      const ArbBall c = (one - r2 / ArbBall(4.0)).root();
      return {c * y.x, c * y.y, one - half * r2};
    }
    case LensModel::ucm:
    case LensModel::eucm: {
      const ArbBall S = (one - (two * alpha - one) * beta * r2).root();
      return {y.x, y.y, (one - alpha * alpha * beta * r2) / (alpha * S + one - alpha)};
    }
    case LensModel::double_sphere: {
      const ArbBall S = (one - (two * alpha - one) * r2).root();
      const ArbBall z = (one - alpha * alpha * r2) / (alpha * S + one - alpha);
      const ArbBall kappa = (z * xi + (z * z + (one - xi * xi) * r2).root()) / (z * z + r2);
      return {kappa * y.x, kappa * y.y, kappa * z - xi};
    }
    default: {
      const ArbBall eta = (xi + (one + (one - xi * xi) * r2).root()) / (one + r2);
      return {eta * y.x, eta * y.y, eta - xi};
    }
  }
}

template <class Box>
Direction hull_of(const Box& box) {
  const auto of = [](const auto& x) {
    if constexpr (requires { x.low; })
      return ArbBall::hull(x.low, x.high);
    else
      return ArbBall::hull(x.lower, x.upper);
  };
  return {of(box[0]), of(box[1]), of(box[2])};
}

/// Whether a box may contain a positive multiple of a direction.
bool may_contain(const Direction& box, const Direction& d) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    if (!(box[k] * d[next]).meets(box[next] * d[k])) return false;
  }
  return (box[0] * d[0] + box[1] * d[1] + box[2] * d[2]).sign() > 0;
}

void expect_encloses_multiple(const ExactDirection& direction, const Direction& exact) {
  for (const long bits : {30L, 100L, 300L}) {
    const auto d = direction.enclosure(bits);
    EXPECT_TRUE(may_contain(hull_of(d), exact)) << bits;
    for (const DyadicInterval& x : d)
      EXPECT_LE((ArbBall(x.high) - ArbBall(x.low)).approximate(),
                std::ldexp(1.0, static_cast<int>(-bits)));
  }
  EXPECT_TRUE(may_contain(hull_of(direction.box()), exact));
  if (direction.rational() != nullptr) return;  // of z = 1, where alpha is 0
  double greatest = 0;
  for (const Interval& x : direction.box()) {
    EXPECT_LT(x.upper - x.lower, 0x1p-50);
    greatest = std::max({greatest, std::abs(x.lower), std::abs(x.upper)});
  }
  EXPECT_GE(greatest, 0.25);
  EXPECT_LE(greatest, 2);
}

class Roots : public ::testing::TestWithParam<LensModel> {};
INSTANTIATE_TEST_SUITE_P(Lenses, Roots,
                         ::testing::Values(LensModel::fisheye_orthographic,
                                           LensModel::fisheye_equisolid, LensModel::ucm,
                                           LensModel::eucm, LensModel::double_sphere,
                                           LensModel::omni),
                         [](const auto& model) { return std::string(name_of(model.param)); });

/// Numbers within the ranges of the parameters, their ends among them.
Lens random_lens(std::mt19937_64& random, LensModel model) {
  std::uniform_real_distribution<double> uniform(0, 1);
  Lens lens{model};
  if (model == LensModel::omni) lens.distortion[0] = 2 * uniform(random);
  if (model == LensModel::double_sphere)
    lens.distortion = {2 * uniform(random) - 1, random() % 4 == 0 ? 1 : uniform(random)};
  if (model == LensModel::ucm || model == LensModel::eucm)
    lens.distortion[0] =
        random() % 4 == 0 ? 0.5 * static_cast<double>(random() % 3) : uniform(random);
  if (model == LensModel::eucm) lens.distortion[1] = 0.1 + 3 * uniform(random);
  return lens;
}

TEST_P(Roots, SeeWhatTheForwardModelShows) {
  int found = 0, beyond_90_degrees = 0, without_ray = 0;
  for (std::uint64_t seed = 0; seed < 60 / checks::effort + 2; ++seed) {
    std::mt19937_64 random(seed);
    const Lens lens = random_lens(random, GetParam());
    Projection camera = oracle::random_camera(random);
    camera.fx /= 2;
    camera.fy /= 2;
    const Preimages preimages(camera, lens);
    const double end = RootProfile(*root_formula(lens)).end();
    for (const auto& [u, v] :
         {std::pair{640.5, 360.5}, {300.5, 200.25}, {100.25, 600.75}, {900.5, 12.5}}) {
      const Point y = oracle::distorted_point(camera, u, v);
      const auto d = preimages.of(u, v);
      const double r = (y.x * y.x + y.y * y.y).root().approximate();
      ASSERT_EQ(d.has_value(), r < end) << seed << ' ' << r;
      if (!d) {
        ++without_ray;
        continue;
      }
      ++found;
      const Direction exact = direction_of(lens, y);
      const Point image = projected(lens, exact);
      EXPECT_LT(std::abs((image.x - y.x).approximate()), 1e-100);
      EXPECT_LT(std::abs((image.y - y.y).approximate()), 1e-100);
      beyond_90_degrees += exact[2].sign() < 0 ? 1 : 0;
      expect_encloses_multiple(*d, exact);
      for (const int offset : {4, 40, 100, 250, 380})
        oracle::expect_signs_of_oracle(*d, exact, offset, random);
    }
  }
  EXPECT_GT(found, 0);
  if (checks::effort > 1) return;
  EXPECT_EQ(beyond_90_degrees > 0, GetParam() != LensModel::fisheye_orthographic);
  if (GetParam() != LensModel::fisheye_equisolid) {
    EXPECT_GT(without_ray, 0);
  }
}

TEST(OmniWithDistortion, SeesWhatTheOracleSees) {
  int found = 0, beyond_90_degrees = 0;
  for (std::uint64_t seed = 0; seed < 30 / checks::effort + 2; ++seed) {
    std::mt19937_64 random(seed);
    Lens lens = oracle::random_lens(random, LensModel::omni, std::array{0.02, 0.1, 0.3}[seed % 3]);
    lens.distortion[0] = std::uniform_real_distribution<double>(0, 1.5)(random);
    Projection camera = oracle::random_camera(random);
    camera.fx /= 2;
    camera.fy /= 2;
    const Preimages preimages(camera, lens);
    for (const auto& [u, v] :
         {std::pair{640.5, 360.5}, {300.5, 200.25}, {100.25, 600.75}, {900.5, 12.5}}) {
      const auto d = preimages.of(u, v);
      const auto m =
          oracle::preimage(camera, oracle::NamedParameters(lens), u, v, preimages.disc());
      ASSERT_EQ(d.has_value(), m.has_value()) << seed << ' ' << u << ' ' << v;
      if (!d) continue;
      ++found;
      const Direction exact = direction_of(lens, *m);
      beyond_90_degrees += exact[2].sign() < 0 ? 1 : 0;
      for (const long bits : {30L, 100L, 300L})
        EXPECT_TRUE(may_contain(hull_of(d->enclosure(bits)), exact)) << bits;
      EXPECT_TRUE(may_contain(hull_of(d->box()), exact));
      for (const int offset : {4, 40, 100, 250, 380})
        oracle::expect_signs_of_oracle(*d, exact, offset, random);
    }
  }
  EXPECT_GT(found, 0);
  if (checks::effort == 1) {
    EXPECT_GT(beyond_90_degrees, 0);
  }
}

// (ξ² − 1)·|m|² < 1; without distortion the same is asked of the sample.
TEST(OmniWithDistortion, EndsWithTheRoot) {
  const Lens lens{LensModel::omni, {1.25, 0.25}};
  const double q = Preimages({}, lens).disc();
  EXPECT_LT(Dyadic(0.5625) * Dyadic(q), Dyadic(1.0));
  EXPECT_GE(Dyadic(0.5625) * Dyadic(std::nextafter(q, 2)), Dyadic(1.0));
  const double r = std::sqrt(q) * (1 + 0.25 * q);
  EXPECT_TRUE(Preimages({}, lens).of(r * (1 - 1e-15), 0.0).has_value());
  EXPECT_FALSE(Preimages({}, lens).of(r * (1 + 1e-15), 0.0).has_value());
}

/// A sample at (u/f, v/f), whose direction is a positive multiple of integers.
struct RationalRay {
  Lens lens;
  double f, u, v;
  std::array<double, 3> d;
};

// Roots of these samples are rational: 4/5, 1/3, 2, ….
const RationalRay rational_rays[] = {
    {{LensModel::fisheye_orthographic}, 5, 3, 0, {3, 0, 4}},
    {{LensModel::fisheye_orthographic}, 13, -3, 4, {-3, 4, 12}},
    {{LensModel::fisheye_equisolid}, 5, 6, 0, {24, 0, 7}},
    {{LensModel::fisheye_equisolid}, 5, 0, -8, {0, -24, -7}},
    {{LensModel::ucm, {1}}, 13, 3, 4, {3, 4, 12}},
    {{LensModel::ucm, {0.75}}, 3, 4, 0, {1, 0, 0}},
    {{LensModel::ucm, {0.5}}, 1, 2, 4, {2, 4, -4}},
    {{LensModel::eucm, {0.5, 0.25}}, 1, 2, 4, {2, 4, -0.25}},
    {{LensModel::eucm, {0, 0.25}}, 1, 2, 4, {2, 4, 1}},
    {{LensModel::double_sphere, {0, 1}}, 5, 3, 0, {3, 0, 4}},
    {{LensModel::double_sphere, {0.5, 0}}, 1, 2, 0, {1, 0, 0}},
    {{LensModel::omni, {0}}, 3, 1, 2, {1, 2, 3}},
    {{LensModel::omni, {0.5}}, 1, 2, 0, {1, 0, 0}},
    {{LensModel::omni, {1}}, 1, 1, 2, {1, 2, -2}},
    {{LensModel::omni, {0, 0.125}}, 1, 1.625, 3.25, {1, 2, 1}},
    {{LensModel::omni, {1, 0.125}}, 1, 1.625, 3.25, {1, 2, -2}},
    {{LensModel::omni, {0.5, 0.0625, 0, 0.015625}}, 1, 2.5, 0.0625, {1, 0, 0}},
};

TEST(RationalRoots, TiesAreExact) {
  const Dyadic tiny = Dyadic(1.0).scaled(-3000);
  for (const auto& [lens, f, u, v, d] : rational_rays) {
    SCOPED_TRACE(std::string(name_of(lens.model)) + ' ' + std::to_string(u));
    Projection camera;
    camera.fx = camera.fy = f;
    const Preimages preimages(camera, lens);
    const auto ray = preimages.of(u, v);
    ASSERT_TRUE(ray.has_value());
    const ExactVector3 exact{d[0], d[1], d[2]};
    const ExactVector3 others[] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    for (const ExactVector3& other : others) {
      const ExactVector3 plane = cross(exact, other);
      EXPECT_EQ(ray->sign_of(plane), Sign::zero);
      EXPECT_EQ(ray->sign_of(square_of(plane)), Sign::zero);
      const Dyadic along = dot(other, exact);
      const ExactVector3 beside{plane[0] + tiny * other[0], plane[1] + tiny * other[1],
                                plane[2] + tiny * other[2]};
      EXPECT_EQ(ray->sign_of(beside), along.sign());
      EXPECT_EQ(ray->sign_of(other), along.sign());
      // other² = along²/|d|²
      QuadraticForm cone = dot(exact, exact) * square_of(other);
      cone -= (along * along) * squared_length();
      EXPECT_EQ(ray->sign_of(cone), Sign::zero);
      cone -= tiny * squared_length();
      EXPECT_EQ(ray->sign_of(cone), Sign::negative);
    }
  }
}

TEST(Root, EndWhereTheRootIsZero) {
  const auto sees = [](const Lens& lens, double r) {
    return Preimages({}, lens).of(r, 0.0).has_value() &&
           Preimages({}, lens).of(0.0, -r).has_value();
  };
  struct End {
    Lens lens;
    double r;
  };
  for (const auto& [lens, r] : {End{{LensModel::fisheye_orthographic}, 1},
                                {{LensModel::fisheye_equisolid}, 2},
                                {{LensModel::ucm, {1}}, 1},
                                {{LensModel::eucm, {0.625, 4}}, 1},
                                {{LensModel::eucm, {1, 0.0625}}, 4},
                                {{LensModel::double_sphere, {0.5, 0.625}}, 2},
                                {{LensModel::omni, {1.25}}, 4.0 / 3}}) {
    SCOPED_TRACE(name_of(lens.model));
    EXPECT_TRUE(sees(lens, r * (1 - 0x1p-52)));
    EXPECT_FALSE(sees(lens, r * (1 + 0x1p-52)));
    if (lens.model != LensModel::omni) {
      EXPECT_FALSE(sees(lens, r));
    }
  }
  for (const Lens& endless :
       {Lens{LensModel::ucm, {0.5}}, Lens{LensModel::eucm, {0.25, 7}},
        Lens{LensModel::double_sphere, {-0.5, 0.25}}, Lens{LensModel::omni, {1}}})
    EXPECT_TRUE(sees(endless, 1e300));
}

// The sine of 1 radian, 2·sin(½), … are the radii at which rays have this angle.
TEST(Root, EndAtMaxRadius) {
  struct End {
    Lens lens;
    double r;
  };
  const double angle = 1, sine = std::sin(1.0), cosine = std::cos(1.0);
  for (End end : {End{{LensModel::fisheye_orthographic}, sine},
                  {{LensModel::fisheye_equisolid}, 2 * std::sin(0.5)},
                  {{LensModel::ucm, {0.25}}, sine / (0.25 + 0.75 * cosine)},
                  {{LensModel::eucm, {0, 2}}, std::tan(1.0)},
                  {{LensModel::omni, {2}}, sine / (2 + cosine)}}) {
    SCOPED_TRACE(name_of(end.lens.model));
    end.lens.max_radius = angle;
    EXPECT_TRUE(Preimages({}, end.lens).of(end.r * (1 - 1e-15), 0.0).has_value());
    EXPECT_FALSE(Preimages({}, end.lens).of(end.r * (1 + 1e-15), 0.0).has_value());
    EXPECT_TRUE(Preimages({}, end.lens).of(0.0, 0.0).has_value());
    const auto radius = RootProfile(*root_formula(end.lens)).radius_at(angle, 100);
    ASSERT_TRUE(radius.has_value());
    EXPECT_NEAR(*radius, end.r, 1e-14);
  }
}

TEST(Root, SeeTheirAxisExactly) {
  for (const Lens& lens : {Lens{LensModel::fisheye_orthographic},
                           {LensModel::fisheye_equisolid},
                           {LensModel::ucm, {1}},
                           {LensModel::eucm, {0.7, 1e-300}},
                           {LensModel::double_sphere, {-0.75, 1}},
                           {LensModel::omni, {1e300}}}) {
    const auto d = Preimages({}, lens).of(0.0, 0.0);
    ASSERT_TRUE(d.has_value() && d->rational() != nullptr);
    EXPECT_EQ(d->sign_of(ExactVector3{1.0, 1.0, 0.0}), Sign::zero);
    EXPECT_EQ(d->sign_of(ExactVector3{0.0, 0.0, 1.0}), Sign::positive);
  }
}

TEST(Root, OfAUnifiedModelWithoutAlphaAreTheRaysOfThePinhole) {
  std::mt19937_64 random(3);
  const Projection camera = oracle::random_camera(random);
  const Preimages pinhole(camera, Lens()), unified(camera, Lens{LensModel::eucm, {0, 5}});
  const auto a = pinhole.of(10.5, 20.5), b = unified.of(10.5, 20.5);
  ASSERT_TRUE(a && b && b->rational() != nullptr);
  EXPECT_TRUE(*a->rational() == *b->rational());
}

// K⁻¹ overflows in binary64, and (x_d, y_d) may be as small as 1e-300.
TEST(Root, HaveFocalLengthsNearTheEndOfBinary64) {
  for (const double f : {0x1p1000, -0x1p1000, 0x1p-1000, 0x1.fffffffffffffp1023}) {
    Projection camera;
    camera.fx = camera.fy = f;
    for (const Lens& lens : {Lens{LensModel::fisheye_orthographic},
                             {LensModel::fisheye_equisolid},
                             {LensModel::eucm, {0.75, 1e-300}},
                             {LensModel::double_sphere, {-0.5, 0.625}},
                             {LensModel::omni, {1.25}}}) {
      const Preimages preimages(camera, lens);
      const Dyadic u = Dyadic(f).scaled(-2), v = Dyadic(f).scaled(-1);  // (¼, ½)
      const auto d = preimages.of(u, v);
      ASSERT_TRUE(d.has_value()) << f;
      expect_encloses_multiple(*d, direction_of(lens, {0.25, 0.5}));
      const auto near_axis = preimages.of(Dyadic(f).scaled(-1000), Dyadic(f).scaled(-999));
      ASSERT_TRUE(near_axis.has_value()) << f;
      EXPECT_EQ(near_axis->sign_of(ExactVector3{2.0, -1.0, 0.0}), Sign::zero);
      EXPECT_EQ(near_axis->sign_of(ExactVector3{1.0, 0.0, 0.0}), Sign::positive);
    }
  }
}

}  // namespace
}  // namespace fathom::lens
