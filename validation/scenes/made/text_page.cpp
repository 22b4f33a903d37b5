#include <cmath>
#include <numbers>
#include <vector>

#include "validation/scenes/made/made_meshes.h"
#include "validation/scenes/made/mesh_building.h"
#include "validation/scenes/made/random.h"

namespace fathom::bench {
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

}  // namespace fathom::bench
