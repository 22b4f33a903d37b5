// The bounds behind the fast engine's channels from both sides: never violated against exact
// values, and not looser than a stated factor. In binary64 and in double-words, with and without
// fused multiply-add.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fathom/numeric/rounding.h"
#include "fathom/triangle/double_word_surface.h"
#include "fathom/triangle/projected_triangle.h"
#include "tests/effort.h"
#include "tests/exact/scene_building.h"

namespace fathom {
namespace {

Dyadic exactly(double x) {
  return x;
}
Dyadic exactly(const WordPair& x) {
  return Dyadic(x.hi) + Dyadic(x.lo);
}

/// Collects |computed − exact| / bound: none may exceed 1, the greatest says how tight it is.
class Share {
 public:
  void add(const Dyadic& computed, const Ratio& exact, const Dyadic& bound) {
    if (bound.is_zero()) {
      EXPECT_EQ(compare(Ratio(computed), exact), 0);
      return;
    }
    const Ratio error = Ratio(computed) - exact;
    const double share = std::abs(round_to_binary64(error * Ratio(1.0, bound)));
    EXPECT_LE(share, 1);
    greatest_ = std::max(greatest_, share);
    ++count_;
  }
  template <class Real>
  void add(const Certified<Real>& x, const Ratio& exact) {
    if (std::isfinite(x.error)) add(exactly(x.value), exact, x.error);
  }
  [[nodiscard]] double greatest() const { return greatest_; }
  [[nodiscard]] int count() const { return count_; }

 private:
  double greatest_ = 0;
  int count_ = 0;
};

/// √x with a relative error below 2⁻³⁰⁰, nothing beside the bounds it is compared with.
Ratio root(const Ratio& x) {
  if (x.sign() == Sign::zero) return {};
  mpz_t n;
  mpz_init(n);
  // √(n·2^e/d) = √(n·d·2^(e mod 2 + 2k))/(d·2^k)·2^⌊e/2⌋
  mpz_mul(n, x.numerator.significand(), x.denominator.significand());
  const long e = x.numerator.exponent() - x.denominator.exponent();
  const long odd = ((e % 2) + 2) % 2;
  mpz_mul_2exp(n, n, static_cast<mp_bitcnt_t>(odd) + 2 * 700);
  mpz_sqrt(n, n);
  Dyadic numerator, denominator;  // through 53-bit pieces, the only way into a Dyadic
  const auto from = [](mpz_srcptr z) {
    Dyadic sum;
    mpz_t rest;
    mpz_init_set(rest, z);
    while (mpz_sgn(rest) != 0) {
      long power = 0;
      const double piece = mpz_get_d_2exp(&power, rest);  // towards zero
      const Dyadic part = Dyadic(piece).scaled(power);
      sum += part;
      mpz_t taken;
      mpz_init_set(taken, part.significand());
      if (part.exponent() >= 0) {
        mpz_mul_2exp(taken, taken, static_cast<mp_bitcnt_t>(part.exponent()));
      } else {
        mpz_tdiv_q_2exp(taken, taken, static_cast<mp_bitcnt_t>(-part.exponent()));
      }
      mpz_sub(rest, rest, taken);
      mpz_clear(taken);
    }
    mpz_clear(rest);
    return sum;
  };
  numerator = from(n).scaled((e - odd) / 2 - 700);
  denominator = from(x.denominator.significand());
  mpz_clear(n);
  return {numerator, denominator};
}

class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : random_(seed) {}
  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  /// Uniform in (−1, 1), all 53 bits used.
  double unit() { return std::ldexp(static_cast<double>(random_() >> 11), -52) - 1; }
  /// Double-words: full ones, some of one word, some near a power of two.
  WordPair word_pair() {
    const double hi = below(4) == 0 ? 1 + std::ldexp(below(5) - 2, -52) : unit();
    const double lo = below(8) == 0 ? 0 : unit() * hi * 0x1p-53 * std::ldexp(1, -below(3) * 9);
    return two_sum(std::ldexp(hi, below(9) - 4), lo);
  }

 private:
  std::mt19937_64 random_;
};

template <bool fused>
void expect_operations_within_their_bounds() {
  using Real = DoubleWord<fused>;
  const double u2 = 0x1p-106;
  Numbers n(31);
  Share sum, product, scaled, quotient, square_root_share;
  const auto relative = [&](Share& share, const WordPair& computed, const Ratio& exact,
                            double factor) {
    const Ratio size = exact.sign() == Sign::negative ? Ratio() - exact : exact;
    // bound = factor·u²·|exact|: both sides times the denominator, to have a dyadic bound
    share.add(exactly(computed) * size.denominator, exact * Ratio(size.denominator),
              Dyadic(factor * u2) * size.numerator);
  };
  for (int i = 0; i < 40000 / testing::effort; ++i) {
    Real x = n.word_pair(), y = n.word_pair();
    if (n.below(3) == 0) y = Real(-x.hi, x.lo * n.unit());  // cancels
    const Dyadic X = exactly(WordPair(x)), Y = exactly(WordPair(y));
    if (X.is_zero() || Y.is_zero()) continue;
    relative(sum, x + y, Ratio(X + Y), 3.01);
    relative(product, x * y, Ratio(X * Y), 7);
    relative(scaled, x * y.hi, Ratio(X * Dyadic(y.hi)), 2);
    relative(quotient, x / y, Ratio(X, Y), 15.01);
    if (X.sign() == Sign::positive) {
      relative(square_root_share, square_root(x), root(Ratio(X)), 8);
    }
  }
  EXPECT_GT(square_root_share.count(), 5000 / testing::effort);
  if (testing::effort > 1) return;  // too few cases to come near the bounds
  EXPECT_GT(sum.greatest(), 0.3);
  EXPECT_GT(product.greatest(), 0.3);
  EXPECT_GT(scaled.greatest(), 0.5);
  EXPECT_GT(quotient.greatest(), 0.2);
  EXPECT_GT(square_root_share.greatest(), 0.3);
}

TEST(DoubleWord, OperationsStayWithinTheirBoundsWithFma) {
  expect_operations_within_their_bounds<true>();
}
TEST(DoubleWord, OperationsStayWithinTheirBoundsWithoutFma) {
  expect_operations_within_their_bounds<false>();
}

TEST(DoubleWord, SumsAndProductsOfTwoNumbersAreExact) {
  Numbers n(32);
  for (int i = 0; i < 20000 / testing::effort; ++i) {
    const double a = std::ldexp(n.unit(), n.below(201) - 100);
    const double b = std::ldexp(n.unit(), n.below(201) - 100);
    EXPECT_EQ(exactly(two_sum(a, b)), Dyadic(a) + Dyadic(b));
    EXPECT_EQ(exactly(two_product<true>(a, b)), Dyadic(a) * Dyadic(b));
    EXPECT_EQ(exactly(two_product<false>(a, b)), Dyadic(a) * Dyadic(b));
  }
}

/// Where a rounding comes out, both ends of the interval round to it exactly; and it comes out
/// where an interval twice as wide would still be settled.
template <class Rounded, class Round>
void expect_rounding(const std::optional<Rounded>& ours, const Dyadic& x, double error,
                     const Round& round, int& settled, int& open) {
  const auto ends_agree = [&](double factor) {
    const auto low = round(x - Dyadic(factor * error)), high = round(x + Dyadic(factor * error));
    return low == high;
  };
  if (ours) {
    ++settled;
    EXPECT_TRUE(ends_agree(1));
    EXPECT_EQ(static_cast<decltype(round(x))>(*ours), round(x));
  } else {
    ++open;
    EXPECT_FALSE(ends_agree(2)) << std::hexfloat << round_to_binary64(Ratio(x)) << " " << error;
  }
}

/// Double-words are not asked to settle a number whose leading word is itself in the middle: errors
/// here are so large that the leading words differ.
TEST(CertifiedRounding, IsRightAndHardlyEverDeclinesWithoutNeed) {
  Numbers n(33);
  const auto to_float = [](const Dyadic& x) { return round_to_binary32(Ratio(x)); };
  const auto to_double = [](const Dyadic& x) { return round_to_binary64(Ratio(x)); };
  const auto to_integer = [](const Dyadic& x) {
    return round_to_integer(Ratio(x), 1 << 20).value_or(0);
  };
  int settled[4]{}, open[4]{};
  for (int i = 0; i < 20000 / testing::effort; ++i) {
    const double sign = n.below(2) ? 1 : -1;
    // Near the middle between two binary32 numbers in (1, 2).
    const double base = static_cast<float>(1.5 + 0.4 * n.unit());
    const double error = std::ldexp(1, -26 - n.below(20));
    const double x = sign * (base + half_gap(static_cast<float>(base)) + error * 3 * n.unit());
    const WordPair pair{x, x * n.unit() * 0x1p-54};
    expect_rounding(to_binary32(x, error), x, error, to_float, settled[0], open[0]);
    expect_rounding(to_binary32(pair, error), exactly(pair), error, to_float, settled[1], open[1]);
    // Near the middle between two binary64 numbers.
    const double full = sign * (1.5 + 0.4 * n.unit());
    const double fine = std::ldexp(1, -56 - n.below(40));
    const WordPair y = two_sum(full, half_gap(full) * (n.below(2) ? 1 : -1) + fine * 3 * n.unit());
    expect_rounding(to_binary64(y, fine), exactly(y), fine, to_double, settled[2], open[2]);
    // Near the middle between two codes.
    const double middle = n.below(65534) + 1.5;
    const double coarse = std::ldexp(1, -2 - n.below(30));
    const WordPair z{middle + coarse * 3 * n.unit(), 0};
    if (z.hi < 0.5 || z.hi > 65535) continue;
    expect_rounding(to_code(z, coarse), exactly(z), coarse, to_integer, settled[3], open[3]);
    // As near as binary64 can say: it may decline, but must not be wrong.
    const double nearest_error = 0x1p-53 * (1 + n.unit());
    const double w = base + half_gap(static_cast<float>(base)) + 0x1p-52 * (n.below(7) - 3);
    if (const auto rounded = to_binary32(w, nearest_error)) {
      EXPECT_EQ(*rounded, to_float(Dyadic(w) - Dyadic(nearest_error)));
      EXPECT_EQ(*rounded, to_float(Dyadic(w) + Dyadic(nearest_error)));
    }
  }
  for (int k = 0; k < 4; ++k) {
    EXPECT_GT(settled[k], 1000 / testing::effort) << k;
    EXPECT_GT(open[k], 1000 / testing::effort) << k;
  }
}

TEST(CertifiedRounding, ExactNumbersZeroesAndTies) {
  EXPECT_EQ(std::signbit(*to_binary32(0.0, 0.0)), false);
  EXPECT_EQ(to_binary32(0.0, 1e-300), std::nullopt);
  EXPECT_EQ(std::signbit(*to_binary32(-1e-300, 1e-310)), true);  // underflows to −0
  EXPECT_EQ(*to_binary32(1e300, 1e200), std::numeric_limits<float>::infinity());
  EXPECT_EQ(to_binary32(1.0, std::numeric_limits<double>::infinity()), std::nullopt);
  EXPECT_EQ(to_binary32(1.0, std::nan("")), std::nullopt);
  EXPECT_EQ(to_binary32(WordPair{1, 0}, std::nan("")), std::nullopt);
  EXPECT_EQ(to_binary64(WordPair{1, 0}, std::nan("")), std::nullopt);
  EXPECT_EQ(to_code(WordPair{1, 0}, std::nan("")), std::nullopt);
  EXPECT_EQ(to_binary32(WordPair{1 + 0x1p-24, 0}, 0x1p-1000), std::nullopt);  // a tie
  EXPECT_EQ(to_binary32(WordPair{1 + 0x1p-24, 0}, 0.0), 1.0F);                // known to be one
  EXPECT_EQ(to_binary64(WordPair{1, 0x1p-53}, 0.0), std::nullopt);
  EXPECT_EQ(to_binary32(WordPair{1 + 0x1p-23, -0x1p-77}, 0x1p-77), 1 + 0x1p-23F);
  EXPECT_EQ(to_code(WordPair{2.5, 0}, 0.0), 2);  // to even
  EXPECT_EQ(to_code(WordPair{3.5, 0}, 0.0), 4);
  EXPECT_EQ(to_code(WordPair{3.5, 0}, 1e-30), std::nullopt);
  EXPECT_EQ(to_code(WordPair{3.5 - 0x1p-47, 0x1p-60}, 0x1p-60), 3);
  EXPECT_EQ(to_code(WordPair{0.5, 0}, 0.0), std::nullopt);  // 0 is no surface
  EXPECT_EQ(to_code(WordPair{std::nextafter(65535.5, 0), 0}, 0x1p-40), 65535);
  EXPECT_EQ(to_code(WordPair{65535.5, 0}, 0.0), std::nullopt);
  // 2^j − ½ less a last bit: adding ½ would round up.
  EXPECT_EQ(to_code(WordPair{std::nextafter(1023.5, 0), 0}, 0.0), 1023);
}

Camera camera_from(Numbers& n, bool perspective) {
  Camera c = testing::camera_of(200, 150, 0);
  c.projection = perspective ? Projection::perspective : Projection::orthographic;
  do {
    const double size = perspective ? 140 : 60;
    c.fx = (n.below(2) ? 1 : -1) * size * (1 + n.unit() / 2);
    c.fy = (n.below(2) ? 1 : -1) * size * (1 + n.unit() / 2);
    c.skew = n.below(2) ? n.unit() * 20 : 0;
    c.cx = 100 + n.unit();
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        c.world_to_camera[i][k] = (i == k) + n.unit() * (n.below(2) ? 0.3 : 0);
      }
      c.world_to_camera[i][3] = n.unit() * 0.3 + (i == 2 ? 3 : 0);
    }
  } while (find_fault(c));
  return c;
}

Object object_from(Numbers& n) {
  Object object;
  if (n.below(2)) return object;
  object.placed_as_is = false;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      object.world_from_mesh.rows[i][k] = Dyadic((i == k) + 0.2 * n.unit());
    }
  }
  return object;
}

/// Triangles of all sizes, some thin, some of few bits.
MeshTriangle corners_from(Numbers& n) {
  MeshTriangle t;
  for (MeshPoint& X : t) X = {n.unit(), n.unit(), n.unit()};
  if (n.below(3) == 0) {
    const double s = std::ldexp(1, -n.below(14)), k = n.unit();
    t[2] = {t[0].x + k * (t[1].x - t[0].x) + s * n.unit(),
            t[0].y + k * (t[1].y - t[0].y) + s * n.unit(), t[2].z};
  }
  if (n.below(3) == 0) {
    for (MeshPoint& X : t) X = {std::round(X.x * 8) / 8, std::round(X.y * 8) / 8, X.z};
  }
  return t;
}

/// A triangle seen at a sample that it covers.
struct Seen {
  MeshTriangle corners;
  const ObjectRays& object;
  const SceneRays& rays;
  ImageBounds image;
  ImagePoint s;
};

struct Binary64 {
  using Real = double;
  static DepthForms<double> forms(const Seen& x) {
    return depth_forms<double>(x.corners, x.object.rays, x.image);
  }
  static Certified<double> depth(const Seen& x) {
    return depth_forms<double>(x.corners, x.object.rays, x.image).at(x.s, x.image.perspective);
  }
  static Certified<double> distance(const Seen& x) {
    return product(depth(x), ray_length<double>(x.rays, x.s));
  }
  static auto position(const Seen& x) {
    const Rays& world = x.rays.world().rays;
    return fathom::position(world, RaySizes(world, x.image), x.image.perspective, x.s, depth(x));
  }
  static auto weights(const Seen& x) {
    const auto forms = weight_forms<double>(x.corners, x.object.rays, x.image);
    return std::array{forms.at(0, x.s), forms.at(1, x.s)};
  }
  static auto normal(const Seen& x) {
    return unit_normal<double>(x.corners, x.object, x.rays.world(), x.image, x.s);
  }
};

template <const WideArithmetic& wide>
struct Wide {
  using Real = DoubleWord<false>;
  static DepthForms<Real> forms(const Seen& x) {
    const auto f = wide.depth_forms(x.corners, x.object.rays, x.image);
    return {{f.varying.a, f.varying.b, f.varying.c, f.varying.error},
            {f.constant.value, f.constant.error}};
  }
  static Certified<WordPair> depth(const Seen& x) {
    return wide.depth(wide.depth_forms(x.corners, x.object.rays, x.image), x.s,
                      x.image.perspective);
  }
  static auto distance(const Seen& x) { return wide.distance(depth(x), x.rays, x.s); }
  static auto position(const Seen& x) {
    const Rays& world = x.rays.world().rays;
    return wide.position(world, RaySizes(world, x.image), x.image.perspective, x.s, depth(x));
  }
  static auto weights(const Seen& x) {
    return wide.weights(x.corners, x.object.rays, x.image, x.s);
  }
  static auto normal(const Seen& x) {
    return wide.normal(x.corners, x.object, x.rays.world(), x.image, x.s);
  }
};

struct Shares {
  Share varying, constant, edges, depth, distance, position, weights, normal;
};

/// The parts of depth and weights, before quotients and differences cover their errors: n·d is
/// Σe/det H, n·t is Δ/det H, d·(r × t) and d·(t × p) are e_B/det H and e_C/det H.
template <class Arithmetic>
void add_shares_of_parts(const Seen& x, const ProjectedTriangle& t, Shares& shares) {
  using Real = typename Arithmetic::Real;
  std::array<ExactVector3, 3> H;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) H[i][k] = x.object.image_rows[i].coefficients[k];
  }
  Dyadic det = determinant(H[0], H[1], H[2]);
  if (t.orientation == Sign::negative) det = -det;
  const auto over_det = [&](const ImageForm& form) { return Ratio(form.at(x.s.u, x.s.v), det); };
  const DepthForms<Real> forms = Arithmetic::forms(x);
  const auto& [varying, constant] = x.image.perspective ? std::pair{t.weight, t.depth_numerator}
                                                        : std::pair{t.depth_numerator, t.weight};
  shares.varying.add(forms.varying.at(x.s), over_det(varying));
  shares.constant.add(forms.constant, over_det(constant));
  const WeightForms<Real> weights = weight_forms<Real>(x.corners, x.object.rays, x.image);
  shares.varying.add(weights.divisor.at(x.s), over_det(t.weight));
  shares.edges.add(weights.weights[0].at(x.s), over_det(t.edges[1]));
  shares.edges.add(weights.weights[1].at(x.s), over_det(t.edges[2]));
}

template <class Arithmetic>
void add_shares(const Seen& x, const ProjectedTriangle& t, Sign handedness, Shares& shares) {
  const ImagePoint s{x.s.u, x.s.v};
  add_shares_of_parts<Arithmetic>(x, t, shares);
  shares.depth.add(Arithmetic::depth(x), depth_at(t, s));
  const auto weights = Arithmetic::weights(x);
  shares.weights.add(weights[0], interpolate(t, s, {0.0, 1.0, 0.0}));
  shares.weights.add(weights[1], interpolate(t, s, {0.0, 0.0, 1.0}));
  const auto& [A, B, C] = t.world;
  const auto position = Arithmetic::position(x);
  shares.position.add(position[0], interpolate(t, s, {A.x, B.x, C.x}));
  shares.position.add(position[1], interpolate(t, s, {A.y, B.y, C.y}));
  shares.position.add(position[2], interpolate(t, s, {A.z, B.z, C.z}));
  if (x.image.perspective) {
    const auto& [a, b, c] = t.camera;
    const Ratio X = interpolate(t, s, {a.x, b.x, c.x}), Y = interpolate(t, s, {a.y, b.y, c.y});
    const Ratio Z = depth_at(t, s);
    shares.distance.add(Arithmetic::distance(x), root(X * X + Y * Y + Z * Z));
  }
  const ExactVector3 n = cross(ExactVector3{B.x - A.x, B.y - A.y, B.z - A.z},
                               ExactVector3{C.x - A.x, C.y - A.y, C.z - A.z});
  const auto normal = Arithmetic::normal(x);
  for (std::size_t i = 0; i < 3; ++i) {
    const Ratio size = root(Ratio(n[i] * n[i], dot(n, n)));
    const bool negative = n[i].sign() * -t.orientation * handedness == Sign::negative;
    shares.normal.add(normal[i], negative ? Ratio() - size : size);
  }
}

template <class Arithmetic>
Shares shares_of(bool perspective, std::uint64_t seed) {
  Numbers n(seed);
  Shares shares;
  for (int i = 0; i < 120 / testing::effort + 10; ++i) {
    const Camera camera = camera_from(n, perspective);
    Scene scene = testing::scene_of({}, {});
    scene.objects[0] = object_from(n);
    const SceneRays rays(scene, camera);
    const ObjectRays& object = rays.object(0);
    EXPECT_TRUE(object.usable && rays.world().usable);
    const Sign handedness =
        Dyadic(camera.fx * camera.fy).sign() * determinant_of_rotation(camera).sign();
    for (int k = 0; k < 12; ++k) {
      const MeshTriangle corners = corners_from(n);
      Mesh mesh;
      mesh.vertices.assign(corners.begin(), corners.end());
      mesh.triangles = {{0, 1, 2}};
      TierCounts counts;
      const ProjectedTriangle t =
          project(world_corners(scene.objects[0], mesh, 0), 0, camera, counts);
      for (int j = 0; j < 12; ++j) {
        const ImagePoint s{n.below(200) + 0.5, n.below(150) + 0.5};
        const ImagePoint point{s.u, s.v};
        if (!covers(t, point, counts) || depth_at(t, point).sign() != Sign::positive) continue;
        add_shares<Arithmetic>({corners, object, rays, {perspective, 200, 150}, s}, t, handedness,
                               shares);
      }
    }
  }
  EXPECT_GT(shares.depth.count(), 300 / testing::effort);
  return shares;
}

/// No error exceeds its bound; the greatest reaches these shares of it.
struct Tightness {
  double varying, constant, edges, depth, distance, position, weights, normal;
};

void expect_tight(const Shares& shares, const Tightness& least, bool perspective) {
  if (testing::effort > 1) return;
  EXPECT_GT(shares.varying.greatest(), least.varying);
  EXPECT_GT(shares.constant.greatest(), least.constant);
  EXPECT_GT(shares.edges.greatest(), least.edges);
  EXPECT_GT(shares.depth.greatest(), least.depth);
  if (perspective) {
    EXPECT_GT(shares.distance.greatest(), least.distance);
  }
  EXPECT_GT(shares.position.greatest(), least.position);
  EXPECT_GT(shares.weights.greatest(), least.weights);
  EXPECT_GT(shares.normal.greatest(), least.normal);
}

/// ε is 16u², while an operation mostly errs by less than u²: the bounds are loose by design here,
/// eight bits of the forty that are to spare.
constexpr Tightness double_words{0.0018, 0.004, 0.002, 0.002, 0.001, 0.0015, 0.0018, 0.006};

class ChannelBounds : public ::testing::TestWithParam<bool> {};

TEST_P(ChannelBounds, HoldInBinary64) {
  const Tightness least{0.06, 0.12, 0.035, 0.04, 0.03, 0.03, 0.03, 0.08};
  expect_tight(shares_of<Binary64>(GetParam(), 41), least, GetParam());
}
TEST_P(ChannelBounds, HoldInDoubleWordsWithFma) {
  expect_tight(shares_of<Wide<wide_with_fma>>(GetParam(), 42), double_words, GetParam());
}
TEST_P(ChannelBounds, HoldInDoubleWordsWithoutFma) {
  expect_tight(shares_of<Wide<wide_without_fma>>(GetParam(), 43), double_words, GetParam());
}

INSTANTIATE_TEST_SUITE_P(Fast, ChannelBounds, ::testing::Bool());

}  // namespace
}  // namespace fathom
