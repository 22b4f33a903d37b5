#include <cmath>
#include <numbers>

#include "validation/scenes/made/made_meshes.h"
#include "validation/scenes/made/mesh_building.h"
#include "validation/scenes/made/random.h"

namespace fathom::bench {
namespace {

/// A unit vector, the same for each direction.
Vector3 any_direction(Random& random) {
  const double y = random.between(-1, 1), angle = random.between(0, 2 * std::numbers::pi);
  const double r = std::sqrt(1 - y * y);
  return {r * std::cos(angle), y, r * std::sin(angle)};
}

void add_leaf(Mesh& mesh, const Vector3& base, Random& random) {
  const Vector3 along = any_direction(random);
  const auto [side, up] = across(along);
  const Vector3 middle = base + 0.01 * along + 0.003 * up;
  const std::uint32_t stalk = add_vertex(mesh, base), tip = add_vertex(mesh, base + 0.02 * along);
  const std::uint32_t left = add_vertex(mesh, middle + -0.007 * side);
  const std::uint32_t right = add_vertex(mesh, middle + 0.007 * side);
  mesh.triangles.push_back({stalk, tip, left});
  mesh.triangles.push_back({stalk, right, tip});
}

class Growing {
 public:
  Growing(Mesh& mesh, std::uint32_t leaves) : mesh_(mesh), leaves_(leaves) {}

  void branch(const Vector3& from, const Vector3& direction, double length, double radius,
              std::uint32_t forks) {
    const Vector3 to = from + length * direction;
    add_tube(mesh_, from, radius, to, 0.7 * radius, 6);
    if (forks == 0) return leaves(from, direction, length);
    const auto [u, v] = across(direction);
    const double turn = random_.between(0, 2 * std::numbers::pi);
    for (int k = 0; k < 4; ++k) {
      // The first goes on almost straight, the others bend away around it.
      const double angle = turn + 2 * std::numbers::pi * k / 3;
      const double bend = k == 0 ? 0.15 : random_.between(0.6, 1.1);
      const Vector3 out = std::cos(angle) * u + std::sin(angle) * v;
      const Vector3 child = unit(std::cos(bend) * direction + std::sin(bend) * out);
      const double share = k == 0 ? 1 : random_.between(0.5, 1);
      branch(from + (share * length) * direction, child, length * random_.between(0.6, 0.78),
             0.5 * radius, forks - 1);
    }
  }

 private:
  void leaves(const Vector3& from, const Vector3& direction, double length) {
    for (std::uint32_t i = 0; i < leaves_; ++i) {
      const Vector3 near_twig = from + (random_() * length) * direction;
      const double away = random_.between(0, 0.8);
      add_leaf(mesh_, near_twig + away * any_direction(random_), random_);
    }
  }

  Mesh& mesh_;
  std::uint32_t leaves_;
  Random random_{4};
};

}  // namespace

Mesh tree(std::uint32_t forks, std::uint32_t leaves) {
  Mesh mesh;
  Growing(mesh, leaves).branch({0, 0, 0}, {0, 1, 0}, 6, 0.4, forks);
  return mesh;
}

}  // namespace fathom::bench
