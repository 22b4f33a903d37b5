// Scan-line fill against the parity of a ray at every pixel centre.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "fathom/pipeline/scan/area_fill.h"
#include "tests/effort.h"
#include "tests/pipeline/scan/rings.h"

namespace fathom::pipeline {
namespace {

using checks::Corners;

template <class Number>
std::vector<Pixel> filled(const std::vector<Corners>& rings, FillRule rule,
                          const PixelWindow& window = {}) {
  FillPolygon<Number> polygon;
  for (const Corners& ring : rings) {
    polygon.emplace_back();
    for (const auto& [x, y] : ring) polygon.back().push_back({Number(x), Number(y), {}});
  }
  std::vector<Pixel> pixels;
  fill_polygon<Number>(polygon, rule, window, [&](const ScanLine<Number>& line) {
    for (const auto& span : line.spans)
      for (std::int64_t x = span.pixels.x_begin; x < span.pixels.x_end; ++x)
        pixels.push_back({x, line.y});
  });
  return pixels;
}

/// Inside as seen from the centre, moved right by an infinitely small step and down by a smaller
/// one: a crossing of the ray to the left counts where it lies left of the centre or at it.
bool is_inside(const std::vector<Corners>& rings, FillRule rule, const Pixel& p) {
  const Exact x = centre_of<Exact>(p.x), y = centre_of<Exact>(p.y);
  int count = 0, winding = 0;
  for (const Corners& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const auto [ax, ay] = ring[i];
      const auto [bx, by] = ring[(i + 1) % ring.size()];
      const bool a_above = Exact(ay) <= y, b_above = Exact(by) <= y;
      if (a_above == b_above) continue;
      const Exact crossing =
          Exact(ax) + (y - Exact(ay)) * (Exact(bx) - Exact(ax)) / (Exact(by) - Exact(ay));
      if (crossing > x) continue;
      ++count;
      winding += a_above ? 1 : -1;
    }
  }
  return rule == FillRule::even_odd ? count % 2 != 0 : winding != 0;
}

std::vector<Pixel> filled_by_rays(const std::vector<Corners>& rings, FillRule rule) {
  std::vector<Pixel> pixels;
  for (std::int64_t y = -2; y < 18; ++y)
    for (std::int64_t x = -2; x < 18; ++x)
      if (is_inside(rings, rule, {x, y})) pixels.push_back({x, y});
  return pixels;
}

TEST(PolygonFill, RandomPolygonsAreWhatRaysSay) {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> quarters(0, 64), corners(3, 9);
  for (int i = 0; i < 500 / checks::effort; ++i) {
    std::vector<Corners> rings(1 + i % 2);
    for (Corners& ring : rings)
      for (int k = corners(random); k > 0; --k)
        ring.push_back({quarters(random) / 4.0, quarters(random) / 4.0});
    for (const FillRule rule : {FillRule::even_odd, FillRule::non_zero})
      ASSERT_EQ(filled<Exact>(rings, rule), filled_by_rays(rings, rule)) << "case " << i;
  }
}

TEST(PolygonFill, HalfOpenBothWaysSoThatLengthsAreKept) {
  // 4 × 3 pixels exactly, corners at centres: left and top belong to it, right and bottom do not.
  const std::vector<Corners> box{{{1.5, 1.5}, {5.5, 1.5}, {5.5, 4.5}, {1.5, 4.5}}};
  const std::vector<Pixel> pixels = filled<Exact>(box, FillRule::even_odd);
  EXPECT_EQ(pixels.size(), 12u);
  EXPECT_EQ(pixels.front(), (Pixel{1, 1}));
  EXPECT_EQ(pixels.back(), (Pixel{4, 3}));
}

/// The crossings of the scan lines of an outline, by row.
std::map<std::int64_t, std::size_t> crossings_of(const Corners& ring) {
  FillPolygon<Exact> polygon(1);
  for (const auto& [x, y] : ring) polygon[0].push_back({Exact(x), Exact(y), {}});
  std::map<std::int64_t, std::size_t> counts;
  fill_polygon<Exact>(polygon, FillRule::even_odd, {},
                      [&](const auto& line) { counts[line.y] = line.crossings.size(); });
  return counts;
}

TEST(PolygonFill, ExtremaCountTwiceAtTheTopAndNotAtTheBottom) {
  // An M with y down: tops at row 0 (x 1 and 9), the inner corner at row 4, the foot at row 8; all
  // corners lie on scan lines.
  const auto counts = crossings_of({{1.5, 0.5}, {5.5, 4.5}, {9.5, 0.5}, {10.5, 8.5}, {0.5, 8.5}});
  EXPECT_EQ(counts.at(0), 4u);  // two local tops, each twice
  EXPECT_EQ(counts.at(3), 4u);
  EXPECT_EQ(counts.at(4), 2u);  // the inner corner is the bottom of both its edges: not at all
  EXPECT_EQ(counts.at(7), 2u);
  EXPECT_EQ(counts.count(8), 0u);  // the bottom, horizontal: not at all
}

TEST(PolygonFill, OverlapOfTwoWindingsByRule) {
  // A square drawn twice around: empty by even-odd, full by non-zero.
  const Corners twice{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {4, 0}, {4, 4}, {0, 4}};
  EXPECT_TRUE(filled<Exact>({twice}, FillRule::even_odd).empty());
  EXPECT_EQ(filled<Exact>({twice}, FillRule::non_zero).size(), 16u);
}

TEST(PolygonFill, WindowLimitsWithoutChanging) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> quarters(0, 64);
  const PixelWindow window{3, 5, 11, 12};
  for (int i = 0; i < 300 / checks::effort; ++i) {
    std::vector<Corners> rings(1);
    for (int k = 0; k < 6; ++k)
      rings[0].push_back({quarters(random) / 4.0, quarters(random) / 4.0});
    auto expected = filled<Exact>(rings, FillRule::even_odd);
    std::erase_if(expected, [&](const Pixel& p) { return !window.contains(p); });
    ASSERT_EQ(filled<Exact>(rings, FillRule::even_odd, window), expected);
  }
}

/// R at each pixel of a quadrangle whose corners carry R.
std::map<Pixel, Exact> interpolated(const Corners& ring, const std::vector<int>& R) {
  FillPolygon<Exact> polygon(1);
  for (std::size_t i = 0; i < ring.size(); ++i)
    polygon[0].push_back({Exact(ring[i].first), Exact(ring[i].second), {Exact(R[i])}});
  std::map<Pixel, Exact> values;
  fill_polygon<Exact>(polygon, FillRule::even_odd, {}, [&](const auto& line) {
    for (const auto& span : line.spans) {
      const auto along = values_along(span);
      for (std::size_t k = 0; k < along.size(); ++k)
        values[{span.pixels.x_begin + static_cast<std::int64_t>(k), line.y}] = along[k][0];
    }
  });
  return values;
}

TEST(PolygonFill, TwoStepInterpolationOfAQuadrangleDependsOnItsRotation) {
  // A square with R = 0, 1, 0, 0 at its corners, and the same turned by 45 degrees about its
  // centre. The centre gets 1/4 from the upright square, halfway between 0 and the middle of the
  // edge; from the turned one, whose scan line runs through two corners, what these two say.
  const auto upright = interpolated({{1, 1}, {6, 1}, {6, 6}, {1, 6}}, {0, 1, 0, 0});
  const auto turned = interpolated({{3.5, 0.5}, {6.5, 3.5}, {3.5, 6.5}, {0.5, 3.5}}, {0, 1, 0, 0});
  EXPECT_EQ(upright.at({3, 3}), Exact(1) / Exact(4));
  EXPECT_EQ(turned.at({3, 3}), Exact(1) / Exact(2));
}

std::set<Pixel> flooded_by_definition(const CharacterGrid& grid, const Pixel& seed, bool eight) {
  std::set<Pixel> reached{seed};
  for (bool grew = true; grew;) {
    grew = false;
    for (std::int64_t y = 0; y < std::int64_t(grid.size()); ++y) {
      for (std::int64_t x = 0; x < std::int64_t(grid[0].size()); ++x) {
        if (grid[y][x] != grid[seed.y][seed.x] || reached.contains({x, y})) continue;
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx)
            if ((eight || dx == 0 || dy == 0) && reached.contains({x + dx, y + dy}))
              grew = reached.insert({x, y}).second || grew;
      }
    }
  }
  return reached;
}

TEST(FloodFill, ReachesWhatIsConnectedAndNothingElse) {
  std::mt19937 random(8);
  for (int i = 0; i < 300 / checks::effort; ++i) {
    CharacterGrid grid(9, std::string(11, '.'));
    for (auto& row : grid)
      for (char& c : row) c = random() % 5 < 2 ? '#' : '.';
    const Pixel seed{static_cast<std::int64_t>(random() % 11),
                     static_cast<std::int64_t>(random() % 9)};
    for (const bool eight : {false, true}) {
      const auto pixels = flood_fill(grid, seed, eight ? Connectivity::eight : Connectivity::four);
      const auto expected = flooded_by_definition(grid, seed, eight);
      ASSERT_EQ(pixels.size(), expected.size());
      ASSERT_EQ(std::set<Pixel>(pixels.begin(), pixels.end()), expected);
    }
  }
}

TEST(FloodFill, LargePicturesNeedNoDeepStack) {
  // A spiral corridor through 2001 × 2001 pixels: recursion would go a million deep.
  CharacterGrid grid(2001, std::string(2001, '.'));
  for (std::size_t y = 1; y < 2001; y += 2)
    for (std::size_t x = 0; x < 2000; ++x) grid[y][y % 4 == 1 ? x : x + 1] = '#';
  std::size_t open = 0;
  for (const auto& row : grid) open += std::count(row.begin(), row.end(), '.');
  EXPECT_EQ(flood_fill(grid, {0, 0}, Connectivity::four).size(), open);
}

}  // namespace
}  // namespace fathom::pipeline
