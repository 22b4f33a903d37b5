#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/scene/scene.h"

namespace fathom::checks {

/// The same camera with a table of directions in place of its projection.
inline Camera with_table(Camera camera, std::vector<double> numbers) {
  Projection projection;
  projection.lens.emplace(Lens{LensModel::table}).directions =
      std::make_shared<const DirectionTable>(camera.width, camera.height, std::move(numbers));
  camera.projection = projection;
  return camera;
}

/// Directions of few bits, among them some along the axes and diagonals, none, and some that are
/// very long or short.
class DirectionMaker {
 public:
  explicit DirectionMaker(std::uint64_t seed) : random_(seed) {}

  DirectionTable::Direction make() {
    const double NaN = std::numeric_limits<double>::quiet_NaN();
    const int kind = below(12);
    if (kind == 0) return {0, -0.0, 0};
    if (kind == 1) return {1, NaN, 0};
    DirectionTable::Direction d{};
    while (d == DirectionTable::Direction{})
      for (double& component : d) component = std::ldexp(below(9) - 4, -below(3));
    const int power = kind == 2 ? 480 : kind == 3 ? -480 : below(5);
    for (double& component : d) component = std::ldexp(component, power);
    return d;
  }

  std::vector<double> numbers(std::size_t pixels) {
    std::vector<double> numbers;
    for (std::size_t i = 0; i < pixels; ++i) {
      const DirectionTable::Direction d = make();
      numbers.insert(numbers.end(), d.begin(), d.end());
    }
    return numbers;
  }

 private:
  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }

  std::mt19937_64 random_;
};

/// Directions to the corners of a scene, and to points halfway between them, where they are
/// binary64 numbers: of every second pixel, as far as there are pixels.
inline void aim_at_corners(const Scene& scene, std::vector<double>& numbers) {
  const std::vector<MeshPoint> corners(scene.meshes[0].vertices.begin(),
                                       scene.meshes[0].vertices.end());
  for (std::size_t i = 0; i + 2 < corners.size() && 6 * i + 3 <= numbers.size(); ++i) {
    const MeshPoint &a = corners[i], &b = corners[i + 1];
    const double other = i % 2;
    const double d[]{a.x + other * b.x, a.y + other * b.y, a.z + other * b.z};
    if (d[0] == 0 && d[1] == 0 && d[2] == 0) continue;
    if (!std::isfinite(d[0] + d[1] + d[2])) continue;
    std::copy_n(d, 3, &numbers[6 * i]);
  }
}

}  // namespace fathom::checks
