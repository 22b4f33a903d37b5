#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "tests/inputs/scene_building.h"

/// Scenes in which many surfaces lie in one pixel, seen by an orthographic camera of 1×1 pixel that
/// leaves x, y and z as u, v and D. Cutting the pixel in halves does not separate them.
namespace fathom::checks {

class CrowdBuilder {
 public:
  void add(const MeshPoint& a, const MeshPoint& b, const MeshPoint& c) {
    const auto first = static_cast<std::uint32_t>(vertices_.size());
    vertices_.insert(vertices_.end(), {a, b, c});
    triangles_.push_back({first, first + 1, first + 2});
  }
  [[nodiscard]] Scene scene() const { return scene_of(vertices_, triangles_); }

 private:
  std::vector<MeshPoint> vertices_;
  std::vector<CornerIndices> triangles_;
};

/// The same triangle again and again, every third time the other way round.
inline Scene equal_triangles(int count) {
  CrowdBuilder crowd;
  const MeshPoint a{0.1, 0.2, 1}, b{0.9, 0.3, 1.5}, c{0.4, 1.2, 2};
  for (int i = 0; i < count; ++i) i % 3 == 2 ? crowd.add(a, c, b) : crowd.add(b, c, a);
  return crowd.scene();
}

/// Discs of `sides` triangles around (0.375, 0.5), one behind the other, the farthest first.
inline Scene coins(int count, int sides) {
  CrowdBuilder crowd;
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 + count - i;
    const auto rim = [&](int k) {
      const double turn = 6.283185307179586 * k / sides;
      return MeshPoint{0.375 + 0.3 * std::cos(turn), 0.5 + 0.3 * std::sin(turn), z};
    };
    for (int k = 0; k < sides; ++k) crowd.add({0.375, 0.5, z}, rim(k), rim((k + 1) % sides));
  }
  return crowd.scene();
}

/// Triangles around (0.375, 0.5) that grow with their depth: nothing is hidden wholly.
inline Scene rings(int count) {
  CrowdBuilder crowd;
  for (int i = 0; i < count; ++i) {
    const double r = 0.01 * (i + 1), z = 1 + 0.5 * i;
    crowd.add({0.375 - r, 0.5 - r, z}, {0.375 + r, 0.5 - r, z}, {0.375, 0.5 + r, z});
  }
  return crowd.scene();
}

/// A fan around a point of the pixel, whose triangles overlap the next ones.
inline Scene fan(int count) {
  CrowdBuilder crowd;
  for (int i = 0; i < count; ++i) {
    const double from = 6.283185307179586 * i / count, to = from + 9.0 / count;
    crowd.add({0.375, 0.5, 2},
              {0.375 + 3 * std::cos(from), 0.5 + 3 * std::sin(from), 2 + 0.25 * (i % 3)},
              {0.375 + 3 * std::cos(to), 0.5 + 3 * std::sin(to), 2 + 0.5 * (i % 2)});
  }
  return crowd.scene();
}

/// Sheets of one plane, each divided in another way along the lines of one grid.
inline Scene facades(int count) {
  CrowdBuilder crowd;
  std::mt19937_64 random(8);
  for (int i = 0; i < count; ++i) {
    const auto place = [&] { return static_cast<double>(random() % 9) / 8; };
    double left = place(), right = place(), top = place(), bottom = place();
    if (left == right) right += 0.125;
    if (top == bottom) bottom += 0.125;
    crowd.add({left, top, 2}, {right, top, 2}, {left, bottom, 2});
    crowd.add({right, top, 2}, {right, bottom, 2}, {left, bottom, 2});
  }
  return crowd.scene();
}

/// Triangles in one plane with corners on a grid: common corners, collinear edges, ties.
inline Scene heap(int count) {
  CrowdBuilder crowd;
  std::mt19937_64 random(60);
  const auto point = [&] {
    const double x = static_cast<double>(random() % 17) / 8 - 0.5,
                 y = static_cast<double>(random() % 17) / 8 - 0.5;
    return MeshPoint{x, y, 3 + x / 4 - y / 2};
  };
  for (int i = 0; i < count; ++i) {
    const MeshPoint a = point(), b = point(), c = point();
    crowd.add(a, b, c);
  }
  return crowd.scene();
}

/// Planes that cover the whole pixel and pass through each other in it.
inline Scene crossing_planes(int count) {
  CrowdBuilder crowd;
  for (int i = 0; i < count; ++i) {
    const double slope = 6.283185307179586 * i / count;
    const double a = std::cos(slope), b = std::sin(slope);
    const auto at = [&](double x, double y) {
      return MeshPoint{x, y, 20 + a * (x - 0.375) + b * (y - 0.5) + 0.01 * (i % 4)};
    };
    crowd.add(at(-9, -9), at(19, -8), at(-8, 19));
  }
  return crowd.scene();
}

struct Crowd {
  std::string name;
  Scene scene;
};

/// Each of a dozen triangles, or `scale` times as many.
inline std::vector<Crowd> crowds(int scale = 1) {
  return {{"equal triangles", equal_triangles(12 * scale)},
          {"coins", coins(3 * scale, 6)},
          {"rings", rings(12 * scale)},
          {"fan", fan(12 * scale)},
          {"facades", facades(7 * scale)},
          {"heap", heap(12 * scale)},
          {"crossing planes", crossing_planes(10 * scale)}};
}

}  // namespace fathom::checks
