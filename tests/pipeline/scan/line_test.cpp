// Lines against the pixel nearest to the exact line, found by search.

#include "fathom/pipeline/scan/line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>

#include "fathom/pipeline/scan/diamond_exit.h"
#include "tests/effort.h"

namespace fathom::pipeline {
namespace {

using Pixels = std::vector<Pixel>;
using ::testing::ElementsAre;

template <class State, class Draw>
Pixels drawn(const Draw& draw, const LineEnds& ends, const PixelWindow& window = {}) {
  Pixels pixels;
  draw(ends, window, [&](const Pixel& p, const State&) { pixels.push_back(p); });
  return pixels;
}

Pixels explicit_exact(const LineEnds& e) {
  return drawn<Exact>(explicit_line<Exact>, e);
}
Pixels dda_exact(const LineEnds& e) {
  return drawn<Exact>(dda_line<Exact>, e);
}
Pixels bresenham(const LineEnds& e) {
  return drawn<std::int64_t>(bresenham_line, e);
}
Pixels midpoint(const LineEnds& e) {
  return drawn<std::int64_t>(midpoint_line, e);
}

/// In each step along the longer axis (x where equal) the pixel whose distance to the line
/// dx·(Y − y0) = dy·(X − x0) is least along the other axis; of two, the larger. By search.
Pixels nearest_pixels(const LineEnds& e) {
  const std::int64_t dx = e.x1 - e.x0, dy = e.y1 - e.y0;
  const bool steep = std::abs(dy) > std::abs(dx);
  const std::int64_t steps = std::max(std::abs(dx), std::abs(dy));
  if (steps == 0) return {{e.x0, e.y0}};
  Pixels result;
  for (std::int64_t k = 0; k <= steps; ++k) {
    Pixel best;
    std::int64_t least = -1;
    for (std::int64_t minor = -70; minor <= 70; ++minor) {
      const Pixel p = steep ? Pixel{e.x0 + minor, e.y0 + (dy > 0 ? k : -k)}
                            : Pixel{e.x0 + (dx > 0 ? k : -k), e.y0 + minor};
      const std::int64_t distance = std::abs(dx * (p.y - e.y0) - dy * (p.x - e.x0));
      if (least >= 0 && distance > least) continue;
      least = distance;
      best = p;
    }
    result.push_back(best);
  }
  return result;
}

TEST(Line, EverySlopeInEveryOctantIsTheNearestPixels) {
  for (std::int64_t dx = -63; dx <= 63; dx += checks::effort > 1 ? 7 : 1) {
    for (std::int64_t dy = -63; dy <= 63; ++dy) {
      const LineEnds ends{5, -3, 5 + dx, -3 + dy};
      const Pixels expected = nearest_pixels(ends);
      ASSERT_EQ(bresenham(ends), expected) << dx << " " << dy;
      ASSERT_EQ(midpoint(ends), expected) << dx << " " << dy;
      ASSERT_EQ(dda_exact(ends), expected) << dx << " " << dy;
      ASSERT_EQ(explicit_exact(ends), expected) << dx << " " << dy;
    }
  }
}

TEST(Line, EndsInAnyOrderGiveTheSamePixels) {
  for (std::int64_t dx = -20; dx <= 20; ++dx) {
    for (std::int64_t dy = -20; dy <= 20; ++dy) {
      Pixels there = bresenham({0, 0, dx, dy}), back = midpoint({dx, dy, 0, 0});
      std::reverse(back.begin(), back.end());
      ASSERT_EQ(there, back) << dx << " " << dy;
    }
  }
}

TEST(Line, KnownLineFromTheOriginToEightThree) {
  const Pixels expected{{0, 0}, {1, 0}, {2, 1}, {3, 1}, {4, 2}, {5, 2}, {6, 2}, {7, 3}, {8, 3}};
  const LineEnds ends{0, 0, 8, 3};
  EXPECT_EQ(explicit_exact(ends), expected);
  EXPECT_EQ(dda_exact(ends), expected);
  EXPECT_EQ(bresenham(ends), expected);
  EXPECT_EQ(midpoint(ends), expected);
  EXPECT_EQ(drawn<float>(dda_line<float>, ends), expected);
  EXPECT_EQ(drawn<double>(explicit_line<double>, ends), expected);
}

/// The textbooks' Bresenham: a minor step where the error is above 0.
Pixels textbook_bresenham(const LineEnds& e) {
  std::int64_t dx = std::abs(e.x1 - e.x0), dy = std::abs(e.y1 - e.y0);
  const int sx = e.x0 < e.x1 ? 1 : -1, sy = e.y0 < e.y1 ? 1 : -1;
  const bool steep = dy > dx;
  if (steep) std::swap(dx, dy);
  Pixels pixels;
  std::int64_t error = 2 * dy - dx;
  Pixel p{e.x0, e.y0};
  for (std::int64_t i = 0; i <= dx; ++i) {
    pixels.push_back(p);
    if (error > 0) {
      (steep ? p.x : p.y) += steep ? sx : sy;
      error -= 2 * dx;
    }
    (steep ? p.y : p.x) += steep ? sy : sx;
    error += 2 * dy;
  }
  return pixels;
}

/// The textbooks' DDA without rounding errors: whole numbers of 1/(2·steps), rounded half to even.
Pixels textbook_dda(const LineEnds& e) {
  const std::int64_t dx = e.x1 - e.x0, dy = e.y1 - e.y0;
  const std::int64_t steps = std::max(std::abs(dx), std::abs(dy));
  const auto rounded = [&](std::int64_t start, std::int64_t d, std::int64_t k) {
    if (steps == 0) return start;
    const std::int64_t whole = (start * steps + d * k),
                       below = whole >= 0 ? whole / steps : -((-whole + steps - 1) / steps);
    const std::int64_t twice = 2 * (whole - below * steps);
    return twice > steps || (twice == steps && below % 2 != 0) ? below + 1 : below;
  };
  Pixels pixels;
  for (std::int64_t k = 0; k <= steps; ++k)
    pixels.push_back({rounded(e.x0, dx, k), rounded(e.y0, dy, k)});
  return pixels;
}

TEST(Line, TheTextbooksTieRules) {
  std::size_t unlike = 0;
  for (std::int64_t dx = -24; dx <= 24; ++dx) {
    for (std::int64_t dy = -24; dy <= 24; ++dy) {
      for (const TieRule ties : {TieRule::stay, TieRule::even}) {
        const LineEnds ends{5, -3, 5 + dx, -3 + dy, ties};
        const Pixels expected =
            ties == TieRule::stay ? textbook_bresenham(ends) : textbook_dda(ends);
        ASSERT_EQ(bresenham(ends), expected) << dx << " " << dy;
        ASSERT_EQ(midpoint(ends), expected) << dx << " " << dy;
        ASSERT_EQ(dda_exact(ends), expected) << dx << " " << dy;
        ASSERT_EQ(explicit_exact(ends), expected) << dx << " " << dy;
        unlike += expected != nearest_pixels(ends);
        // A window shows a part of the same line.
        const PixelWindow window{0, -9, 12, 4};
        Pixels inside = expected;
        std::erase_if(inside, [&](const Pixel& p) { return !window.contains(p); });
        ASSERT_EQ(drawn<std::int64_t>(bresenham_line, ends, window), inside) << dx << " " << dy;
        ASSERT_EQ(drawn<std::int64_t>(midpoint_line, ends, window), inside) << dx << " " << dy;
      }
    }
  }
  EXPECT_GT(unlike, 500u);
  EXPECT_EQ(bresenham({0, 0, 8, 3, TieRule::stay})[4], (Pixel{4, 1}));
  EXPECT_EQ(drawn<double>(dda_line<double>, {0, 0, 4, 2, TieRule::even}),
            (Pixels{{0, 0}, {1, 0}, {2, 1}, {3, 2}, {4, 2}}));
}

TEST(Line, DecisionVariableOfTheMidpointAlgorithm) {
  // d = 2·3 − 8 = −2, then + 6 for east and − 10 for north-east, by hand.
  std::vector<std::int64_t> d;
  midpoint_line({0, 0, 8, 3}, {}, [&](const Pixel&, std::int64_t state) { d.push_back(state); });
  EXPECT_THAT(d, ElementsAre(-2, 4, -6, 0, -10, -4, 2, -8, -2));
}

TEST(Line, BinaryFloatingPointDiffersAtTiesAndByDriftOnly) {
  // In binary64 the explicit line within the window differs from the exact one where it is a tie.
  for (std::int64_t dx = 1; dx <= 63; ++dx) {
    for (std::int64_t dy = -dx; dy <= dx; ++dy) {
      const LineEnds ends{0, 0, dx, dy};
      const Pixels exact = bresenham(ends), rounded = drawn<double>(explicit_line<double>, ends);
      for (std::size_t k = 0; k < exact.size(); ++k) {
        if (exact[k] == rounded[k]) continue;
        const std::int64_t twice = 2 * static_cast<std::int64_t>(k) * std::abs(dy);
        ASSERT_EQ(twice % dx, 0) << "no tie: " << dx << " " << dy << " at " << k;
        ASSERT_EQ(twice / dx % 2, 1);
      }
    }
  }
}

TEST(Line, LinesOfFourThousandMillionPixelsDoNotOverflow) {
  constexpr std::int64_t far = std::int64_t{1} << 31;
  const PixelWindow middle{-3, -3, 4, 4};
  const LineEnds diagonal{-far, -far, far, far};
  const Pixels expected{{-3, -3}, {-2, -2}, {-1, -1}, {0, 0}, {1, 1}, {2, 2}, {3, 3}};
  EXPECT_EQ(drawn<std::int64_t>(bresenham_line, diagonal, middle), expected);
  EXPECT_EQ(drawn<std::int64_t>(midpoint_line, diagonal, middle), expected);
  EXPECT_EQ(drawn<Exact>(dda_line<Exact>, diagonal, middle), expected);
  EXPECT_EQ(drawn<Exact>(explicit_line<Exact>, diagonal, middle), expected);
  // y = (x + 2³¹)(2³² − 1)/2³² − 2³¹: just below y = x, by 1/2 and 2⁻³²·x at x: a tie at 0 alone,
  // where the larger one is 0; nearest is x − 1 for x > 0.
  const LineEnds just_below{-far, -far, far, far - 1};
  const Pixels below{{-3, -3}, {-2, -2}, {-1, -1}, {0, 0}, {1, 0}, {2, 1}, {3, 2}};
  EXPECT_EQ(drawn<std::int64_t>(bresenham_line, just_below, middle), below);
  EXPECT_EQ(drawn<std::int64_t>(midpoint_line, just_below, middle), below);
  EXPECT_EQ(drawn<Exact>(explicit_line<Exact>, just_below, middle), below);
}

TEST(Line, PixelsDoNotDependOnTheWindow) {
  std::mt19937 random(7);
  std::uniform_int_distribution<std::int64_t> coordinate(-100, 100);
  for (int i = 0; i < 2000 / checks::effort; ++i) {
    const LineEnds ends{coordinate(random), coordinate(random), coordinate(random),
                        coordinate(random)};
    const PixelWindow window{-20, -30, 25, 10};
    Pixels expected = bresenham(ends);
    std::erase_if(expected, [&](const Pixel& p) { return !window.contains(p); });
    ASSERT_EQ(drawn<std::int64_t>(bresenham_line, ends, window), expected);
    ASSERT_EQ(drawn<std::int64_t>(midpoint_line, ends, window), expected);
    ASSERT_EQ(drawn<Exact>(dda_line<Exact>, ends, window), expected);
  }
}

template <class Number>
Pixels diamond(Number x0, Number y0, Number x1, Number y1) {
  Pixels pixels;
  diamond_exit_line<Number>({x0, y0, x1, y1}, {}, [&](const Pixel& p) { pixels.push_back(p); });
  return pixels;
}

TEST(DiamondExit, DrawsWhatIsLeft) {
  const Exact h = Exact(1) / Exact(2);
  // From centre to centre: the last pixel's diamond is entered, never left.
  EXPECT_EQ(diamond<Exact>(h, h, Exact(4) + h, h), (Pixels{{0, 0}, {1, 0}, {2, 0}, {3, 0}}));
  EXPECT_EQ(diamond<Exact>(Exact(4) + h, h, h, h), (Pixels{{4, 0}, {3, 0}, {2, 0}, {1, 0}}));
  EXPECT_EQ(diamond<Exact>(h, h, h, Exact(3) + h), (Pixels{{0, 0}, {0, 1}, {0, 2}}));
  // Inside one diamond: nothing.
  EXPECT_TRUE(diamond<Exact>(h, h, h + h / Exact(4), h).empty());
  EXPECT_TRUE(diamond<Exact>(h, h, h, h).empty());
}

TEST(DiamondExit, PassagesBeginAndEndAtTheSides) {
  const Exact h = Exact(1) / Exact(2);
  std::vector<std::pair<Exact, Exact>> passages;
  diamond_exit_passages<Exact>({h, h, Exact(4) + h, h}, {}, [&](const auto& passage) {
    passages.emplace_back(passage.enters, passage.leaves);
  });
  // The diamonds of a row touch in points: each is entered where the one before it is left.
  const auto eighths = [](int i) { return Exact(i) / Exact(8); };
  EXPECT_EQ(passages, (std::vector<std::pair<Exact, Exact>>{{eighths(0), eighths(1)},
                                                            {eighths(1), eighths(3)},
                                                            {eighths(3), eighths(5)},
                                                            {eighths(5), eighths(7)}}));
}

/// The perturbation with a small number in the place of the infinitely small one: ends on a grid of
/// 1/8, so that 2⁻²⁰ and 2⁻⁴⁰ decide what ε and ε² do; the segment is cut at the diamond's sides.
Pixels diamond_by_cutting(double x0, double y0, double x1, double y1) {
  const Exact e = Exact(std::ldexp(1.0, -20)), e2 = e * e;
  const Exact ax = Exact(x0) - e, ay = Exact(y0) - e2, dx(x1 - x0), dy(y1 - y0);
  Pixels result;
  for (std::int64_t y = -2; y < 10; ++y) {
    for (std::int64_t x = -2; x < 10; ++x) {
      Exact enter(0), leave(1);
      bool out = false, end_inside = true;
      for (const int s : {1, -1}) {
        for (const int t : {1, -1}) {
          // s·(x − xc) + t·(y − yc) < ½
          const Exact at_0 = Exact(s) * (ax - centre_of<Exact>(x)) +
                             Exact(t) * (ay - centre_of<Exact>(y)) - Exact(1) / Exact(2);
          const Exact slope = Exact(s) * dx + Exact(t) * dy;
          if (at_0 + slope >= 0) end_inside = false;
          if (slope == 0) {
            out = out || at_0 >= 0;
          } else if (slope > 0) {
            leave = std::min(leave, Exact(-at_0 / slope));
          } else {
            enter = std::max(enter, Exact(-at_0 / slope));
          }
        }
      }
      if (!out && enter < leave && !end_inside) result.push_back({x, y});
    }
  }
  return result;
}

TEST(DiamondExit, AgreesWithCuttingAtTheSides) {
  std::mt19937 random(11);
  std::uniform_int_distribution<int> eighths(0, 64);
  for (int i = 0; i < 1000 / checks::effort; ++i) {
    const double x0 = eighths(random) / 8.0, y0 = eighths(random) / 8.0;
    const double x1 = eighths(random) / 8.0, y1 = eighths(random) / 8.0;
    Pixels pixels = diamond<Exact>(Exact(x0), Exact(y0), Exact(x1), Exact(y1));
    Pixels expected = diamond_by_cutting(x0, y0, x1, y1);
    std::sort(pixels.begin(), pixels.end());
    std::sort(expected.begin(), expected.end());
    ASSERT_EQ(pixels, expected) << x0 << " " << y0 << " " << x1 << " " << y1;
  }
}

TEST(DiamondExit, JoinedSegmentsDrawNoPixelTwice) {
  std::mt19937 random(12);
  std::uniform_int_distribution<int> eighths(0, 160);
  for (int i = 0; i < 300 / checks::effort; ++i) {
    // A segment cut anywhere draws what it draws whole.
    const Exact x0(eighths(random)), y0(eighths(random)), x1(eighths(random)), y1(eighths(random));
    const Exact t = Exact(eighths(random)) / Exact(160), eighth = Exact(1) / Exact(8);
    const Exact mx = x0 + t * (x1 - x0), my = y0 + t * (y1 - y0);
    Pixels whole = diamond<Exact>(x0 * eighth, y0 * eighth, x1 * eighth, y1 * eighth);
    Pixels first = diamond<Exact>(x0 * eighth, y0 * eighth, mx * eighth, my * eighth);
    const Pixels second = diamond<Exact>(mx * eighth, my * eighth, x1 * eighth, y1 * eighth);
    first.insert(first.end(), second.begin(), second.end());
    ASSERT_EQ(first, whole);
  }
}

}  // namespace
}  // namespace fathom::pipeline
