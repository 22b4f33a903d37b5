#include "fathom/pipeline/output/fxaa.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fathom/failures/errors.h"
#include "tests/pipeline/published_fxaa.h"

namespace fathom::pipeline {
namespace {

ColourImage grey(std::uint32_t width, std::uint32_t height, const auto& value) {
  ColourImage image{width, height, {}};
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      const double c = value(x, y);
      image.pixels.push_back({c, c, c});
    }
  }
  return image;
}

/// Without an edge nothing changes; across a step the pixels beside it are mixed, and no colour
/// leaves the range of what was there.
TEST(Fxaa, BlursEdgesAlone) {
  ColourImage flat{5, 4, std::vector<Colour>(20, Colour{0.25, 0.5, 0.75})};
  EXPECT_EQ(fxaa(flat).pixels, flat.pixels);
  ColourImage stairs{16, 16, std::vector<Colour>(256)};
  for (std::uint32_t y = 0; y < 16; ++y) {
    for (std::uint32_t x = 0; x < 16; ++x) {
      const double c = x > y ? 1 : 0;
      stairs.pixels[std::size_t{y} * 16 + x] = {c, c, c};
    }
  }
  const ColourImage smooth = fxaa(stairs);
  int changed = 0;
  for (std::uint32_t y = 0; y < 16; ++y) {
    for (std::uint32_t x = 0; x < 16; ++x) {
      const double value = smooth.at(x, y)[0];
      EXPECT_GE(value, -1e-15);
      EXPECT_LE(value, 1 + 1e-15);
      const std::uint32_t away = x > y ? x - y : y - x;
      if (away > 6) {
        EXPECT_EQ(value, stairs.at(x, y)[0]) << x << ' ' << y;
      }
      changed += value != stairs.at(x, y)[0];
    }
  }
  EXPECT_GT(changed, 16);
}

/// Below an edge that falls by a pixel every eight columns, at x = 4, 12, 20, …: black above, white
/// below. The edge that it stands for passes through the middles of the steps.
ColourImage stairs_of_eight() {
  return grey(64, 24,
              [](std::uint32_t x, std::uint32_t y) { return y >= 8 + (x + 4) / 8 ? 1 : 0; });
}

/// What the published search gives, worked out by hand: a run of eight pixels, k = 0 … 7 from the
/// step at its left end. The right end is found at the first pixel beyond, 8 − k to the right,
/// since the steps 1, 1, 1, 1, 1, 1.5, 2 stop at sums of 1, 2, 3, 4, 5, 6.5, 8.5, …
double distance_found(int away) {
  // Between columns luma is interpolated: at 6.5 the column beyond counts half, and a half of the
  // change across the step is above the limit of a quarter.
  const double sums[] = {1, 2, 3, 4, 5, 6.5, 8.5};
  for (const double d : sums) {
    if (d >= away || away - d <= 0.5) return d;
  }
  return 0;
}

TEST(Fxaa, FindsTheEndsOfAnEdgeAndMixesByTheirDistance) {
  const ColourImage stairs = stairs_of_eight();
  const ColourImage smooth = fxaa(stairs, {0.166, 0.0833, 0});
  // The white pixels of the row that begins at the step of x = 20, and the black ones above them.
  const std::uint32_t row = 8 + (20 + 4) / 8;
  for (int k = 0; k < 8; ++k) {
    const double left = distance_found(k + 1), right = distance_found(8 - k);
    const double share = 0.5 - std::min(left, right) / (left + right);
    const auto x = static_cast<std::uint32_t>(20 + k);
    // White gives way to black where the edge falls towards it, and black to white at the other
    // end.
    const double white = smooth.at(x, row)[0], black = smooth.at(x, row - 1)[0];
    EXPECT_NEAR(1 - white, left > right ? share : 0, 1e-12) << k;
    EXPECT_NEAR(black, left < right ? share : 0, 1e-12) << k;
  }
}

/// The line through the middles of the steps covers known parts of the pixels: the trapezoids of
/// y = 8 + x/8 + …; FXAA comes nearer to them than no filter by a factor of more than three.
TEST(Fxaa, ComesNearTheAreaOfASlantedEdge) {
  const ColourImage stairs = stairs_of_eight();
  const auto covered = [](std::uint32_t x, std::uint32_t y) {
    // White below the line y = 8 + x/8: its mean height over column x is 8 + (x + ½)/8, and no
    // column is crossed by the border of two rows but at its ends.
    return std::clamp(y + 1 - (8 + (x + 0.5) / 8), 0.0, 1.0);
  };
  const auto error = [&](const ColourImage& image) {
    double sum = 0;
    for (std::uint32_t y = 4; y < 20; ++y)
      for (std::uint32_t x = 12; x < 52; ++x) sum += std::abs(image.at(x, y)[0] - covered(x, y));
    return sum;
  };
  EXPECT_LT(error(fxaa(stairs)), error(stairs) / 3);
}

TEST(Fxaa, LeavesWhatIsBelowItsThresholdsAsItIs) {
  const auto step = [](double low, double high) {
    return grey(12, 12, [=](std::uint32_t x, std::uint32_t y) { return x > y ? high : low; });
  };
  // A range of 0.1 of a luma of 1 is below 0.166 of it, and above 0.063 of it.
  const ColourImage bright = step(0.9, 1.0);
  EXPECT_EQ(fxaa(bright).pixels, bright.pixels);
  EXPECT_NE(fxaa(bright, {0.063, 0.0312, 0.75}).pixels, bright.pixels);
  // A range of 0.05 is all of the luma, and below the least that counts.
  const ColourImage dark = step(0, 0.05);
  EXPECT_EQ(fxaa(dark).pixels, dark.pixels);
  EXPECT_NE(fxaa(dark, {0.166, 0.0312, 0.75}).pixels, dark.pixels);
}

/// A white pixel alone on black: mean luma of its neighbours 0, so it sticks out fully, and the
/// setting is the share of its neighbour that is mixed in.
TEST(Fxaa, RemovesDetailsBelowAPixelByTheSettingForThem) {
  const ColourImage dot =
      grey(9, 9, [](std::uint32_t x, std::uint32_t y) { return x == 4 && y == 4; });
  EXPECT_NEAR(fxaa(dot, {0.166, 0.0833, 0.75}).at(4, 4)[0], 0.25, 1e-15);
  EXPECT_NEAR(fxaa(dot, {0.166, 0.0833, 0.5}).at(4, 4)[0], 0.5, 1e-15);
}

/// A stair with runs of any length, up to longer than the search goes, falling or rising, by rows
/// or by columns, in any two colours; or in red and black, whose sums of lumas are exact.
ColourImage any_stair(std::mt19937& random) {
  const bool transposed = random() % 2 == 0, mirrored = random() % 2 == 0;
  const std::uint32_t run = 1 + random() % 40, start = random() % 40;
  const auto part = [&] { return static_cast<double>(random() % 256) / 255; };
  Colour above{part(), part(), part()}, below{part(), part(), part()};
  if (random() % 2 == 0) above = {1, 0, 0}, below = {};
  ColourImage image{48, 48, {}};
  for (std::uint32_t y = 0; y < 48; ++y) {
    for (std::uint32_t x = 0; x < 48; ++x) {
      const std::uint32_t along = transposed ? y : x, across = transposed ? x : y;
      const std::uint32_t level = 20 + ((mirrored ? 47 - along : along) + start) / run % 8;
      image.pixels.push_back(across < level ? above : below);
    }
  }
  return image;
}

ColourImage any_noise(std::mt19937& random) {
  const std::uint32_t levels = 2 + random() % 254, size = 1 + random() % 14;
  ColourImage image{size, 1 + static_cast<std::uint32_t>(random() % 14), {}};
  for (std::uint32_t i = 0; i < image.width * image.height; ++i) {
    Colour colour;
    for (double& c : colour) c = static_cast<double>(random() % levels) / (levels - 1);
    image.pixels.push_back(colour);
  }
  return image;
}

bool is_near(const Colour& a, const Colour& b) {
  double greatest = 0;
  for (std::size_t k = 0; k < 3; ++k) greatest = std::max(greatest, std::abs(a[k] - b[k]));
  return greatest <= 1e-12;  // some twenty roundings of numbers up to 1
}

TEST(Fxaa, IsThePublishedAlgorithm) {
  std::mt19937 random(5);
  std::size_t changed = 0, ties = 0;
  for (int n = 0; n < 600; ++n) {
    SCOPED_TRACE(n);
    const ColourImage image = n % 2 == 0 ? any_stair(random) : any_noise(random);
    const FxaaSettings settings{random() % 3 * 0.15, random() % 3 * 0.05, random() % 3 * 0.5};
    const ColourImage smooth = fxaa(image, settings);
    for (std::uint32_t y = 0; y < image.height; ++y) {
      for (std::uint32_t x = 0; x < image.width; ++x) {
        const auto published = [&](std::optional<bool> horizontal) {
          return published::fxaa_pixel({image}, x, y, settings.threshold, settings.least_threshold,
                                       settings.subpixel, horizontal);
        };
        const auto [colour, more_horizontal] = published({});
        const bool tie = std::abs(more_horizontal) < 1e-12;
        const Colour& ours = smooth.at(x, y);
        ASSERT_TRUE(is_near(ours, colour) || (tie && (is_near(ours, published(true).colour) ||
                                                      is_near(ours, published(false).colour))))
            << x << ' ' << y;
        changed += colour != image.at(x, y) ? 1 : 0;
        ties += tie ? 1 : 0;
      }
    }
  }
  EXPECT_GT(changed, 20000U);
  EXPECT_LT(ties, changed / 10);
}

/// Where luma changes as much from row to row as from column to column, the edge is horizontal.
/// Luma is 0 or 1 here, so that sums have no rounding.
TEST(Fxaa, TakesAnEdgeForHorizontalWhenInDoubt) {
  const Colour red{1 / 0.299, 0, 0};
  ASSERT_EQ(0.299 * red[0], 1);
  std::mt19937 random(6);
  int in_doubt = 0;
  for (int n = 0; n < 500; ++n) {
    ColourImage image{9, 9, std::vector<Colour>(81)};
    for (Colour& pixel : image.pixels) pixel = random() % 2 == 0 ? red : Colour{};
    const auto published = [&](std::optional<bool> horizontal) {
      return published::fxaa_pixel({image}, 4, 4, 0.166, 0.0833, 0.75, horizontal);
    };
    if (published({}).more_horizontal != 0) continue;
    const Colour horizontal = published(true).colour;
    if (is_near(horizontal, published(false).colour)) continue;
    ++in_doubt;
    EXPECT_TRUE(is_near(fxaa(image).at(4, 4), horizontal)) << n;
  }
  EXPECT_GT(in_doubt, 20);
}

TEST(Fxaa, RefusesSettingsThatMeanNothing) {
  for (const FxaaSettings& settings : {FxaaSettings{-0.1, 0.1, 0.5}, FxaaSettings{0.1, 1.5, 0.5},
                                       FxaaSettings{0.1, 0.1, std::nan("")}}) {
    PipelineOptions options;
    options.antialias = {AntialiasMethod::fxaa, 1, false, settings};
    EXPECT_THROW(require_meaningful(options), UsageError);
  }
}

}  // namespace
}  // namespace fathom::pipeline
