#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace fathom::fast {

/// A frame at the eye whose axes are axes of the camera frame, some of them turned round: x right,
/// y down, z forward. It is a rotation of the camera frame, so that orientations stay as they are.
struct ViewAxes {
  struct Axis {
    std::size_t of_camera;
    double sign;

    [[nodiscard]] constexpr double of(const std::array<double, 3>& d) const {
      return sign * d[of_camera];
    }
    friend constexpr bool operator==(const Axis&, const Axis&) = default;
  };
  Axis right, down, forward;

  [[nodiscard]] constexpr bool is_of_camera() const {
    return right.of_camera == 0 && down.of_camera == 1 && right.sign > 0 && down.sign > 0;
  }
  [[nodiscard]] constexpr std::array<Axis, 3> all() const { return {right, down, forward}; }
  friend constexpr bool operator==(const ViewAxes&, const ViewAxes&) = default;
};

/// The camera frame, and a frame for each other direction along an axis. Each direction has one
/// that looks along its greatest component.
inline constexpr std::array<ViewAxes, 6> all_views{{
    {{0, 1}, {1, 1}, {2, 1}},
    {{2, -1}, {1, 1}, {0, 1}},
    {{0, -1}, {1, 1}, {2, -1}},
    {{2, 1}, {1, 1}, {0, -1}},
    {{0, 1}, {2, -1}, {1, 1}},
    {{0, 1}, {2, 1}, {1, -1}},
}};

/// The determinant of the rows of a view.
constexpr double determinant_of(const ViewAxes& view) {
  std::array<std::array<double, 3>, 3> m{};
  for (std::size_t row = 0; row < 3; ++row)
    m[row][view.all()[row].of_camera] = view.all()[row].sign;
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}
static_assert([] {
  for (const ViewAxes& view : all_views)
    if (determinant_of(view) != 1) return false;
  return true;
}());

/// A rectangle of the plane z = 1 of a frame at the eye; empty at first.
struct PlaneBox {
  double left = 1, right = -1, top = 1, bottom = -1;

  [[nodiscard]] bool is_empty() const { return !(left <= right); }
  /// Of its greatest coordinate.
  [[nodiscard]] double size() const {
    return std::max({std::abs(left), std::abs(right), std::abs(top), std::abs(bottom)});
  }
  void add(const PlaneBox& other) {
    if (other.is_empty()) return;
    if (is_empty()) {
      *this = other;
      return;
    }
    left = std::min(left, other.left);
    right = std::max(right, other.right);
    top = std::min(top, other.top);
    bottom = std::max(bottom, other.bottom);
  }
};

}  // namespace fathom::fast
