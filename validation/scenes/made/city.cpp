#include "validation/scenes/made/made_meshes.h"
#include "validation/scenes/made/mesh_building.h"
#include "validation/scenes/made/random.h"

namespace fathom::bench {
namespace {

constexpr double house_side = 44, floor_height = 3.3, pavement_side = 50;

/// A bar along `along` on a wall that faces `out`: its three sides that are seen.
void add_bar(Mesh& mesh, const Vector3& corner, const Vector3& along, const Vector3& breadth,
             const Vector3& out) {
  add_parallelogram(mesh, corner + out, along, breadth);
  add_parallelogram(mesh, corner, along, out);
  add_parallelogram(mesh, corner + breadth, out, along);
}

/// A wall from `corner` along `along`, a unit vector, that faces `out`, another one.
void add_wall(Mesh& mesh, const Vector3& corner, const Vector3& along, const Vector3& out,
              std::uint32_t floors) {
  const Vector3 up{0, 1, 0};
  const double height = floors * floor_height;
  add_parallelogram(mesh, corner, house_side * along, height * up);
  for (std::uint32_t floor = 1; floor <= floors; ++floor) {
    add_bar(mesh, corner + (floor * floor_height - 0.3) * up, house_side * along, 0.2 * up,
            0.35 * out);
  }
  constexpr std::uint32_t piers = 19;
  for (std::uint32_t i = 0; i < piers; ++i) {
    add_bar(mesh, corner + ((i + 0.5) * house_side / piers) * along, height * up, 0.25 * along,
            0.2 * out);
  }
}

/// A house with its pavement; (x, z) is the middle.
void add_house(Mesh& mesh, double x, double z, std::uint32_t floors) {
  const double half = house_side / 2, pavement = pavement_side / 2;
  add_wall(mesh, {x - half, 0, z + half}, {1, 0, 0}, {0, 0, 1}, floors);
  add_wall(mesh, {x + half, 0, z - half}, {-1, 0, 0}, {0, 0, -1}, floors);
  add_wall(mesh, {x + half, 0, z + half}, {0, 0, -1}, {1, 0, 0}, floors);
  add_wall(mesh, {x - half, 0, z - half}, {0, 0, 1}, {-1, 0, 0}, floors);
  add_parallelogram(mesh, {x - half, floors * floor_height, z + half}, {house_side, 0, 0},
                    {0, 0, -house_side});
  // A little into the ground: two surfaces of one plane would be equally near.
  add_box(mesh, {x - pavement, -0.1, z - pavement}, {0, 0, pavement_side}, {pavement_side, 0, 0},
          {0, 0.25, 0});
}

/// A street through all of the city: `along` from `start`, a point of its middle; `side` is a unit
/// vector across it.
void add_street(Mesh& mesh, const Vector3& start, const Vector3& along, const Vector3& side) {
  const Vector3 up{0, 1, 0};
  for (const double offset : {-3.4, -0.15, 0.15, 3.4}) {
    add_parallelogram(mesh, start + (offset - 0.06) * side + 0.01 * up, 0.12 * side, along);
  }
  for (const double offset : {-2.5, -1.1, 1.1, 2.5}) {
    add_box(mesh, start + offset * side + 6.0 * up, 0.03 * side, along, 0.03 * up);
  }
}

}  // namespace

Mesh city(std::uint32_t blocks) {
  Mesh mesh;
  Random random(60);
  const double length = blocks * street_spacing, first = -length / 2;
  add_parallelogram(mesh, {first, 0, first}, {0, 0, length}, {length, 0, 0});
  for (std::uint32_t i = 0; i <= blocks; ++i) {
    const double middle = first + i * street_spacing;
    add_street(mesh, {middle, 0, first}, {0, 0, length}, {1, 0, 0});
    add_street(mesh, {first, 0.1, middle}, {length, 0, 0}, {0, 0, -1});
  }
  for (std::uint32_t i = 0; i < blocks; ++i) {
    for (std::uint32_t j = 0; j < blocks; ++j) {
      add_house(mesh, first + (i + 0.5) * street_spacing, first + (j + 0.5) * street_spacing,
                4 + random.below(17));
    }
  }
  return mesh;
}

}  // namespace fathom::bench
