// Coplanar pairs of scenes from families that are each hard for a reason of their own, against
// polygons clipped in rational numbers. The distance asked about is that of one of the pairs, or
// the next number.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "fathom/area/coplanar.h"
#include "tests/adversaries.h"
#include "tests/inputs/adversarial_scenes.h"
#include "tests/inputs/draw.h"
#include "tests/inputs/floating_point_modes.h"
#include "tests/oracle/against_oracle.h"
#include "tests/oracle/close_behind.h"
#include "tests/special_values.h"

namespace fathom {
namespace {

using checks::Case;
using checks::Draw;
using checks::Family;
using oracle::Behind;
using oracle::Q;

/// Corners of its own for each triangle, drawn within it; where corners have few bits, in its
/// plane.
void take_corners_apart(Draw& draw, Mesh& mesh) {
  constexpr double weights[][3] = {{8, 0, 0}, {6, 1, 1}, {5, 2, 1},
                                   {4, 1, 3}, {7, 0, 1}, {6, 2, 0}};
  const MeshArray<MeshPoint> shared = mesh.vertices;
  mesh.vertices.clear();
  for (CornerIndices& t : mesh.triangles) {
    const auto& w = draw.one_of(weights);
    const CornerIndices from = t;
    for (std::size_t i = 0; i < 3; ++i) {
      const MeshPoint &a = shared[from[i]], &b = shared[from[(i + 1) % 3]],
                      &c = shared[from[(i + 2) % 3]];
      const auto mixed = [&](double MeshPoint::*k) {
        return w[0] / 8 * a.*k + w[1] / 8 * b.*k + w[2] / 8 * c.*k;
      };
      t[i] = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.push_back({mixed(&MeshPoint::x), mixed(&MeshPoint::y), mixed(&MeshPoint::z)});
    }
  }
}

/// Pairs that share a corner do not count: most draw corners from a few.
Case scene_of(Family family, std::uint64_t seed, Draw& draw) {
  Case c = checks::adversarial_case(family, seed);
  if (!draw.one_in(4)) take_corners_apart(draw, c.scene.meshes[0]);
  return c;
}

bool share_a_corner(const TriangleSource& triangles, std::uint32_t s, std::uint32_t t) {
  for (const WorldPoint& p : triangles.world_corners(s)) {
    for (const WorldPoint& q : triangles.world_corners(t)) {
      if (p.x == q.x && p.y == q.y && p.z == q.z) return true;
    }
  }
  return false;
}

/// What lies behind what is visible, without pairs that share a corner.
std::vector<Behind> truth_of(const Case& c, Cull cull) {
  const TriangleSource triangles(c.scene);
  // v grows downwards: a front, which turns against the clock, has a negative area.
  const int way = cull == Cull::back ? -1 : cull == Cull::front ? 1 : 0;
  std::vector<Behind> all = oracle::behind_visible(
      checks::areas_at(c.scene, c.camera), is_perspective(c.camera.projection),
      static_cast<int>(c.camera.width), static_cast<int>(c.camera.height), way);
  std::erase_if(all, [&](const Behind& pair) {
    return share_a_corner(triangles, pair.visible, pair.behind);
  });
  return all;
}

/// The pair for a distance, without its separation; none if it has no pixels.
CoplanarPair expected_pair(const Behind& behind, const Q& within) {
  CoplanarPair pair{behind.visible, behind.behind, 0, 0, {}};
  for (const Behind::InPixel& pixel : behind.pixels) {
    if (!behind.is_close(pixel, within)) continue;
    const auto x = static_cast<std::uint32_t>(pixel.x), y = static_cast<std::uint32_t>(pixel.y);
    PixelBox& box = pair.box;
    if (pair.pixels++ == 0) box = {x, x, y, y};
    box = {std::min(box.first_column, x), std::max(box.last_column, x), std::min(box.first_row, y),
           std::max(box.last_row, y)};
  }
  return pair;
}

/// Whether a number is the least separation rounded to nearest, ties to even.
bool is_nearest(const Behind& behind, double separation) {
  constexpr double greatest = std::numeric_limits<double>::max();
  const auto number = [&](double x) { return std::isinf(x) ? Q(Q(greatest) + Q(0x1p971)) : Q(x); };
  const bool even = std::bit_cast<std::uint64_t>(separation) % 2 == 0;
  const Q x = number(separation);
  const Q below = (number(std::nextafter(separation, -infinity)) + x) / 2;
  if (behind.reaches(below, !even)) return false;
  if (std::isinf(separation)) return true;
  const Q above = (number(std::nextafter(separation, infinity)) + x) / 2;
  return behind.reaches(above, even);
}

std::vector<CoplanarPair> pairs_of(const Case& c, Cull cull, double within, Draw& draw) {
  RenderOptions options;
  options.cull = cull;
  options.threads = draw.between(1, 3);
  const checks::InMode mode(checks::any_mode(draw.generator()));
  return coplanar_pairs(TriangleSource(c.scene), c.camera, within, options);
}

std::string text_of(const CoplanarPair& p) {
  return std::to_string(p.visible) + " before " + std::to_string(p.behind) + " in " +
         std::to_string(p.pixels) + " pixels, columns " + std::to_string(p.box.first_column) +
         " to " + std::to_string(p.box.last_column) + ", rows " + std::to_string(p.box.first_row) +
         " to " + std::to_string(p.box.last_row);
}

/// The pairs that were found, if they are the right ones.
std::vector<CoplanarPair> expect_pairs(const Case& c, Cull cull, const std::vector<Behind>& truth,
                                       double within, Draw& draw) {
  ::testing::Message trace;
  trace << "within " << std::hexfloat << within;
  SCOPED_TRACE(trace);
  std::vector<std::string> expected, found;
  std::vector<const Behind*> close;
  for (const Behind& behind : truth) {
    const CoplanarPair pair = expected_pair(behind, Q(within));
    if (pair.pixels == 0) continue;
    expected.push_back(text_of(pair));
    close.push_back(&behind);
  }
  const std::vector<CoplanarPair> pairs = pairs_of(c, cull, within, draw);
  for (const CoplanarPair& pair : pairs) found.push_back(text_of(pair));
  EXPECT_EQ(found, expected);
  if (found != expected) return pairs;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    EXPECT_TRUE(is_nearest(*close[i], pairs[i].separation))
        << found[i] << ": " << std::hexfloat << pairs[i].separation;
  }
  return pairs;
}

class CoplanarAdversaries : public ::testing::TestWithParam<Family> {};

TEST_P(CoplanarAdversaries, AreThoseOfRationalNumbers) {
  const std::uint64_t scenes = GetParam() == Family::coplanar_heaps ? 60 : 30;
  std::size_t pairs = 0;
  checks::for_each_adversary(scenes, [&](std::uint64_t seed) {
    Draw draw(seed);
    const Case c = scene_of(GetParam(), seed, draw);
    const Cull cull = draw.one_in(5) ? Cull::back : draw.one_in(5) ? Cull::front : Cull::none;
    const std::vector<Behind> truth = truth_of(c, cull);
    const auto found = expect_pairs(c, cull, truth, draw.one_in(2) ? 0x1p1000 : 4, draw);
    expect_pairs(c, cull, truth, 0, draw);
    pairs += found.size();
    if (found.empty()) return;
    const double one = found[draw.bits() % found.size()].separation;
    for (const double within :
         {one, std::nextafter(one, infinity), std::nextafter(one, -infinity)}) {
      if (within >= 0 && std::isfinite(within)) expect_pairs(c, cull, truth, within, draw);
    }
  });
  // Of two families next to nothing is seen.
  if (GetParam() == Family::around_the_eye || GetParam() == Family::exponents) return;
  if (checks::number_of_adversaries(scenes) < scenes) return;
  EXPECT_GT(pairs, 3U);
}

INSTANTIATE_TEST_SUITE_P(EachFamily, CoplanarAdversaries, ::testing::ValuesIn(checks::all_families),
                         [](const auto& test) { return checks::name_of(test.param); });

}  // namespace
}  // namespace fathom
