#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "tests/inputs/scene_building.h"

namespace fathom::checks {

/// A scene of triangles that span an image of several tiles, of all sizes, with ties.
inline Scene soup(std::mt19937_64& random, int triangles, bool on_samples) {
  std::vector<MeshPoint> vertices;
  std::vector<CornerIndices> indices;
  const auto number = [&](int from, int to) {
    return static_cast<double>(from +
                               static_cast<int>(random() % static_cast<unsigned>(to - from)));
  };
  for (int t = 0; t < triangles; ++t) {
    const double span = std::ldexp(1, static_cast<int>(random() % 9));
    const double u = number(-20, 180), v = number(-20, 160), depth = number(1, 9);
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (int k = 0; k < 3; ++k) {
      double du = number(-8, 9) / 8 * span, dv = number(-8, 9) / 8 * span;
      double z = depth + number(0, 3) / 2;
      if (on_samples) {
        du = std::round(du) + 0.5;
        dv = std::round(dv) + 0.5;
      } else {
        z += number(0, 1000) / 8192;
      }
      // camera_of(width 160, height 140, focal length 64): u = 64·x/z + 80, v = 64·y/z + 70
      vertices.push_back({(u + du - 80) / 64 * z, (v + dv - 70) / 64 * z, z});
    }
    indices.push_back({first, first + 1, first + 2});
  }
  return scene_of(std::move(vertices), std::move(indices));
}

/// The same image with triangles across it that are a few pixels wide at most, upright and level
/// ones among them, and some large ones that they may pass behind.
inline Scene slivers(std::mt19937_64& random, int triangles) {
  std::vector<MeshPoint> vertices;
  std::vector<CornerIndices> indices;
  const auto number = [&](double from, double to) {
    return from + (to - from) * static_cast<double>(random() % 4096) / 4096;
  };
  const auto add = [&](double u, double v, double z) {
    vertices.push_back({(u - 80) / 64 * z, (v - 70) / 64 * z, z});
  };
  for (int t = 0; t < triangles; ++t) {
    const double u = number(-20, 180), v = number(-20, 160);
    const double width = std::ldexp(number(0, 4), -static_cast<int>(random() % 5));
    const double z = number(1, 4);
    const auto kind = random() % 8;
    const double across = kind == 0 ? 0 : number(-200, 200);
    const double down = kind == 1 ? 0 : number(-200, 200);
    const auto first = static_cast<std::uint32_t>(vertices.size());
    add(u, v, z);
    add(u + across, v + down, number(1, 4));
    add(kind == 2 ? u + 60 : u + (kind == 0 ? width : number(-width, width)),
        kind == 2 ? v + 60 : v + (kind == 1 ? width : number(-width, width)), z);
    indices.push_back({first, first + 1, first + 2});
  }
  return scene_of(std::move(vertices), std::move(indices));
}

/// Triangles before the eye and around it, some behind it, with corners of few bits.
template <class Random>
Scene soup_around_eye(Random& random, int triangles) {
  const auto coordinate = [&] { return static_cast<double>(random() % 33) / 4 - 4; };
  std::vector<MeshPoint> corners;
  std::vector<CornerIndices> indices;
  for (int t = 0; t < triangles; ++t) {
    const auto first = static_cast<std::uint32_t>(corners.size());
    for (int k = 0; k < 3; ++k) corners.push_back({coordinate(), coordinate(), coordinate() + 3});
    indices.push_back({first, first + 1, first + 2});
  }
  return scene_of(std::move(corners), std::move(indices));
}

}  // namespace fathom::checks
