// Signs of forms at directions: against the oracle, at ties made on purpose, and just beside them.
#include "fathom/lens/exact_direction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "fathom/lens/preimages.h"
#include "fathom/lens/stage.h"
#include "tests/effort.h"
#include "tests/lens/lens_oracle.h"

namespace fathom::lens {
namespace {

using oracle::ArbBall;
using Point = oracle::OraclePoint<ArbBall>;

ArbBall value_of(const ExactVector3& l, const Point& m) {
  return ArbBall(l[0]) * m.x + ArbBall(l[1]) * m.y + ArbBall(l[2]);
}

ArbBall value_of(const QuadraticForm& form, const Point& m) {
  const auto& [xx, yy, zz, xy, xz, yz] = form.coefficients;
  return ArbBall(xx) * m.x * m.x + ArbBall(yy) * m.y * m.y + ArbBall(zz) + ArbBall(xy) * m.x * m.y +
         ArbBall(xz) * m.x + ArbBall(yz) * m.y;
}

int number_of(Sign sign) {
  return static_cast<int>(sign);
}

class Signs : public ::testing::TestWithParam<LensModel> {};
INSTANTIATE_TEST_SUITE_P(Lenses, Signs, ::testing::ValuesIn(oracle::stage_models),
                         [](const auto& model) { return std::string(name_of(model.param)); });

/// Planes and cones through about the direction, off by 2^−offset of their size.
void expect_signs_of_oracle(const ExactDirection& d, const Point& m, int offset,
                            std::mt19937_64& random) {
  const auto small = [&random] { return Dyadic(static_cast<double>(random() % 2001) - 1000); };
  const Dyadic a = small(), b = small(), c = small();
  const Dyadic shift = small().scaled(-offset);
  const Dyadic z = value_of(ExactVector3{a, b, 0.0}, m).rounded(offset);
  const ExactVector3 plane{a, b, shift - z};
  EXPECT_EQ(number_of(d.sign_of(plane)), value_of(plane, m).sign()) << offset;
  const Dyadic w = value_of(QuadraticForm{{a, b, 0.0, c, a, c}}, m).rounded(offset);
  const QuadraticForm cone{{a, b, shift - w, c, a, c}};
  EXPECT_EQ(number_of(d.sign_of(cone)), value_of(cone, m).sign()) << offset;
}

ArbBall ball_of(const Certified<WordPair>& x) {
  return ArbBall(x.value.hi) + ArbBall(x.value.lo);
}

// (X, Y, Z) with its bounds contains a multiple of (m, 1): |X − m_x·Z| ≤ E_x + |m_x|·E_z.
TEST_P(Signs, DirectionsInDoubleWordsContainTheOracles) {
  int rays = 0, found = 0;
  std::mt19937_64 random;
  Lens lens;
  Projection camera;
  std::optional<Preimages> preimages;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    if (seed % 10 == 0) {
      random.seed(seed / 10 + 900);
      lens = oracle::random_lens(random, GetParam(), 0.1);
      camera = oracle::random_camera(random);
      preimages.emplace(camera, lens);
    }
    random.seed(seed);
    const double u = static_cast<double>(random() % 1280) + 0.5;
    const double v = static_cast<double>(random() % 720) + 0.5;
    const auto d = preimages->of(u, v);
    if (!d) continue;
    const auto m = oracle::preimage(camera, oracle::NamedParameters(lens), u, v, preimages->disc());
    ASSERT_TRUE(m.has_value());
    ++rays;
    const auto words = d->words();
    if (!words) continue;
    ++found;
    const auto& [X, Y, Z] = *words;
    const auto expect_contained = [&](const Certified<WordPair>& of_words, const ArbBall& exact) {
      const ArbBall size = exact.sign() < 0 ? ArbBall(0.0) - exact : exact;
      const ArbBall error = ball_of(of_words) - exact * ball_of(Z);
      const ArbBall bound = ArbBall(of_words.error) + size * ArbBall(Z.error);
      EXPECT_GT((bound * bound - error * error).sign(), 0);
      EXPECT_LT(of_words.error, 0x1p-70 * (std::abs(of_words.value.hi) + Z.value.hi));
    };
    expect_contained(X, m->x);
    expect_contained(Y, m->y);
    EXPECT_LT(Z.error, 0x1p-70 * Z.value.hi);
  }
  EXPECT_GT(rays, 10);
  EXPECT_GE(found, rays * 9 / 10);
}

TEST_P(Signs, AreThoseOfTheOracle) {
  for (std::uint64_t seed = 0; seed < 16 / checks::effort + 1; ++seed) {
    std::mt19937_64 random(seed);
    const Lens lens = oracle::random_lens(random, GetParam(), seed % 2 == 0 ? 0.1 : 0.4);
    const Projection camera = oracle::random_camera(random);
    const Preimages preimages(camera, lens);
    const auto d = preimages.of(300.5, 200.25);
    if (!d) continue;
    const auto m =
        oracle::preimage(camera, oracle::NamedParameters(lens), 300.5, 200.25, preimages.disc());
    ASSERT_TRUE(m.has_value());
    for (const int offset : {4, 40, 100, 250, 380}) expect_signs_of_oracle(*d, *m, offset, random);
  }
}

/// A lens whose numbers have few bits, and a point m with few bits: where D(|m|²) is a power of
/// two, the image of m has few bits, too.
struct MadeTie {
  Lens lens;
  Projection camera;
  Dyadic x, y, u, v;
};

MadeTie made_tie(LensModel model, std::mt19937_64& random) {
  const auto eighth = [&random](int n) { return static_cast<int>(random() % (2U * n + 1)) - n; };
  MadeTie tie;
  tie.lens.model = model;
  const auto names = entry_of(model).distortion;
  for (std::size_t i = 0; i < names.size(); ++i)
    tie.lens.distortion[i] = eighth(8) / (names[i][0] == 'k' ? 128.0 : 1024.0);
  const bool has_denominator = model == LensModel::full_opencv || model == LensModel::opencv_14;
  double x = eighth(40) / 64.0, y = (eighth(40) + 0.5) / 64.0;
  if (has_denominator) {  // |m|² = ½ and D = 1, or 2 by k4 = 2
    x = y = random() % 2 == 0 ? 0.5 : -0.5;
    tie.lens.distortion[5] = random() % 2 == 0 ? 0 : 2;
    tie.lens.distortion[6] = tie.lens.distortion[7] = 0;
  }
  tie.lens.distortion[12] = tie.lens.distortion[13] = 0;
  tie.camera.fx = random() % 2 == 0 ? 512 : -640;
  tie.camera.fy = 544;
  tie.camera.skew = 0.25;
  tie.camera.cx = 320.5;
  tie.x = x;
  tie.y = y;
  auto n = stage_of(tie.lens);
  const double q = x * x + y * y, D = horner(n.denominator, q);
  n.denominator = {1};
  const auto exact = n.in([](double number) { return Dyadic(number); });
  // The stage in Dyadic, which has no division: N/D first.
  const Dyadic L = horner(exact.numerator, Dyadic(q)).scaled(-std::ilogb(D));
  const Dyadic xx = tie.x * tie.x, yy = tie.y * tie.y, xy = tie.x * tie.y, r2 = xx + yy;
  const Dyadic X = tie.x * L + Dyadic(2.0) * exact.p1 * xy + exact.p2 * (r2 + Dyadic(2.0) * xx) +
                   exact.s1 * r2 + exact.s2 * r2 * r2;
  const Dyadic Y = tie.y * L + exact.p1 * (r2 + Dyadic(2.0) * yy) + Dyadic(2.0) * exact.p2 * xy +
                   exact.s3 * r2 + exact.s4 * r2 * r2;
  tie.u = Dyadic(tie.camera.fx) * X + Dyadic(tie.camera.skew) * Y + Dyadic(tie.camera.cx);
  tie.v = Dyadic(tie.camera.fy) * Y;
  return tie;
}

TEST_P(Signs, AreZeroAtTies) {
  int count = 0;
  for (std::uint64_t seed = 0; seed < 40 / checks::effort + 2; ++seed) {
    std::mt19937_64 random(seed);
    const MadeTie tie = made_tie(GetParam(), random);
    const Preimages preimages(tie.camera, tie.lens);
    const auto d = preimages.of(tie.u, tie.v);
    if (!d || tie.x * tie.x + tie.y * tie.y > Dyadic(std::min(preimages.disc(), 1e9))) continue;
    ++count;
    const Dyadic a = static_cast<double>(random() % 99) - 49, b = 7.0, e = Dyadic(1.0).scaled(-400);
    const ExactVector3 plane{a, b, -(a * tie.x + b * tie.y)};
    EXPECT_EQ(d->sign_of(plane), Sign::zero);
    EXPECT_EQ(d->sign_of(ExactVector3{plane[0], plane[1], plane[2] + e}), Sign::positive);
    EXPECT_EQ(d->sign_of(ExactVector3{plane[0], plane[1], plane[2] - e}), Sign::negative);
    const Dyadic least = Dyadic(1.0).scaled(-3000);  // below what doubled precisions see first
    EXPECT_EQ(d->sign_of(ExactVector3{plane[0], plane[1], plane[2] + least}), Sign::positive);
    const Dyadic q = tie.x * tie.x + tie.y * tie.y;
    EXPECT_EQ(d->sign_of(QuadraticForm{{1.0, 1.0, -q, 0.0, 0.0, 0.0}}), Sign::zero);
    EXPECT_EQ(d->sign_of(QuadraticForm{{1.0, 1.0, e - q, 0.0, 0.0, 0.0}}), Sign::positive);
    QuadraticForm pair = square_of(plane);
    EXPECT_EQ(d->sign_of(pair), Sign::zero);
    pair -= e * squared_length();
    EXPECT_EQ(d->sign_of(pair), Sign::negative);
  }
  EXPECT_GT(count, 0);
}

// With a radial lens m is parallel to y, so that a form is 0 at an m that is not rational.
TEST(ExactDirection, OfARadialLensIsParallelToItsSample) {
  Lens lens;
  lens.model = LensModel::radial;
  lens.distortion = {0.1, -0.03};
  const Preimages preimages({}, lens);
  const auto d = preimages.of(0.3, 0.4);
  ASSERT_TRUE(d.has_value());
  EXPECT_EQ(d->sign_of(ExactVector3{0.4, -Dyadic(0.3), 0.0}), Sign::zero);
  EXPECT_EQ(d->sign_of(ExactVector3{std::nextafter(0.4, 1), -Dyadic(0.3), 0.0}), Sign::positive);
  const Dyadic a = Dyadic(0.3) * Dyadic(0.3), b = Dyadic(0.4) * Dyadic(0.4);
  EXPECT_EQ(d->sign_of(QuadraticForm{{b, -a, 0.0, 0.0, 0.0, 0.0}}), Sign::zero);
  EXPECT_EQ(d->sign_of(ExactVector3{}), Sign::zero);
}

// The check of the design: with d = (λy, 1), a form is 0 at λ₀, and λ − λ₀ has the sign of
// r² − f(λ₀·r)², as long as λ₀·r lies in the disc.
TEST(ExactDirection, OfARadialLensFollowsItsForwardMap) {
  std::mt19937_64 random(5);
  int counts[3] = {};
  for (int i = 0; i < 300 / checks::effort; ++i) {
    const Lens lens = oracle::random_lens(random, LensModel::radial, 0.5);
    const Preimages preimages({}, lens);
    const double a = static_cast<int>(random() % 400) / 512.0, b = 0.25;
    const auto d = preimages.of(a, b);
    if (!d) continue;
    // λ₀ = 1 + j/64 has few bits; the form is (b₀, b₁, −λ₀·(b₀·a + b₁·b)).
    const Dyadic lambda = 1 + (static_cast<int>(random() % 41) - 20) / 64.0;
    const Dyadic r2 = Dyadic(a) * Dyadic(a) + Dyadic(b) * Dyadic(b), q = lambda * lambda * r2;
    if (q > Dyadic(std::min(preimages.disc(), 1e9))) continue;
    const Dyadic k1 = lens.distortion[0], k2 = lens.distortion[1];
    const Dyadic L = Dyadic(1.0) + k1 * q + k2 * q * q;
    const Sign expected = (r2 - q * L * L).sign();
    const ExactVector3 form{1.0, 2.0, -lambda * (Dyadic(a) + Dyadic(2 * b))};
    EXPECT_EQ(d->sign_of(form), expected);
    ++counts[static_cast<int>(expected) + 1];
  }
  EXPECT_GT(counts[0], 0);
  EXPECT_GT(counts[2], 0);
}

}  // namespace
}  // namespace fathom::lens
