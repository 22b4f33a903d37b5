#include "validation/scenes/made/made_meshes.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "validation/scenes/made/random.h"
#include "validation/scenes/shapes.h"

namespace fathom::bench {

Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector3 unit(const Vector3& a) {
  return 1 / std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]) * a;
}

Across across(const Vector3& axis) {
  const bool upright = std::abs(axis[1]) > std::abs(axis[0]);
  const Vector3 u = unit(cross(upright ? Vector3{1, 0, 0} : Vector3{0, 1, 0}, axis));
  return {u, unit(cross(axis, u))};
}

std::uint32_t add_vertex(Mesh& mesh, const Vector3& p) {
  mesh.vertices.push_back({p[0], p[1], p[2]});
  return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
}

void add_parallelogram(Mesh& mesh, const Vector3& corner, const Vector3& a, const Vector3& b) {
  const std::uint32_t first = add_vertex(mesh, corner);
  add_vertex(mesh, corner + a);
  add_vertex(mesh, corner + a + b);
  add_vertex(mesh, corner + b);
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

void add_box(Mesh& mesh, const Vector3& corner, const Vector3& a, const Vector3& b,
             const Vector3& c) {
  add_parallelogram(mesh, corner, b, a);
  add_parallelogram(mesh, corner + c, a, b);
  add_parallelogram(mesh, corner, c, b);
  add_parallelogram(mesh, corner + a, b, c);
  add_parallelogram(mesh, corner, a, c);
  add_parallelogram(mesh, corner + b, c, a);
}

void add_tube(Mesh& mesh, const Vector3& from, double from_radius, const Vector3& to,
              double to_radius, std::uint32_t sides) {
  const auto [u, v] = across(unit(to + -1.0 * from));
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    const Vector3 out = std::cos(angle) * u + std::sin(angle) * v;
    add_vertex(mesh, from + from_radius * out);
    add_vertex(mesh, to + to_radius * out);
  }
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t a = first + 2 * i, b = first + 2 * ((i + 1) % sides);
    mesh.triangles.push_back({a, b, a + 1});
    mesh.triangles.push_back({b, b + 1, a + 1});
  }
}

void add_fan(Mesh& mesh, std::uint32_t corners) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size()) - corners;
  for (std::uint32_t i = 1; i + 1 < corners; ++i) {
    mesh.triangles.push_back({first, first + i, first + i + 1});
  }
}

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

namespace {

struct Octave {
  double frequency, amplitude;
};
constexpr std::array<Octave, 6> bumps{
    {{1.6, 0.2}, {3.7, 0.08}, {8.1, 0.03}, {17, 0.013}, {39, 0.006}, {83, 0.003}}};

/// A direction moved along the sphere, so that vertices crowd in some places and spread in others.
Vector3 crowded(const Vector3& p) {
  const Vector3 q = 1.9 * p;
  return unit(p + 0.3 * Vector3{value_noise(q, 101), value_noise(q, 102), value_noise(q, 103)});
}

/// The distance of the surface from the origin.
double radius(const Vector3& direction) {
  double sum = 1;
  std::uint64_t seed = 0;
  for (const Octave& octave : bumps) {
    sum += octave.amplitude * value_noise(octave.frequency * direction, ++seed);
  }
  return sum;
}

/// Whether the scanner did not see the surface around a point.
bool unseen(const MeshPoint& point) {
  const Vector3 p{point.x, point.y, point.z};
  return value_noise(2.3 * p, 201) > 0.62 || value_noise(11.0 * p, 202) > 0.8;
}

void leave_out_unseen(Mesh& mesh, Random& random) {
  std::size_t kept = 0;
  for (const CornerIndices& t : mesh.triangles) {
    if (unseen(mesh.vertices[t[0]]) || random() < 0.001) continue;
    mesh.triangles[kept++] = t;
  }
  mesh.triangles.resize(kept);
}

}  // namespace

Mesh scan(std::uint64_t triangles) {
  Mesh mesh = sphere(triangles);
  Random random(31);
  // A fifth of the length of an edge.
  const double noise = 0.2 * std::sqrt(4 * std::numbers::pi / static_cast<double>(triangles));
  for (MeshPoint& point : mesh.vertices) {
    const Vector3 direction = crowded({point.x, point.y, point.z});
    const Vector3 p = (radius(direction) + random.between(-noise, noise)) * direction;
    point = {p[0], p[1], p[2]};
  }
  leave_out_unseen(mesh, random);
  return mesh;
}

namespace {

constexpr double pen = 0.14;  // the width of a stroke

/// A stroke from (x, low) to (x, high) with round ends.
struct Stem {
  double x, low, high;
};

/// A stroke around (0.27, 0.25), in turns counter-clockwise from the right.
struct Bow {
  double from, to;
};

struct Letter {
  std::vector<Stem> stems;
  std::vector<Bow> bows;
};

/// o c l i b d p q n u, a small x being half an em high.
const std::vector<Letter>& letters() {
  static const std::vector<Letter> all{{{}, {{0, 1}}},
                                       {{}, {{0.12, 0.88}}},
                                       {{{0.27, 0, 0.75}}, {}},
                                       {{{0.27, 0, 0.45}, {0.27, 0.64, 0.66}}, {}},
                                       {{{0.05, 0, 0.75}}, {{0, 1}}},
                                       {{{0.49, 0, 0.75}}, {{0, 1}}},
                                       {{{0.05, -0.25, 0.5}}, {{0, 1}}},
                                       {{{0.49, -0.25, 0.5}}, {{0, 1}}},
                                       {{{0.05, 0, 0.5}, {0.49, 0, 0.25}}, {{0, 0.5}}},
                                       {{{0.49, 0, 0.5}, {0.05, 0.25, 0.5}}, {{0.5, 1}}}};
  return all;
}

void add_stem(Mesh& mesh, const Vector3& origin, const Stem& stem) {
  constexpr std::uint32_t half_circle = 16;
  for (std::uint32_t end = 0; end < 2; ++end) {
    const double y = end == 0 ? stem.high : stem.low;
    for (std::uint32_t i = 0; i <= half_circle; ++i) {
      const double angle = std::numbers::pi * (end + static_cast<double>(i) / half_circle);
      add_vertex(mesh, origin + Vector3{stem.x + pen / 2 * std::cos(angle),
                                        y + pen / 2 * std::sin(angle), 0});
    }
  }
  add_fan(mesh, 2 * (half_circle + 1));
}

void add_bow(Mesh& mesh, const Vector3& origin, const Bow& bow) {
  const auto steps = static_cast<std::uint32_t>(std::ceil((bow.to - bow.from) * 48));
  for (std::uint32_t i = 0; i <= steps; ++i) {
    const double angle =
        2 * std::numbers::pi * (bow.from + (bow.to - bow.from) * i / static_cast<double>(steps));
    const Vector3 middle = origin + Vector3{0.27, 0.25, 0};
    const Vector3 out{0.92 * std::cos(angle), std::sin(angle), 0};
    const std::uint32_t outer = add_vertex(mesh, middle + (0.25 + pen / 2) * out);
    const std::uint32_t inner = add_vertex(mesh, middle + (0.25 - pen / 2) * out);
    if (i == 0) continue;
    mesh.triangles.push_back({outer - 2, outer, inner - 2});
    mesh.triangles.push_back({inner - 2, outer, inner});
  }
}

void add_letter(Mesh& mesh, const Vector3& origin, const Letter& letter) {
  for (const Stem& stem : letter.stems) add_stem(mesh, origin, stem);
  // Bows lie a little behind stems: strokes of one plane would be equally near where they meet.
  for (const Bow& bow : letter.bows) add_bow(mesh, origin + Vector3{0, 0, -0.01}, bow);
}

}  // namespace

Mesh text_page(std::uint32_t lines) {
  Mesh mesh;
  Random random(26);
  const auto kinds = static_cast<std::uint32_t>(letters().size());
  for (std::uint32_t line = 0; line < lines; ++line) {
    for (std::uint32_t column = 0; column < 100; ++column) {
      const Vector3 origin{0.7 * column, -1.3 * (line + 1), 0};
      if (random() < 0.15) continue;
      add_letter(mesh, origin, letters()[random.below(kinds)]);
    }
  }
  return mesh;
}

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
