#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "fathom/attribution/faults/local_faults.h"
#include "tests/attribution/hand_made.h"

namespace fathom::attribution {
namespace {

/// A wall of 10 × 10 triangles, each of which shows 3 × 3 pixels; those in odd columns run the
/// other way round.
struct Wall {
  Truth truth = test::truth_of(30, 30, [](std::uint32_t, std::uint32_t) { return 2.0; });
  Attribution found = test::all_equal(truth);
  /// What is behind the wall.
  OtherMap other{.width = 30, .height = 30, .depths = std::vector<double>(900, 3.0)};

  Wall() {
    for (std::uint32_t t = 0; t < 100; ++t) {
      const double x = t % 10, y = t / 10;
      const auto first = static_cast<std::uint32_t>(truth.mesh.points.size());
      truth.mesh.points.insert(truth.mesh.points.end(), {{x, y, 2}, {x + 1, y, 2}, {x, y + 1, 2}});
      // x to the right and y down: 0 1 2 is clockwise as it is seen.
      if (faces(t)) {
        truth.mesh.triangles.push_back({first, first + 2, first + 1});
      } else {
        truth.mesh.triangles.push_back({first, first + 1, first + 2});
      }
    }
    for (std::size_t i = 0; i < truth.triangles.size(); ++i) {
      truth.triangles[i] = static_cast<std::uint32_t>(i / 30 / 3 * 10 + i % 30 / 3);
    }
  }
  /// Counter-clockwise as the camera sees it.
  static bool faces(std::uint32_t t) { return t % 2 == 0; }

  void remove(std::uint32_t triangle, std::size_t pixels = 9) {
    for (std::size_t i = 0; i < truth.triangles.size() && pixels > 0; ++i) {
      if (truth.triangles[i] != triangle) continue;
      found.clues.absent[i] = triangle;
      test::set_unexplained(found, i);
      --pixels;
    }
  }
};

TEST(MissingTriangle, IsNamed) {
  Wall wall;
  wall.remove(34);
  const auto findings = triangles_at_fault(wall.truth, wall.other, wall.found);
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].kind, "missing-triangle");
  EXPECT_EQ(findings[0].text, "triangle 34 is missing");
  EXPECT_EQ(findings[0].pixels, 9U);
}

TEST(MissingTriangle, IsSeenNowhere) {
  Wall wall;
  wall.remove(34, 8);  // one pixel shows it
  EXPECT_TRUE(triangles_at_fault(wall.truth, wall.other, wall.found).empty());
}

/// `pixels` of triangle 34 are all that is certain of it.
std::vector<Finding> with_pixels(std::size_t pixels) {
  Wall wall;
  for (std::size_t i = 0; i < wall.truth.triangles.size(); ++i) {
    if (wall.truth.triangles[i] == 34) wall.found.classes[i] = PixelClass::edge;
  }
  wall.remove(34, pixels);
  return triangles_at_fault(wall.truth, wall.other, wall.found);
}

TEST(MissingTriangle, OfTwoPixelsMayBeChance) {
  EXPECT_TRUE(with_pixels(1).empty());
  EXPECT_TRUE(with_pixels(2).empty());
  ASSERT_EQ(with_pixels(3).size(), 1U);
  EXPECT_EQ(with_pixels(3)[0].pixels, 3U);
}

TEST(MissingTriangle, NeighboursOfFewPixelsCountTogether) {
  Wall wall;
  for (std::size_t i = 0; i < wall.truth.triangles.size(); ++i) {
    const std::uint32_t t = wall.truth.triangles[i];
    if (t == 34 || t == 35) wall.found.classes[i] = PixelClass::edge;
  }
  // In the first row of either: the last two pixels of one, the first of the other.
  for (const std::size_t pixel : {9U * 30 + 13, 9U * 30 + 14, 9U * 30 + 15}) {
    wall.found.clues.absent[pixel] = wall.truth.triangles[pixel];
    test::set_unexplained(wall.found, pixel);
  }
  EXPECT_EQ(triangles_at_fault(wall.truth, wall.other, wall.found).size(), 2U);
}

TEST(MissingTriangle, ManyAreNamedTogether) {
  Wall wall;
  for (const std::uint32_t t : {11U, 44U, 46U, 88U}) wall.remove(t);
  const auto findings = triangles_at_fault(wall.truth, wall.other, wall.found);
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].text, "4 triangles are missing: 11, 44, 46, …");
  EXPECT_EQ(findings[0].pixels, 36U);
}

class Culling : public testing::TestWithParam<ProjectionModel> {};

TEST_P(Culling, OfEitherWay) {
  for (const bool facing : {true, false}) {
    Wall wall;
    wall.truth.camera.projection.model = GetParam();
    for (std::uint32_t t = 0; t < 100; ++t) {
      if (Wall::faces(t) == facing) wall.remove(t);
    }
    const auto findings = triangles_at_fault(wall.truth, wall.other, wall.found);
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_EQ(findings[0].kind, "culling");
    EXPECT_EQ(findings[0].pixels, 450U);
    EXPECT_EQ(findings[0].text, facing
                                    ? "triangles that face the camera are missing"
                                    : "triangles that are turned away from the camera are missing");
  }
}

INSTANTIATE_TEST_SUITE_P(All, Culling,
                         testing::Values(ProjectionModel::perspective,
                                         ProjectionModel::orthographic),
                         [](const auto& projection) {
                           return projection.param == ProjectionModel::perspective ? "Perspective"
                                                                                   : "Orthographic";
                         });

TEST(CullingOfSome, IsNone) {
  Wall wall;
  for (std::uint32_t t = 1; t < 60; t += 2) wall.remove(t);
  EXPECT_EQ(triangles_at_fault(wall.truth, wall.other, wall.found)[0].kind, "missing-triangle");
}

// An object that is not drawn at all leaves the background.
TEST(CullingOfSome, ShowsWhatIsBehind) {
  Wall wall;
  wall.other.depths.assign(900, std::numeric_limits<double>::infinity());
  for (std::uint32_t t = 1; t < 100; t += 2) wall.remove(t);
  EXPECT_EQ(triangles_at_fault(wall.truth, wall.other, wall.found)[0].kind, "missing-triangle");
}

TEST(Ties, AreCounted) {
  Wall wall;
  wall.found.clues.wrong_ties = 7;
  const auto findings = triangles_at_fault(wall.truth, wall.other, wall.found);
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].kind, "ties");
  EXPECT_EQ(findings[0].pixels, 7U);
}

TEST(TrianglesAtFault, NoneWhereNoneIs) {
  const Wall wall;
  EXPECT_TRUE(triangles_at_fault(wall.truth, wall.other, wall.found).empty());
}

}  // namespace
}  // namespace fathom::attribution
