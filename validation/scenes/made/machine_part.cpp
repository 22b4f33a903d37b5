#include <cmath>
#include <numbers>
#include <utility>

#include "validation/scenes/made/made_meshes.h"

namespace fathom::bench {
namespace {

constexpr double half_thickness = 0.3;

/// The vertices of a horizontal circle, counter-clockwise from above. Returns the first one's
/// number.
std::uint32_t add_circle(Mesh& mesh, const Vector3& centre, double radius, std::uint32_t steps) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (std::uint32_t i = 0; i < steps; ++i) {
    const double angle = 2 * std::numbers::pi * i / steps;
    add_vertex(mesh, centre + Vector3{radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  return first;
}

/// The strip between two circles of as many vertices; faces upwards if the second is wider.
void join_circles(Mesh& mesh, std::uint32_t one, std::uint32_t other, std::uint32_t steps) {
  for (std::uint32_t i = 0; i < steps; ++i) {
    const std::uint32_t next = (i + 1) % steps;
    mesh.triangles.push_back({one + i, other + i, other + next});
    mesh.triangles.push_back({one + i, other + next, one + next});
  }
}

/// The face of a cell around its hole: from each corner a fan to a quarter of the circle, and a
/// triangle between each two. Seen from above, from below with `flipped`.
void add_cell_face(Mesh& mesh, const Vector3& centre, std::uint32_t circle, std::uint32_t steps,
                   bool flipped) {
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.triangles.push_back(flipped ? CornerIndices{a, c, b} : CornerIndices{a, b, c});
  };
  const auto corner = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const auto& [x, y] : {std::pair{0.5, 0.5}, {-0.5, 0.5}, {-0.5, -0.5}, {0.5, -0.5}}) {
    add_vertex(mesh, centre + Vector3{x, y, 0});
  }
  const std::uint32_t quarter = steps / 4;
  for (std::uint32_t q = 0; q < 4; ++q) {
    for (std::uint32_t i = q * quarter; i < (q + 1) * quarter; ++i) {
      add(corner + q, circle + (i + 1) % steps, circle + i);
    }
    add(corner + q, corner + (q + 1) % 4, circle + (q + 1) * quarter % steps);
  }
}

void add_cell(Mesh& mesh, double x, double y, double radius) {
  constexpr std::uint32_t steps = 64;
  const Vector3 above{x, y, half_thickness}, below{x, y, -half_thickness};
  const std::uint32_t top = add_circle(mesh, above, radius, steps);
  const std::uint32_t bottom = add_circle(mesh, below, radius, steps);
  add_cell_face(mesh, above, top, steps, false);
  add_cell_face(mesh, below, bottom, steps, true);
  join_circles(mesh, bottom, top, steps);
}

/// A closed cylinder along x, whose ends are fans from a point of the rim.
void add_rod(Mesh& mesh, const Vector3& from, double length, double radius) {
  constexpr std::uint32_t sides = 360;
  const Vector3 to = from + Vector3{length, 0, 0};
  add_tube(mesh, from, radius, to, radius, sides);
  for (const Vector3& centre : {from, to}) {
    for (std::uint32_t i = 0; i < sides; ++i) {
      const double angle = 2 * std::numbers::pi * i / sides;
      add_vertex(mesh, centre + Vector3{0, radius * std::cos(angle), radius * std::sin(angle)});
    }
    add_fan(mesh, sides);
  }
}

/// A ring on the plate between the radii 0.6·R and R, with a fillet around its foot and its top
/// edge rounded: circles from outside to inside, joined one to the next.
void add_ring(Mesh& mesh, double x, double y, double R, std::uint32_t steps) {
  constexpr std::uint32_t arc = 6;
  const double fillet = 0.1 * R, height = 0.5 * R, z = half_thickness;
  std::uint32_t before = add_circle(mesh, {x, y, z}, R + fillet, steps);
  const auto go_to = [&](double radius, double up) {
    const std::uint32_t circle = add_circle(mesh, {x, y, z + up}, radius, steps);
    join_circles(mesh, circle, before, steps);
    before = circle;
  };
  const auto quarter = [](std::uint32_t i) { return std::numbers::pi / 2 * i / arc; };
  for (std::uint32_t i = 1; i <= arc; ++i) {
    go_to(R + fillet - fillet * std::sin(quarter(i)), fillet - fillet * std::cos(quarter(i)));
  }
  for (std::uint32_t i = 0; i <= arc; ++i) {
    go_to(R - fillet + fillet * std::cos(quarter(i)),
          height - fillet + fillet * std::sin(quarter(i)));
  }
  go_to(0.6 * R, height);
  go_to(0.6 * R, 0);
}

}  // namespace

Mesh machine_part(std::uint32_t rows) {
  Mesh mesh;
  const std::uint32_t columns = rows * 3 / 2;
  const double left = -0.5 * columns, front = -0.5 * rows;
  for (std::uint32_t i = 0; i < columns; ++i) {
    for (std::uint32_t j = 0; j < rows; ++j) {
      add_cell(mesh, left + i + 0.5, front + j + 0.5, 0.2 + 0.2 * ((i * 7 + j * 3) % 10) / 9.0);
    }
  }
  for (std::uint32_t j = 0; j < rows; j += 3) {
    add_rod(mesh, {1.1 * left, front + j + 1.0, 1.4}, 1.1 * columns, 0.25);
  }
  for (const double x : {-0.3, -0.1, 0.1, 0.3}) {
    add_ring(mesh, x * columns, 0, 0.09 * columns, 60 * rows);
  }
  return mesh;
}

}  // namespace fathom::bench
