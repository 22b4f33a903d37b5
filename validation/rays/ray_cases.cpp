#include "validation/rays/ray_cases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <utility>

#include "fathom/failures/errors.h"

namespace fathom::validation {
namespace {

using attribution::WorldMesh;
using Point = std::array<double, 3>;

double in_binary32(double x) {
  return static_cast<double>(static_cast<float>(x));
}

Point in_binary32(const Point& p) {
  return {in_binary32(p[0]), in_binary32(p[1]), in_binary32(p[2])};
}

WorldMesh rounded(WorldMesh mesh, const std::string& scene) {
  if (mesh.triangles.empty()) throw InputError(scene + ": the scene has no triangle");
  for (Point& p : mesh.points) {
    p = in_binary32(p);
    const bool is_finite =
        std::ranges::all_of(p, [](double coordinate) { return std::isfinite(coordinate); });
    if (!is_finite) throw InputError(scene + ": a coordinate is beyond binary32");
  }
  return mesh;
}

/// Random numbers that are the same with each standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}
  /// At least 0 and below 1.
  double share() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }
  double between(double a, double b) { return a + share() * (b - a); }
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(bits_() % count); }

 private:
  std::mt19937_64 bits_;
};

/// A ray from `from` to `to`, rounded as engines take it. Its direction is not 0.
Ray ray_to(const Point& from, const Point& to) {
  Ray ray{in_binary32(from), {}};
  for (std::size_t k = 0; k < 3; ++k) ray.direction[k] = in_binary32(to[k] - ray.origin[k]);
  if (ray.direction == Point{}) ray.direction[0] = 1;
  return ray;
}

/// Makes the rays of one mesh.
class RayMaker {
 public:
  RayMaker(const WorldMesh& mesh, const WorldBounds& box)
      : mesh_(mesh), low_(box.lower), high_(box.upper) {}

  std::vector<Ray> random(std::size_t count) {
    return made(count, [&] { return ray_to(around(), within()); });
  }
  std::vector<Ray> inside(std::size_t count) {
    return made(count, [&] {
      const Point origin = within();
      Point aim = origin;
      for (double& x : aim) x += random_.between(-1, 1) * size();
      return ray_to(origin, aim);
    });
  }
  std::vector<Ray> edges(std::size_t count) {
    return made(count, [&] {
      const CornerIndices& triangle = any_triangle();
      const std::size_t k = random_.below(3);
      const Point &a = mesh_.points[triangle[k]], &b = mesh_.points[triangle[(k + 1) % 3]];
      const double share = random_.share();
      Point aim;
      for (std::size_t i = 0; i < 3; ++i) aim[i] = a[i] + share * (b[i] - a[i]);
      return ray_to(around(), aim);
    });
  }
  std::vector<Ray> corners(std::size_t count) {
    return made(count, [&] {
      const std::size_t k = random_.below(3);
      return ray_to(around(), mesh_.points[any_triangle()[k]]);
    });
  }

 private:
  template <class Make>
  std::vector<Ray> made(std::size_t count, const Make& make) {
    random_ = Random(1);
    std::vector<Ray> rays;
    rays.reserve(count);
    for (std::size_t i = 0; i < count; ++i) rays.push_back(make());
    return rays;
  }
  const CornerIndices& any_triangle() {
    return mesh_.triangles[random_.below(mesh_.triangles.size())];
  }
  [[nodiscard]] double size() const {
    return std::max({high_[0] - low_[0], high_[1] - low_[1], high_[2] - low_[2]});
  }
  Point within() {
    Point p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = random_.between(low_[k], high_[k]);
    return p;
  }
  /// On a sphere around the box.
  Point around() {
    Point direction;
    double square = 0;
    do {
      for (double& x : direction) x = random_.between(-1, 1);
      square =
          direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2];
    } while (square > 1 || square < 0.01);
    Point p;
    for (std::size_t k = 0; k < 3; ++k)
      p[k] = (low_[k] + high_[k]) / 2 + direction[k] / std::sqrt(square) * 1.5 * size();
    return p;
  }

  const WorldMesh& mesh_;
  Point low_, high_;
  Random random_{1};
};

WorldMesh divided_square() {
  constexpr std::size_t most_triangles = 1024;
  Random random(1);
  WorldMesh mesh;
  mesh.points = {{0, 0, -1}, {0, 1, -1}, {1, 0, -1}, {1, 1, -1}};
  std::vector<CornerIndices> triangles{{0, 1, 2}, {3, 2, 1}};
  while (triangles.size() < most_triangles) {
    CornerIndices& triangle = triangles[random.below(triangles.size())];
    const auto [a, b, c] = triangle;
    const double first = random.between(0.01, 0.99), second = random.between(0.01, 0.99);
    const auto mixed = [&](std::size_t k) {
      const double on_edge = first * mesh.points[a][k] + (1 - first) * mesh.points[b][k];
      return second * on_edge + (1 - second) * mesh.points[c][k];
    };
    const auto d = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back({mixed(0), mixed(1), -random.between(0.01, 0.99)});
    triangle = {a, b, d};
    triangles.push_back({b, c, d});
    triangles.push_back({a, c, d});
  }
  mesh.triangles = std::move(triangles);
  return rounded(std::move(mesh), "square");
}

std::vector<Ray> rays_of_grid(std::size_t count) {
  const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count))));
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const auto centre = [&](std::size_t k) {
      return in_binary32((static_cast<double>(k) + 0.5) / static_cast<double>(side));
    };
    rays.push_back({{centre(i % side), centre(i / side), 0}, {0, 0, -1}});
  }
  return rays;
}

constexpr std::size_t voxels = 8;

/// The outer squares of a body of cubes, each square as two triangles.
class VoxelBody {
 public:
  VoxelBody() {
    Random random(2);
    for (auto& plane : is_filled_)
      for (auto& row : plane)
        for (bool& filled : row) filled = random.share() < 0.5;
  }

  WorldMesh surface() {
    for (std::size_t x = 0; x < voxels; ++x)
      for (std::size_t y = 0; y < voxels; ++y)
        for (std::size_t z = 0; z < voxels; ++z)
          if (is_filled_[x][y][z]) add_squares({x, y, z});
    mesh_.triangles = std::move(triangles_);
    return std::move(mesh_);
  }

 private:
  using Cell = std::array<std::size_t, 3>;

  /// Cells beyond the body wrap around to numbers that are too large.
  [[nodiscard]] bool is_empty(const Cell& cell) const {
    return cell[0] >= voxels || cell[1] >= voxels || cell[2] >= voxels ||
           !is_filled_[cell[0]][cell[1]][cell[2]];
  }
  void add_squares(const Cell& cell) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Cell above = cell, below = cell;
      ++above[axis];
      --below[axis];
      if (is_empty(above)) add_square(above, axis, true);
      if (is_empty(below)) add_square(cell, axis, false);
    }
  }
  void add_square(const Cell& low, std::size_t axis, bool faces_up) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto first = static_cast<std::uint32_t>(mesh_.points.size());
    for (const auto& [i, j] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
      Point p{static_cast<double>(low[0]), static_cast<double>(low[1]),
              static_cast<double>(low[2])};
      p[u] += i;
      p[v] += j;
      mesh_.points.push_back(p);
    }
    if (faces_up) {
      triangles_.push_back({first, first + 1, first + 2});
      triangles_.push_back({first, first + 2, first + 3});
    } else {
      triangles_.push_back({first, first + 2, first + 1});
      triangles_.push_back({first, first + 3, first + 2});
    }
  }

  std::array<std::array<std::array<bool, voxels>, voxels>, voxels> is_filled_{};
  WorldMesh mesh_;
  std::vector<CornerIndices> triangles_;
};

/// Between points whose coordinates are multiples of ½.
std::vector<Ray> rays_of_halves(std::size_t count) {
  Random random(3);
  const auto coordinate = [&] { return static_cast<double>(random.below(2 * voxels + 1)) / 2; };
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < count; ++i) {
    Point from{coordinate(), coordinate(), coordinate()};
    from[random.below(3)] = random.below(2) == 0 ? -4.0 : double{voxels} + 4;
    rays.push_back(ray_to(from, {coordinate(), coordinate(), coordinate()}));
  }
  return rays;
}

}  // namespace

std::vector<RayCase> ray_cases(const std::string& scene, const WorldMesh& mesh, std::size_t count) {
  const WorldMesh taken = rounded(mesh, scene);
  RayMaker rays(taken, attribution::box_of(taken).value());
  return {{scene, "random", taken, rays.random(count)},
          {scene, "inside", taken, rays.inside(count)},
          {scene, "edges", taken, rays.edges(count)},
          {scene, "corners", taken, rays.corners(count)}};
}

std::vector<RayCase> made_ray_cases(std::size_t count) {
  return {{"square", "parallel", divided_square(), rays_of_grid(count)},
          {"voxels", "halves", VoxelBody().surface(), rays_of_halves(count)}};
}

}  // namespace fathom::validation
