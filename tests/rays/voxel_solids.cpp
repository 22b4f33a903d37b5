#include "tests/rays/voxel_solids.h"

#include <array>
#include <random>
#include <set>
#include <utility>

#include "tests/inputs/scene_building.h"

namespace fathom::rays::test {
namespace {

using Random = std::mt19937_64;
using Point = std::array<double, 3>;

int from(Random& random, int least, int greatest) {
  return least + static_cast<int>(random() % static_cast<std::uint64_t>(greatest - least + 1));
}

constexpr int voxels = 4;

std::set<std::array<int, 3>> some_voxels(Random& random) {
  std::set<std::array<int, 3>> solid;
  const int count = from(random, 1, 20);
  for (int i = 0; i < count; ++i) {
    const int x = from(random, 0, voxels - 1), y = from(random, 0, voxels - 1),
              z = from(random, 0, voxels - 1);
    solid.insert({x, y, z});
  }
  return solid;
}

/// A linear map with whole numbers, so that corners of voxels stay exact.
Point sheared(const std::array<int, 3>& p) {
  return {4.0 * p[0] + p[1], 4.0 * p[1] - p[2], 4.0 * p[2] + p[0] + p[1]};
}

}  // namespace

Scene voxel_solid(std::uint64_t seed) {
  Random random(seed);
  const auto solid = some_voxels(random);
  std::vector<MeshPoint> vertices;
  std::vector<CornerIndices> list;
  const auto add = [&](const std::array<int, 3>& p) {
    const Point q = sheared(p);
    vertices.push_back({q[0], q[1], q[2]});
    return static_cast<std::uint32_t>(vertices.size() - 1);
  };
  for (const auto& voxel : solid) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const int side : {0, 1}) {
        auto neighbour = voxel;
        neighbour[axis] += side == 1 ? 1 : -1;
        if (solid.contains(neighbour)) continue;
        const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        std::array<std::uint32_t, 4> corner{};
        for (std::size_t i = 0; i < 4; ++i) {
          auto p = voxel;
          p[axis] += side;
          p[u] += i == 1 || i == 2 ? 1 : 0;
          p[v] += i >= 2 ? 1 : 0;
          corner[i] = add(p);
        }
        if (side == 0) std::swap(corner[1], corner[3]);
        const std::size_t turn = random() % 2;
        list.push_back({corner[turn], corner[turn + 1], corner[turn + 2]});
        list.push_back({corner[turn], corner[turn + 2], corner[(turn + 3) % 4]});
        if (random() % 3 == 0) list.push_back({corner[0], corner[0], corner[2]});
      }
    }
  }
  return checks::scene_of(std::move(vertices), std::move(list));
}

std::vector<Ray> rays_at_voxels(std::uint64_t seed, int count) {
  Random random(seed + 1);
  const auto place = [&] {
    std::array<int, 3> p{};
    for (int& x : p) x = from(random, -1, 2 * voxels + 1);
    const Point twice = sheared(p);
    return Point{twice[0] / 2, twice[1] / 2, twice[2] / 2};
  };
  std::vector<Ray> rays;
  for (int i = 0; i < count; ++i) {
    const Point origin = place(), target = place();
    Point d{target[0] - origin[0], target[1] - origin[1], target[2] - origin[2]};
    if (d == Point{}) d = {0, 1, 0};
    rays.push_back({origin, d});
  }
  return rays;
}

}  // namespace fathom::rays::test
