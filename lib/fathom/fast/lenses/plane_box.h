#pragma once

#include <algorithm>
#include <cmath>

namespace fathom::fast {

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
