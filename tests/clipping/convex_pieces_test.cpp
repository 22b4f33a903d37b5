#include <gtest/gtest.h>

#include <algorithm>

#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/rings.h"
#include "fathom/clipping/sutherland_hodgman.h"
#include "fathom/clipping/weiler_atherton.h"
#include "tests/clipping/print.h"
#include "tests/clipping/random_polygons.h"
#include "tests/effort.h"

namespace fathom::clipping::test {
namespace {

TEST(ConvexPieces, AConvexRingStaysWhole) {
  const Ring<Rational> square{{0, 0}, {2, 0}, {4, 0}, {4, 4}, {0, 4}};
  const auto pieces = convex_pieces(square);
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_EQ(canonical(pieces[0]), canonical(square));
}

TEST(ConvexPieces, AnLIsTwoWhicheverCornerComesFirst) {
  const Ring<Rational> upper{{0, 0}, {1, 1}, {1, 4}, {0, 4}}, lower{{0, 0}, {4, 0}, {4, 1}, {1, 1}};
  Ring<Rational> ell{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}};
  for (int i = 0; i < 6; ++i) {
    Rings<Rational> pieces = convex_pieces(ell);
    for (Ring<Rational>& piece : pieces) piece = canonical(piece);
    std::sort(pieces.begin(), pieces.end());
    EXPECT_EQ(pieces, (Rings<Rational>{upper, lower}));
    std::rotate(ell.begin(), ell.begin() + 1, ell.end());
  }
}

// Convex pieces whose areas add up to the ring's and each of which lies in it: they overlap
// nowhere.
TEST(ConvexPieces, OfRandomRingsAreConvexAndFillThem) {
  PolygonMaker maker(51);
  std::size_t most = 0;
  for (int i = 0; i < 1500 / checks::effort; ++i) {
    const Ring<Rational> ring = checked_rings(
        to_exact(maker.polygon(7, 14, [](const auto&) { return true; })), "random")[0];
    const auto pieces = convex_pieces(ring);
    Rational area(0);
    for (const Ring<Rational>& piece : pieces) {
      ASSERT_NO_THROW(check_convex(piece, "piece"));
      ASSERT_GT(signed_area(piece), 0);
      ASSERT_TRUE(weiler_atherton<Rational>({piece}, {ring}, SetOperation::difference).empty());
      area += signed_area(piece);
    }
    ASSERT_EQ(area, signed_area(ring));
    most = std::max(most, pieces.size());
  }
  EXPECT_GE(most, 4u);
}

// Clipped piece by piece, a concave polygon has no bridging edges: every ring is simple, and
// together they are Weiler–Atherton's answer.
TEST(ConvexPieces, CureSutherlandHodgman) {
  PolygonMaker maker(52);
  const Ring<Rational> window{{2, 1}, {5, 1}, {5, 5}, {2, 5}};
  for (int i = 0; i < 500 / checks::effort; ++i) {
    const Ring<Rational> ring = checked_rings(
        to_exact(maker.polygon(7, 14, [](const auto&) { return true; })), "random")[0];
    Rings<Rational> clipped;
    for (const Ring<Rational>& piece : convex_pieces(ring)) {
      const auto corners = sutherland_hodgman(corners_of(piece), window);
      if (!corners.empty()) clipped.push_back(ring_of(corners));
    }
    // Rings of one side that overlapped would be refused as crossing, or cancel and change the
    // area.
    const auto whole = weiler_atherton<Rational>({ring}, {window}, SetOperation::intersection);
    ASSERT_EQ(signed_area(clipped), area_of(whole));
    const auto joined = weiler_atherton<Rational>(clipped, {}, SetOperation::difference);
    ASSERT_EQ(joined.size(), whole.size());
    for (std::size_t k = 0; k < joined.size(); ++k) EXPECT_EQ(joined[k].outline, whole[k].outline);
  }
}

}  // namespace
}  // namespace fathom::clipping::test
