// Cohen–Sutherland and Liang–Barsky against each other and against an answer of its own kind.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "fathom/clipping/cohen_sutherland.h"
#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/liang_barsky.h"
#include "fathom/failures/errors.h"
#include "tests/effort.h"

namespace fathom::clipping::test {
namespace {

template <class Number>
using Part = std::optional<Segment2<Number>>;

template <class Number>
bool same(const Part<Number>& a, const Part<Number>& b) {
  return a.has_value() == b.has_value() && (!a || (a->start == b->start && a->end == b->end));
}

std::string to_text(const Segment2<Rational>& s) {
  return "(" + to_fraction(s.start.x) + ", " + to_fraction(s.start.y) + ")-(" +
         to_fraction(s.end.x) + ", " + to_fraction(s.end.y) + ")";
}
std::string to_text(const Part<Rational>& part) {
  return part ? to_text(*part) : "nothing";
}

/// Every parameter at which the segment could enter or leave is tried; the inside is convex, so the
/// part is what lies between the least and the greatest that are inside.
Part<Rational> by_trial(const Segment2<Rational>& s, const Window<Rational>& w) {
  std::vector<Rational> candidates{0, 1};
  for (const auto& [from, to, edges] : {std::tuple{s.start.x, s.end.x, std::pair{w.xmin, w.xmax}},
                                        std::tuple{s.start.y, s.end.y, std::pair{w.ymin, w.ymax}}})
    if (from != to)
      for (const Rational& edge : {edges.first, edges.second})
        candidates.push_back((edge - from) / (to - from));
  std::erase_if(candidates, [&](const Rational& t) {
    const Point2<Rational> p = interpolate(s.start, s.end, t);
    return t < 0 || t > 1 || p.x < w.xmin || p.x > w.xmax || p.y < w.ymin || p.y > w.ymax;
  });
  if (candidates.empty()) return std::nullopt;
  const auto [first, last] = std::minmax_element(candidates.begin(), candidates.end());
  return Segment2<Rational>{interpolate(s.start, s.end, *first),
                            interpolate(s.start, s.end, *last)};
}

void expect_all_agree(const Segment2<Rational>& s, const Window<Rational>& w) {
  const auto truth = by_trial(s, w);
  const auto cohen = cohen_sutherland(s, w), liang = liang_barsky(s, w);
  ASSERT_TRUE(same(cohen, truth)) << to_text(s) << ": " << to_text(cohen) << ", not "
                                  << to_text(truth);
  ASSERT_TRUE(same(liang, truth)) << to_text(s) << ": " << to_text(liang) << ", not "
                                  << to_text(truth);
}

// All octants, edges, corners and points: end points on a grid that goes beyond the window.
class OnAGrid : public ::testing::TestWithParam<Window<int>> {};

TEST_P(OnAGrid, BothAgreeWithTrial) {
  const auto [xmin, ymin, xmax, ymax] = GetParam();
  const Window<Rational> window{xmin, ymin, xmax, ymax};
  int visible = 0, points = 0;
  for (int code = 0; code < 7 * 7 * 7 * 7; ++code) {
    const auto digit = [&](int place) { return code / place % 7 - 1; };
    const Segment2<Rational> s{{digit(1), digit(7)}, {digit(49), digit(343)}};
    ASSERT_NO_FATAL_FAILURE(expect_all_agree(s, window));
    const auto part = liang_barsky(s, window);
    visible += part ? 1 : 0;
    points += part && part->start == part->end ? 1 : 0;
  }
  EXPECT_GT(visible, 100);
  EXPECT_GT(points, 10);  // end points, points in, and corners touched
}

INSTANTIATE_TEST_SUITE_P(Windows, OnAGrid,
                         ::testing::Values(Window<int>{1, 1, 3, 3}, Window<int>{0, 1, 4, 2},
                                           Window<int>{2, 0, 2, 4}, Window<int>{2, 2, 2, 2}));

TEST(LineClipping, AgreesFarFromEveryGrid) {
  std::mt19937_64 random(11);
  const auto number = [&]() -> double {
    const int power = static_cast<int>(random() % 400) - 200;
    return std::ldexp(static_cast<double>(static_cast<std::int64_t>(random())), power);
  };
  for (int i = 0; i < 2000 / checks::effort; ++i) {
    const double x0 = number(), x1 = number(), y0 = number(), y1 = number();
    const Segment2<Rational> s{{number(), number()}, {number(), number()}};
    ASSERT_NO_FATAL_FAILURE(expect_all_agree(
        s, {std::min(x0, x1), std::min(y0, y1), std::max(x0, x1), std::max(y0, y1)}));
  }
}

TEST(LineClipping, BinaryFractionsAreClippedExactlyInBinary64Too) {
  // Every quotient is a multiple of a quarter, so nothing is rounded.
  const Window<double> window{0, 0, 2, 2};
  const Window<Rational> exact_window{0, 0, 2, 2};
  for (int x = -4; x <= 4; ++x)
    for (int y = -4; y <= 4; ++y)
      for (int dx : {-4, 0, 4})
        for (int dy : {-4, 0, 4}) {
          const Segment2<double> s{{double(x), double(y)}, {double(x + dx), double(y + dy)}};
          const auto truth = by_trial({{x, y}, {x + dx, y + dy}}, exact_window);
          for (const auto& part : {cohen_sutherland(s, window), liang_barsky(s, window)}) {
            ASSERT_EQ(part.has_value(), truth.has_value())
                << x << " " << y << " " << dx << " " << dy;
            if (part) {
              EXPECT_TRUE(Rational(part->start.x) == truth->start.x &&
                          Rational(part->start.y) == truth->start.y &&
                          Rational(part->end.x) == truth->end.x &&
                          Rational(part->end.y) == truth->end.y);
            }
          }
        }
}

TEST(LineClipping, CohenSutherlandInBinary64EndsInsideTheWindow) {
  // Whatever was rounded: what is accepted has the outcode 0 at both ends.
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> number(-3, 3);
  const Window<double> window{-1, -1, 1, 1};
  int accepted = 0;
  for (int i = 0; i < 20000 / checks::effort; ++i) {
    const Segment2<double> s{{number(random), number(random)}, {number(random), number(random)}};
    const auto part = cohen_sutherland(s, window);
    if (!part) continue;
    ++accepted;
    EXPECT_EQ(outcode_of(part->start, window), outcode::inside);
    EXPECT_EQ(outcode_of(part->end, window), outcode::inside);
  }
  EXPECT_GT(accepted, 1000 / checks::effort);
}

TEST(CohenSutherland, OutcodesOfTheNineRegions) {
  const Window<double> window{0, 0, 1, 1};
  const char* expected[3][3] = {
      {"0101", "0100", "0110"}, {"0001", "0000", "0010"}, {"1001", "1000", "1010"}};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      EXPECT_EQ(to_bits(outcode_of(Point2<double>{column - 0.5, row - 0.5}, window)),
                expected[row][column]);
  EXPECT_EQ(to_bits(outcode_of(Point2<double>{0, 1}, window)), "0000");  // the border is inside
}

TEST(CohenSutherland, EachOfTheFourTests) {
  const Window<Rational> window{0, 0, 4, 4};
  const auto first_test = [&](const Segment2<Rational>& s) {
    std::vector<CohenSutherlandStep<Rational>> trace;
    cohen_sutherland(s, window, &trace);
    return trace.front().test;
  };
  EXPECT_EQ(first_test({{1, 1}, {3, 2}}), 1);
  EXPECT_EQ(first_test({{-1, 1}, {-2, 9}}), 2);
  EXPECT_EQ(first_test({{-1, 1}, {2, 2}}), 3);
  EXPECT_EQ(first_test({{2, 2}, {9, 2}}), 3);
  EXPECT_EQ(first_test({{-2, 2}, {2, 6}}), 4);
}

// The lecture's segment D: E1 is left, E2 is top. After the split E3 & E2 = 1000 ≠ 0, which is the
// second test, not the fourth: the fourth needs both codes other than 0 and their AND to be 0.
TEST(CohenSutherland, SplitSegmentIsRejectedByTheSecondTest) {
  std::vector<CohenSutherlandStep<Rational>> trace;
  EXPECT_FALSE(cohen_sutherland<Rational>({{-2, 3}, {2, 9}}, {0, 0, 4, 4}, &trace));
  ASSERT_EQ(trace.size(), 2u);
  EXPECT_EQ(to_bits(trace[0].E1), "0001");
  EXPECT_EQ(to_bits(trace[0].E2), "1000");
  EXPECT_EQ(trace[0].test, 4);
  EXPECT_EQ(trace[0].edge, outcode::left);
  EXPECT_EQ(trace[0].moved, 1);
  EXPECT_EQ(to_bits(trace[1].E1), "1000");
  EXPECT_TRUE(trace[1].segment.start == (Point2<Rational>{0, 6}));
  EXPECT_EQ(trace[1].test, 2);
}

std::string order_of(const Segment2<Rational>& s, const Window<Rational>& window) {
  LiangBarskyTrace<Rational> trace;
  liang_barsky(s, window, &trace);
  std::string order;
  for (const auto& parameter : trace.parameters) {
    order += "?LRBT"[parameter.k];
    order += "+-=#"[static_cast<int>(parameter.crossing)];
  }
  return order;
}

// The lecture's two orders: both entered before any is left, and left before both are entered.
TEST(LiangBarsky, OrderOfTheParametersDecides) {
  const Window<Rational> window{0, 0, 4, 4};
  EXPECT_EQ(order_of({{-2, -1}, {6, 5}}, window), "B+L+R-T-");
  EXPECT_TRUE(liang_barsky<Rational>({{-2, -1}, {6, 5}}, window));
  EXPECT_EQ(order_of({{-1, 2}, {6, 9}}, window), "B+L+T-R-");
  EXPECT_EQ(order_of({{-4, 2}, {6, 7}}, window), "B+L+T-R-");
  EXPECT_EQ(order_of({{-4, 3}, {6, 8}}, window), "B+T-L+R-");
  EXPECT_FALSE(liang_barsky<Rational>({{-4, 3}, {6, 8}}, window));
}

TEST(LiangBarsky, ParallelsAndTheCornerThatIsTouched) {
  const Window<Rational> window{0, 0, 4, 4};
  EXPECT_EQ(order_of({{-1, 2}, {6, 2}}, window), "L+R-B=T=");
  EXPECT_EQ(order_of({{-1, 4}, {6, 4}}, window), "L+R-B=T=");
  EXPECT_EQ(order_of({{-1, 5}, {6, 5}}, window), "L+R-B=T#");
  EXPECT_EQ(order_of({{2, 2}, {2, 2}}, window), "L=R=B=T=");
  LiangBarskyTrace<Rational> trace;
  const auto corner = liang_barsky<Rational>({{-1, 3}, {1, 5}}, window, &trace);
  ASSERT_TRUE(corner);
  EXPECT_TRUE(corner->start == (Point2<Rational>{0, 4}) && corner->start == corner->end);
  EXPECT_TRUE(trace.t_entering == trace.t_leaving);
}

TEST(LineClipping, AWindowInsideOutIsRefused) {
  const Segment2<Rational> s{{0, 0}, {1, 1}};
  EXPECT_THROW(cohen_sutherland<Rational>(s, {1, 0, 0, 1}), InputError);
  EXPECT_THROW(liang_barsky<Rational>(s, {0, 1, 1, 0}), InputError);
}

TEST(LineClipping, TheTraceSaysWhichEndIsMoved) {
  const Window<Rational> window{0, 0, 2, 2};
  const auto moved = [&](const Segment2<Rational>& s) {
    std::vector<CohenSutherlandStep<Rational>> trace;
    cohen_sutherland(s, window, &trace);
    return trace.at(0).moved;
  };
  EXPECT_EQ(moved({{1, 1}, {5, 1}}), 2);
  EXPECT_EQ(moved({{5, 1}, {1, 1}}), 1);
  EXPECT_EQ(moved({{-1, 1}, {5, 1}}), 1);
}

TEST(LineClipping, AParallelLineHasNoParameter) {
  const auto parallel = against_boundary<Rational>(3, 0, 5);
  EXPECT_EQ(parallel.t, 0);
  EXPECT_EQ(parallel.crossing, Crossing::parallel_inside);
}

}  // namespace
}  // namespace fathom::clipping::test
