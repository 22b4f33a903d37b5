// Numbers of cameras that follow from angles: the exact ones rounded once, judged by MPFR with 700
// bits.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mpfr.h>

#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>

#include "fathom/camera/camera_import_internal.h"
#include "fathom/camera/camera_making.h"
#include "fathom/failures/errors.h"
#include "tests/camera/seen_points.h"

namespace fathom {
namespace {

using namespace camera;
using ::testing::HasSubstr;

/// A number of 700 bits: what it loses in a few operations is beyond any binary64 rounding that is
/// drawn here.
class Wide {
 public:
  Wide(double x = 0) {
    mpfr_init2(value_, 700);
    mpfr_set_d(value_, x, MPFR_RNDN);
  }
  Wide(const Wide& other) : Wide() { mpfr_set(value_, other.value_, MPFR_RNDN); }
  Wide& operator=(const Wide& other) {
    mpfr_set(value_, other.value_, MPFR_RNDN);
    return *this;
  }
  ~Wide() { mpfr_clear(value_); }

  static Wide radians_of(double degrees) {
    Wide result;
    mpfr_const_pi(result.value_, MPFR_RNDN);
    mpfr_mul_d(result.value_, result.value_, degrees, MPFR_RNDN);
    mpfr_div_ui(result.value_, result.value_, 180, MPFR_RNDN);
    return result;
  }
  template <class Function>
  [[nodiscard]] Wide through(Function function) const {
    Wide result;
    function(result.value_, value_, MPFR_RNDN);
    return result;
  }
  friend Wide operator*(const Wide& a, const Wide& b) {
    Wide result;
    mpfr_mul(result.value_, a.value_, b.value_, MPFR_RNDN);
    return result;
  }
  friend Wide operator/(const Wide& a, const Wide& b) {
    Wide result;
    mpfr_div(result.value_, a.value_, b.value_, MPFR_RNDN);
    return result;
  }
  [[nodiscard]] double rounded() const { return mpfr_get_d(value_, MPFR_RNDN); }

 private:
  mpfr_t value_;
};

double focal_length(std::uint32_t size, const Wide& radians) {
  return (Wide(size / 2.0) / (radians / Wide(2)).through(mpfr_tan)).rounded();
}

class Angles {
 public:
  /// As people write them, any binary64 number, and numbers near the ends of the range.
  double below(double most) {
    switch (random_() % 4) {
      case 0:
        return std::nextafter(most, 0) *
               (1 - std::ldexp(share_(random_), -static_cast<int>(random_() % 60)));
      case 1:
        return std::ldexp(1 + share_(random_), -static_cast<int>(random_() % 1074));
      case 2:
        return std::max(0.01, std::round(most * 100 * share_(random_)) / 100 - 0.01);
      default:
        return std::max(std::numeric_limits<double>::min(), most * share_(random_));
    }
  }
  std::uint32_t size() { return static_cast<std::uint32_t>(1 + random_() % 8192); }
  double share() { return share_(random_); }

 private:
  std::mt19937_64 random_{17};
  std::uniform_real_distribution<double> share_{0, 1};
};

TEST(MadeNumbers, FocalLengthsOfAFieldOfViewAreRoundedOnce) {
  Angles draw;
  int off_in_binary64 = 0;
  for (int i = 0; i < 20000; ++i) {
    LensChoice lens{.height = draw.size(), .vertical_fov = draw.below(180)};
    if (!(lens.vertical_fov > 0 && lens.vertical_fov < 180)) continue;
    const double exact = focal_length(lens.height, Wide::radians_of(lens.vertical_fov));
    if (std::isinf(exact)) {
      EXPECT_THROW(look_at({0, 0, 1}, {}, {0, 1, 0}, lens), UsageError);
      continue;
    }
    const Camera camera = look_at({0, 0, 1}, {}, {0, 1, 0}, lens);
    ASSERT_EQ(camera.projection.fx, exact)
        << std::hexfloat << lens.vertical_fov << " of " << lens.height;
    ASSERT_EQ(camera.projection.fy, exact);
    off_in_binary64 +=
        lens.height / 2.0 / std::tan(lens.vertical_fov * (std::numbers::pi / 360)) != exact;
  }
  // The formula in binary64 is another camera in a good part of the cases.
  EXPECT_GT(off_in_binary64, 2000);
  LensChoice right_angle{.height = 721, .vertical_fov = 90};
  EXPECT_EQ(look_at({0, 0, 1}, {}, {0, 1, 0}, right_angle).projection.fx, 360.5);
}

TEST(MadeNumbers, FocalLengthsOfImportedAnglesAreRoundedOnce) {
  Angles draw;
  for (int i = 0; i < 3000; ++i) {
    const std::uint32_t width = draw.size(), height = draw.size();
    const double radians = std::min(3.14, std::max(1e-3, draw.below(std::numbers::pi)));
    const double degrees = std::min(179.9, std::max(1e-3, draw.below(180)));
    const std::string frames =
        R"("frames": [{"transform_matrix": [[1,0,0,0],[0,1,0,0],[0,0,1,0]]}]})";
    Warnings warnings;
    const auto nerf = parse_nerf(R"({"camera_angle_x": )" + test::text_of(radians) +
                                     R"(, "y_fov": )" + test::text_of(degrees) + ", " + frames,
                                 "t.json", width, height, warnings);
    ASSERT_EQ(nerf.at(0).camera.projection.fx, focal_length(width, Wide(radians)));
    ASSERT_EQ(nerf.at(0).camera.projection.fy, focal_length(height, Wide::radians_of(degrees)));
    const auto gltf = parse_gltf_cameras(
        R"({"cameras": [{"type": "perspective", "perspective": {"yfov": )" +
            test::text_of(radians) + R"(, "znear": 1}}], "nodes": [{"camera": 0}]})",
        "a.gltf", width, height);
    ASSERT_EQ(gltf.at(0).camera.projection.fx, focal_length(height, Wide(radians)));
  }
}

TEST(MadeNumbers, ViewsHaveSinesCosinesAndTheirProductsRoundedOnce) {
  Angles draw;
  int off_in_binary64 = 0;
  for (int i = 0; i < 5000; ++i) {
    const double azimuth = i % 3 == 0 ? 15.0 * (i % 96) - 720 : 1440 * draw.share() - 720;
    const double elevation = i % 4 == 0 ? 15.0 * (i % 13) - 90 : 180 * draw.share() - 90;
    const Camera camera = look_from({azimuth, elevation, {0, 1, 0}}, {}, 1);
    const auto sine = [](double degrees) {
      const double whole = std::remainder(degrees, 360);
      if (std::remainder(whole, 180) == 0) return Wide(0);
      return Wide::radians_of(whole).through(mpfr_sin);
    };
    const auto cosine = [](double degrees) {
      const double whole = std::remainder(degrees, 360);
      if (std::abs(whole) == 90) return Wide(0);
      return Wide::radians_of(whole).through(mpfr_cos);
    };
    const Wide sa = sine(azimuth), ca = cosine(azimuth), se = sine(elevation),
               ce = cosine(elevation);
    const std::array<std::array<double, 3>, 3> exact{
        {{ca.rounded(), 0, -sa.rounded()},
         {(se * sa).rounded(), -ce.rounded(), (se * ca).rounded()},
         {-(ce * sa).rounded(), -se.rounded(), -(ce * ca).rounded()}}};
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t k = 0; k < 3; ++k)
        ASSERT_EQ(camera.world_to_camera[r][k], exact[r][k])
            << azimuth << ", " << elevation << ": " << r << ", " << k;
    const double degree = std::numbers::pi / 180;
    off_in_binary64 += std::cos(elevation * degree) * std::sin(azimuth * degree) != -exact[2][0];
  }
  EXPECT_GT(off_in_binary64, 500);
}

TEST(MadeNumbers, StepsOfAnOrbitAreRoundedOnce) {
  // 360·i/7 and the sum would be rounded one after the other in binary64.
  constexpr std::uint32_t count = 7;
  const auto path = orbit({0.1, 20, {0, 1, 0}}, count, Vector3{}, 5);
  bool differs = false;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double azimuth = round_to_binary64(Ratio(0.1) + Ratio(Dyadic(360.0 * i), Dyadic(count)));
    EXPECT_EQ(path[i].world_to_camera, look_from({azimuth, 20, {0, 1, 0}}, {}, 5).world_to_camera);
    differs = differs || azimuth != 0.1 + 360.0 * i / count;
  }
  EXPECT_TRUE(differs);
  EXPECT_THROW(orbit({NAN, 20, {0, 1, 0}}, 3, Vector3{}, 5), UsageError);
}

/// q·v·q* of a quaternion w, x, y, z, over the square of its length, by Hamilton's product; exact.
std::array<Ratio, 3> turned_exactly(const std::array<double, 4>& q,
                                    const std::array<double, 3>& v) {
  using Q = std::array<Dyadic, 4>;
  const auto times = [](const Q& a, const Q& b) {
    return Q{a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
             a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
             a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
             a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
  };
  const Q exact{q[0], q[1], q[2], q[3]}, conjugate{q[0], -q[1], -q[2], -q[3]};
  const Q r = times(times(exact, {0.0, v[0], v[1], v[2]}), conjugate);
  const Dyadic n = times(exact, conjugate)[0];
  return {Ratio(r[1], n), Ratio(r[2], n), Ratio(r[3], n)};
}

// The matrix of the quaternion would be rounded, and its inverse again.
TEST(MadeNumbers, PosesOfTumAreRoundedOnce) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> any(-1, 1), far(-9, 9);
  for (int i = 0; i < 2000; ++i) {
    const std::array<double, 4> q{any(random), any(random), any(random), any(random)};
    const std::array<double, 3> eye{far(random), far(random), far(random)};
    std::string line = "1";
    for (const double x : {eye[0], eye[1], eye[2], q[1], q[2], q[3], q[0]})
      line += " " + test::text_of(x);
    const Camera camera = parse_tum({line, "g.txt"}, std::nullopt, *tum_lens("ros")).at(0).camera;
    const std::array<double, 4> back{q[0], -q[1], -q[2], -q[3]};
    const auto t = turned_exactly(back, eye);
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t k = 0; k < 3; ++k) {
        std::array<double, 3> axis{};
        axis[k] = 1;
        ASSERT_EQ(camera.world_to_camera[r][k], round_to_binary64(turned_exactly(back, axis)[r]));
      }
      ASSERT_EQ(camera.world_to_camera[r][3], -round_to_binary64(t[r]));
    }
  }
}

TEST(MadeNumbers, PrincipalPointsAreRoundedOnce) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> any(-2000, 2000), centre(-3, 3);
  for (int i = 0; i < 5000; ++i) {
    Camera camera;
    camera.projection.cx = any(random);
    camera.projection.cy = any(random);
    camera.projection.pixel_centre = i % 3 == 0 ? 0 : i % 3 == 1 ? 0.5 : centre(random);
    const auto [x, y] = principal_point(camera.projection);
    const auto exact = [&](double c) {
      return round_to_binary64(
          Ratio(Dyadic(c) + (Dyadic(0.5) - Dyadic(camera.projection.pixel_centre))));
    };
    ASSERT_EQ(x, exact(camera.projection.cx));
    ASSERT_EQ(y, exact(camera.projection.cy));
  }
}

}  // namespace
}  // namespace fathom
