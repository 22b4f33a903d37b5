#pragma once

#include <array>
#include <random>
#include <vector>

#include "fathom/fast/coverage/square_edges.h"
#include "tests/oracle/areas.h"

namespace fathom::checks {

using SquareTriangle = std::array<fast::SquarePoint, 3>;

inline double cross(const SquareTriangle& t) {
  return (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[1].y - t[0].y) * (t[2].x - t[0].x);
}

/// Triangles around the unit square. On a grid of 1/8 many corners and edges coincide, and all the
/// arithmetic of cross() is exact; otherwise none do.
inline std::vector<SquareTriangle> random_triangles(std::mt19937_64& random, std::size_t count,
                                                    bool on_grid) {
  std::uniform_int_distribution<int> eighths(-8, 16);
  std::uniform_real_distribution<double> anywhere(-1, 2);
  std::vector<SquareTriangle> triangles;
  while (triangles.size() < count) {
    SquareTriangle t;
    for (fast::SquarePoint& p : t) {
      p = on_grid ? fast::SquarePoint{eighths(random) / 8.0, eighths(random) / 8.0}
                  : fast::SquarePoint{anywhere(random), anywhere(random)};
    }
    if (cross(t) < 0) std::swap(t[1], t[2]);
    if (cross(t) > 0x1p-30) triangles.push_back(t);
  }
  return triangles;
}

/// The area of the union within the square, exactly: the square is the first pixel of an
/// orthographic camera that leaves coordinates as they are.
inline oracle::Q exact_area(const std::vector<SquareTriangle>& triangles) {
  oracle::RayCamera camera;
  camera.perspective = false;
  camera.fx = camera.fy = 1;
  camera.pixel_centre = oracle::Q(1, 2);
  for (std::size_t k = 0; k < 3; ++k) camera.world_to_camera[k][k] = 1;
  std::vector<oracle::Triangle> placed;
  for (const SquareTriangle& t : triangles) {
    placed.emplace_back();
    for (std::size_t k = 0; k < 3; ++k)
      placed.back()[k] = {oracle::Q(t[k].x), oracle::Q(t[k].y), oracle::Q(1)};
  }
  return oracle::Areas(camera, placed).coverage(0, 0);
}

}  // namespace fathom::checks
