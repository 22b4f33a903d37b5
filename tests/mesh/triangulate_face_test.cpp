#include "fathom/mesh/triangulate_face.h"

#include <gmock/gmock.h>
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace fathom {
namespace {

using namespace mesh;
using testing::ElementsAre;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;
using Ring = std::vector<MeshPoint>;

/// The rule of the specification, section 3, once more: rational numbers, every step from scratch,
/// nothing shared with what is tested.
class Oracle {
 public:
  explicit Oracle(const Ring& ring) {
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

  /// The triangles, and whether that deserves a warning.
  std::pair<Triangles, bool> run() {
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

void expect_like_oracle(const Ring& ring) {
  Triangles triangles;
  const Triangulation kind = triangulate_face(ring, triangles);
  const auto [truth, warn] = Oracle(ring).run();
  const auto shown = [&] {
    std::string text;
    for (const MeshPoint& p : ring)
      text += "{" + std::to_string(p.x) + ", " + std::to_string(p.y) + ", " + std::to_string(p.z) +
              "} ";
    return text;
  };
  ASSERT_EQ(triangles, truth) << shown();
  ASSERT_EQ(kind == Triangulation::fallback_fan, warn && ring.size() > 3) << shown();
}

/// Rings of few bits, so that straight, repeated and touching corners abound.
TEST(TriangulateFace, AgreesWithTheOracleOnRandomRings) {
  std::mt19937 random(31);
  std::array<int, 3> kinds{};
  for (int i = 0; i < 30'000; ++i) {
    const int corners = 4 + static_cast<int>(random() % 6),
              reach = 2 + static_cast<int>(random() % 5);
    const bool flat = random() % 2 == 0;
    Ring ring;
    for (int k = 0; k < corners; ++k) {
      const double x = random() % reach, y = random() % reach;
      ring.push_back({x, y, flat ? x + 2 * y : static_cast<double>(random() % reach)});
    }
    ASSERT_NO_FATAL_FAILURE(expect_like_oracle(ring));
    Triangles triangles;
    ++kinds[static_cast<int>(triangulate_face(ring, triangles))];
  }
  for (const int count : kinds) EXPECT_GT(count, 500);
}

/// A star-shaped ring is simple: angles ascend. Some corners are repeated, some lie on edges.
Ring star(std::mt19937& random, int corners) {
  Ring ring;
  for (int k = 0; k < corners; ++k) {
    const double angle = 6.283185307179586 * k / corners,
                 radius = 1 + static_cast<double>(random() % 64);
    ring.push_back(
        {std::round(16 * radius * std::cos(angle)), std::round(16 * radius * std::sin(angle)), 7});
    if (random() % 5 == 0) ring.push_back(ring.back());
  }
  return ring;
}

TEST(TriangulateFace, AgreesWithTheOracleOnConcaveRings) {
  std::mt19937 random(32);
  for (int i = 0; i < 2000; ++i) {
    Ring ring = star(random, 5 + static_cast<int>(random() % 20));
    if (i % 2 == 0) std::reverse(ring.begin(), ring.end());
    if (i % 3 == 0)
      for (MeshPoint& p : ring) p = {p.z, p.x, p.y};
    ASSERT_NO_FATAL_FAILURE(expect_like_oracle(ring));
  }
}

/// Signed areas add up exactly whatever the ring; triangles of a simple one all turn its way.
TEST(TriangulateFace, KeepsTheArea) {
  std::mt19937 random(33);
  for (int i = 0; i < 200; ++i) {
    const Ring ring = star(random, 40);
    Triangles triangles;
    const Triangulation kind = triangulate_face(ring, triangles);
    ASSERT_EQ(triangles.size(), ring.size() - 2);
    double ring_area = 0, sum = 0;  // whole numbers below 2⁵³: exact
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const MeshPoint &a = ring[k], &b = ring[(k + 1) % ring.size()];
      ring_area += a.x * b.y - a.y * b.x;
    }
    for (const auto& t : triangles) {
      const MeshPoint &a = ring[t[0]], &b = ring[t[1]], &c = ring[t[2]];
      const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
      ASSERT_TRUE(kind != Triangulation::ear_clipping || area >= 0);
      sum += area;
    }
    ASSERT_EQ(sum, ring_area);
  }
}

TEST(TriangulateFace, ProjectsAlongTheFirstOfEqualAxes) {
  EXPECT_EQ(projection_axis(Ring{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), 0);
  EXPECT_EQ(projection_axis(Ring{{0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0, 1, 1}}), 1);
  EXPECT_EQ(projection_axis(Ring{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.5}, {0, 1, 0.5}}), 2);
  EXPECT_EQ(projection_axis(Ring{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}), -1);
  // One nextafter decides.
  const double more = std::nextafter(1.0, 2.0);
  EXPECT_EQ(projection_axis(Ring{{0, 0, 0}, {1, 0, 0}, {1, more, 1}, {0, more, 1}}), 2);
  // Beyond the range of binary64 products.
  EXPECT_EQ(projection_axis(Ring{{1e300, 0, 0}, {0, 1e300, 0}, {0, 0, 1e300}}), 0);
  EXPECT_EQ(projection_axis(Ring{{0, 0, 0}, {5e-324, 0, 0}, {0, 5e-324, 0}}), 2);
  EXPECT_EQ(projection_axis(Ring{{-1e308, -1e308, 1}, {1e308, -1e308, 1}, {1e308, 1e308, 1}}), 2);
}

TEST(TriangulateFace, KnownShapes) {
  Triangles t;
  // A pentagram turns one way and winds twice: no convex ring, not simple.
  EXPECT_EQ(triangulate_face(Ring{{0, 3, 0}, {-2, -3, 0}, {3, 1, 0}, {-3, 1, 0}, {2, -3, 0}}, t),
            Triangulation::fallback_fan);
  // A square with a corner in the middle of a side and one doubled.
  t.clear();
  EXPECT_EQ(
      triangulate_face(Ring{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {2, 2, 0}, {0, 2, 0}}, t),
      Triangulation::convex_fan);
  // A spike out and back.
  t.clear();
  EXPECT_EQ(triangulate_face(Ring{{0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {2, 0, 0}, {0, 2, 0}}, t),
            Triangulation::fallback_fan);
  // An arrowhead: only corners 1 and 3 are ears.
  t.clear();
  EXPECT_EQ(triangulate_face(Ring{{0, 0, 0}, {3, -2, 0}, {1, 0, 0}, {3, 2, 0}}, t),
            Triangulation::ear_clipping);
  EXPECT_THAT(
      t, ElementsAre(std::array<std::uint32_t, 3>{0, 1, 2}, std::array<std::uint32_t, 3>{0, 2, 3}));
  t.clear();
  EXPECT_EQ(triangulate_face(Ring{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, t),
            Triangulation::fallback_fan);
  EXPECT_EQ(t.size(), 2U);
}

}  // namespace
}  // namespace fathom
