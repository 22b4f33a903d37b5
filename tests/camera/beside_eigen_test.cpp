// Cameras that are made or imported are rounded once; Eigen's decompositions, quaternions and
// inverses in binary64 round several times. That is why they are not used there
// (docs/conventions.md).
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <bit>
#include <cmath>
#include <iostream>
#include <random>
#include <sstream>
#include <string>

#include "fathom/camera/camera_import_internal.h"
#include "fathom/camera/camera_making.h"
#include "fathom/eigen_conversions.h"
#include "fathom/numeric/certified.h"

namespace fathom {
namespace {

constexpr int cameras = 1000;

double uniform(std::mt19937_64& random, double from, double to) {
  return from + (to - from) * std::ldexp(static_cast<double>(random() >> 11), -53);
}

Eigen::Vector3d any_vector(std::mt19937_64& random, double size) {
  return {uniform(random, -size, size), uniform(random, -size, size), uniform(random, -size, size)};
}

/// Whether no number of binary64 is nearer to numerator / denominator; the denominator is positive.
bool is_nearest(double x, const Dyadic& numerator, const Dyadic& denominator) {
  const auto middle = [&](double other) { return (Dyadic(x) + Dyadic(other)).scaled(-1); };
  const double infinity = std::numeric_limits<double>::infinity();
  return compare(middle(std::nextafter(x, -infinity)) * denominator, numerator) <= 0 &&
         compare(numerator, middle(std::nextafter(x, infinity)) * denominator) <= 0;
}

/// The same of v / √squared_length.
bool is_nearest_unit(double x, const Dyadic& v, const Dyadic& squared_length) {
  const auto middle = [&](double to) {
    return (Dyadic(std::abs(x)) + Dyadic(std::nextafter(std::abs(x), to))).scaled(-1);
  };
  const Dyadic low = middle(-1), high = middle(2), square = v * v;
  return (v.is_zero() || (x < 0) == (v.sign() == Sign::negative)) &&
         (low.sign() == Sign::negative || compare(low * low * squared_length, square) <= 0) &&
         compare(square, high * high * squared_length) <= 0;
}

/// Entries of all cameras that are not the nearest numbers.
struct Misses {
  int ours = 0, eigens = 0, entries = 0;

  void count(bool our_nearest, bool eigens_nearest) {
    ++entries;
    ours += our_nearest ? 0 : 1;
    eigens += eigens_nearest ? 0 : 1;
  }
  void expect(const char* what) const {
    std::cout << what << ": of " << entries << " entries, not the nearest number: " << ours
              << " of ours, " << eigens << " of Eigen's\n";
    EXPECT_EQ(ours, 0);
    EXPECT_GT(eigens, entries / 20) << "where Eigen rounds as well, use it";
  }
};

class Bytes {
 public:
  template <class T>
  Bytes& operator<<(T value) {
    const auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
    text.append(bytes.begin(), bytes.end());
    return *this;
  }
  std::string text;
};

Camera by_colmap(const Eigen::Quaterniond& q, const Eigen::Vector3d& t) {
  Bytes camera, image;
  camera << std::uint64_t{1} << std::uint32_t{1} << std::uint32_t{1} << std::uint64_t{640}
         << std::uint64_t{480} << 500.0 << 500.0 << 320.0 << 240.0;
  image << std::uint64_t{1} << std::uint32_t{1} << q.w() << q.x() << q.y() << q.z();
  image << t.x() << t.y() << t.z() << std::uint32_t{1} << 'a' << '\0' << std::uint64_t{0};
  std::istringstream c(camera.text), i(image.text);
  return camera::parse_colmap_binary({c, "cameras.bin"}, {i, "images.bin"}).at(0).camera;
}

TEST(BesideEigen, RotationsOfQuaternions) {
  std::mt19937_64 random(321);
  Misses misses;
  for (int n = 0; n < cameras; ++n) {
    const Eigen::Quaterniond q(uniform(random, -1, 1), uniform(random, -1, 1),
                               uniform(random, -1, 1), uniform(random, -1, 1));
    const Camera ours = by_colmap(q, {1, 2, 3});
    const Eigen::Matrix3d eigens = q.normalized().toRotationMatrix();
    // Rodrigues' rotation of each axis e: (w² − v·v)·e + 2(v·e)·v + 2w·v × e, over the square.
    const Dyadic w = q.w(), square = Dyadic(q.w()) * w;
    const ExactVector3 v{q.x(), q.y(), q.z()};
    const Dyadic vv = dot(v, v);
    for (int k = 0; k < 3; ++k) {
      ExactVector3 e;
      e[k] = 1.0;
      const ExactVector3 turned = cross(v, e);
      for (int i = 0; i < 3; ++i) {
        const Dyadic exact = (square - vv) * e[i] + (v[k] * v[i] + w * turned[i]).scaled(1);
        misses.count(is_nearest(ours.world_to_camera[i][k], exact, square + vv),
                     is_nearest(eigens(i, k), exact, square + vv));
      }
    }
  }
  misses.expect("quaternions");
}

/// Whether an entry of [A⁻¹ | −A⁻¹·b] is the nearest number, by Cramer's rule.
class ExactInverse {
 public:
  explicit ExactInverse(const Eigen::Matrix<double, 3, 4>& pose) : pose_(pose) {
    const auto& [a, b, c] = columns_of(pose_);
    det_ = determinant(a, b, c);
  }

  [[nodiscard]] bool is_nearest_at(Eigen::Index i, Eigen::Index k, double x) const {
    // Column k of the inverse solves A·y = e_k, or A·y = −b.
    ExactVector3 right;
    if (k < 3) right[static_cast<std::size_t>(k)] = 1.0;
    for (Eigen::Index r = 0; r < 3 && k == 3; ++r)
      right[static_cast<std::size_t>(r)] = -Dyadic(pose_(r, 3));
    auto columns = columns_of(pose_);
    columns[static_cast<std::size_t>(i)] = right;
    const Dyadic numerator = determinant(columns[0], columns[1], columns[2]);
    return det_.sign() == Sign::negative ? is_nearest(x, -numerator, -det_)
                                         : is_nearest(x, numerator, det_);
  }

 private:
  static std::array<ExactVector3, 3> columns_of(const Eigen::Matrix<double, 3, 4>& pose) {
    std::array<ExactVector3, 3> columns;
    for (Eigen::Index k = 0; k < 3; ++k)
      for (Eigen::Index i = 0; i < 3; ++i)
        columns[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)] = pose(i, k);
    return columns;
  }

  Eigen::Matrix<double, 3, 4> pose_;
  Dyadic det_;
};

/// A pose that is turned and stretched a little.
Eigen::Affine3d any_pose(std::mt19937_64& random) {
  Eigen::Affine3d pose(Eigen::Quaterniond(uniform(random, -1, 1), uniform(random, -1, 1),
                                          uniform(random, -1, 1), uniform(random, -1, 1))
                           .normalized());
  for (Eigen::Index i = 0; i < 3; ++i) pose(i, 0) += uniform(random, -0.1, 0.1);
  pose.translation() = any_vector(random, 5);
  return pose;
}

TEST(BesideEigen, InversesOfPoses) {
  std::mt19937_64 random(322);
  Misses misses;
  for (int n = 0; n < cameras; ++n) {
    const Eigen::Affine3d pose = any_pose(random);
    Camera camera;
    set_camera_from_world(camera, pose);
    const Eigen::Affine3d ours = world_from_camera(camera), eigens = pose.inverse();
    const ExactInverse exact(pose.affine());
    for (Eigen::Index i = 0; i < 3; ++i)
      for (Eigen::Index k = 0; k < 4; ++k)
        misses.count(exact.is_nearest_at(i, k, ours(i, k)),
                     exact.is_nearest_at(i, k, eigens(i, k)));
  }
  misses.expect("inverses");
}

std::string text_of(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}

TEST(BesideEigen, NerfsCameras) {
  std::mt19937_64 random(323);
  Misses misses;
  for (int n = 0; n < cameras / 5; ++n) {
    const Eigen::Affine3d M = any_pose(random);
    std::string rows;
    for (Eigen::Index i = 0; i < 3; ++i)
      rows += "[" + text_of(M(i, 0)) + "," + text_of(M(i, 1)) + "," + text_of(M(i, 2)) + "," +
              text_of(M(i, 3)) + "],";
    Warnings warnings;
    const Camera ours = camera::parse_nerf(R"({"fl_x": 500, "frames": [{"transform_matrix": [)" +
                                               rows + "[0,0,0,1]]}]}",
                                           "transforms.json", 640, 480, warnings)
                            .at(0)
                            .camera;
    const Eigen::DiagonalMatrix<double, 3> turned(1, -1, -1);
    const Eigen::Matrix<double, 3, 4> eigens = turned * M.inverse().affine();
    const ExactInverse exact(M.affine());
    for (Eigen::Index i = 0; i < 3; ++i)
      for (Eigen::Index k = 0; k < 4; ++k) {
        const double sign = i == 0 ? 1 : -1;
        const double our =
            ours.world_to_camera[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)];
        misses.count(exact.is_nearest_at(i, k, sign * our),
                     exact.is_nearest_at(i, k, sign * eigens(i, k)));
      }
  }
  misses.expect("NeRF");
}

TEST(BesideEigen, LookingAtAPoint) {
  std::mt19937_64 random(324);
  Misses misses;
  for (int n = 0; n < cameras; ++n) {
    const Eigen::Vector3d eye = any_vector(random, 5), target = any_vector(random, 5),
                          up = any_vector(random, 1);
    const Camera ours = look_at(to_array(eye), to_array(target), to_array(up));
    const Eigen::Vector3d forward = (target - eye).normalized();
    const Eigen::Vector3d right = forward.cross(up).normalized();
    Eigen::Matrix3d eigens;
    eigens << right.transpose(), forward.cross(right).transpose(), forward.transpose();
    ExactVector3 f, u;
    for (int k = 0; k < 3; ++k) {
      f[k] = Dyadic(target[k]) - Dyadic(eye[k]);
      u[k] = up[k];
    }
    const ExactVector3 r = cross(f, u);
    const std::array<ExactVector3, 3> rows{r, cross(f, r), f};
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) {
        const Dyadic square = dot(rows[i], rows[i]);
        misses.count(is_nearest_unit(ours.world_to_camera[i][k], rows[i][k], square),
                     is_nearest_unit(eigens(i, k), rows[i][k], square));
      }
  }
  misses.expect("look-at");
}

}  // namespace
}  // namespace fathom
