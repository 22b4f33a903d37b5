#pragma once

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "tests/inputs/hard_faces.h"

namespace fathom::checks {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// The rule of the specification, section 3, once more: rational numbers, every step from scratch,
/// nothing shared with what is tested.
class FaceOracle {
 public:
  explicit FaceOracle(const Ring& ring) {
    mpq_class normal[3];
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const MeshPoint &a = ring[k], &b = ring[(k + 1) % ring.size()];
      const mpq_class p[3] = {a.x, a.y, a.z}, q[3] = {b.x, b.y, b.z};
      for (int i = 0; i < 3; ++i)
        normal[i] += p[(i + 1) % 3] * q[(i + 2) % 3] - p[(i + 2) % 3] * q[(i + 1) % 3];
    }
    int axis = 0;
    for (int i = 1; i < 3; ++i)
      if (abs(normal[i]) > abs(normal[axis])) axis = i;
    way_ = sgn(normal[axis]);
    for (const MeshPoint& p : ring) {
      const mpq_class c[3] = {p.x, p.y, p.z};
      points_.push_back({c[(axis + 1) % 3], c[(axis + 2) % 3]});
    }
  }

  /// Which way the ring turns in all: the sign of its area in the projection.
  [[nodiscard]] int way() const { return way_; }
  /// The same of a triangle.
  [[nodiscard]] int turn_of(const std::array<std::uint32_t, 3>& t) const {
    return turn(t[0], t[1], t[2]);
  }
  /// The triangles, and whether that deserves a warning.
  [[nodiscard]] std::pair<Triangles, bool> run() const {
    std::vector<std::uint32_t> rest(points_.size());
    std::iota(rest.begin(), rest.end(), 0U);
    Triangles result;
    bool warn = false;
    if (way_ != 0 && !is_convex() && is_simple()) {
      bool found = true;
      while (rest.size() > 3 && found) {
        found = false;
        for (std::size_t k = 0; k < rest.size() && !found; ++k) {
          if (!is_ear(rest, k)) continue;
          result.push_back({at(rest, k, -1), rest[k], at(rest, k, 1)});
          rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(k));
          found = true;
        }
      }
      warn = !found || turn(rest[0], rest[1], rest[2]) != way_;
    } else {
      warn = way_ == 0 || !is_convex();
    }
    for (std::size_t k = 1; k + 1 < rest.size(); ++k)
      result.push_back({rest[0], rest[k], rest[k + 1]});
    return {result, warn};
  }

 private:
  using Point = std::array<mpq_class, 2>;

  static std::uint32_t at(const std::vector<std::uint32_t>& ring, std::size_t k, int step) {
    return ring[(k + ring.size() + static_cast<std::size_t>(step + 1) - 1) % ring.size()];
  }
  static int turn(const Point& a, const Point& b, const Point& c) {
    return sgn((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
  }
  [[nodiscard]] int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return turn(points_[a], points_[b], points_[c]);
  }
  [[nodiscard]] std::vector<Point> curve() const {
    std::vector<Point> result;
    for (std::size_t k = 0; k < points_.size(); ++k)
      if (points_[k] != points_[(k + points_.size() - 1) % points_.size()])
        result.push_back(points_[k]);
    return result;
  }
  /// Convex: every corner lies on the inner side of every edge's line, and along each line the way
  /// goes forward only; a ring that winds twice fails the first, a spike the second.
  [[nodiscard]] bool is_convex() const {
    const std::vector<Point> c = curve();
    const std::size_t n = c.size();
    if (n < 3) return false;
    for (std::size_t k = 0; k < n; ++k) {
      const Point &a = c[k], &b = c[(k + 1) % n], &next = c[(k + 2) % n];
      for (const Point& p : c)
        if (turn(a, b, p) == -way_) return false;
      const mpq_class forward = (b[0] - a[0]) * (next[0] - b[0]) + (b[1] - a[1]) * (next[1] - b[1]);
      if (turn(a, b, next) == 0 && forward < 0) return false;
    }
    // Twice round the same ring passes both tests above.
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = i + 1; k < n; ++k)
        if (c[i] == c[k]) return false;
    return true;
  }
  static bool on_segment(const Point& p, const Point& a, const Point& b) {
    return turn(a, b, p) == 0 && (p[0] - a[0]) * (p[0] - b[0]) <= 0 &&
           (p[1] - a[1]) * (p[1] - b[1]) <= 0;
  }
  /// No corner lies on an edge that is not its own, and no two edges cross.
  [[nodiscard]] bool is_simple() const {
    const std::vector<Point> c = curve();
    const std::size_t n = c.size();
    if (n < 3) return false;
    for (std::size_t k = 0; k < n; ++k) {
      const Point &a = c[k], &b = c[(k + 1) % n];
      for (std::size_t i = 0; i < n; ++i)
        if (i != k && i != (k + 1) % n && on_segment(c[i], a, b)) return false;
      for (std::size_t i = 0; i < n; ++i)
        if (turn(a, b, c[i]) * turn(a, b, c[(i + 1) % n]) < 0 &&
            turn(c[i], c[(i + 1) % n], a) * turn(c[i], c[(i + 1) % n], b) < 0)
          return false;
    }
    return true;
  }
  [[nodiscard]] bool is_ear(const std::vector<std::uint32_t>& rest, std::size_t k) const {
    const std::uint32_t a = at(rest, k, -1), b = rest[k], c = at(rest, k, 1);
    if (turn(a, b, c) != way_) return false;
    for (const std::uint32_t i : rest) {
      const Point& p = points_[i];
      if (p == points_[a] || p == points_[b] || p == points_[c]) continue;
      if (turn(a, b, i) != -way_ && turn(b, c, i) != -way_ && turn(c, a, i) != -way_) return false;
    }
    return true;
  }

  std::vector<Point> points_;
  int way_ = 0;
};

}  // namespace fathom::checks
