// How near triangles can be: the same by vectors of every kind as by one number after the other,
// and never less than the number.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/fast/bins/nearness_test.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include "fathom/fast/bins/nearness-inl.h"

#ifndef FATHOM_TESTS_NEARNESS_LANES
#define FATHOM_TESTS_NEARNESS_LANES
namespace fathom::fast {

/// Numbers, boxes of pixels and the tiles that these lie in, and what vectors make of them.
struct NearnessLanes {
  static constexpr std::size_t count = 8;
  using Numbers = std::array<double, count>;
  alignas(64) Numbers q, left, right, top, bottom, tile_column, tile_row;
  alignas(64) std::array<std::uint64_t, count> moved, nearness;
};

}  // namespace fathom::fast
#endif

HWY_BEFORE_NAMESPACE();
namespace fathom::fast::HWY_NAMESPACE {
namespace {

void find_nearness(NearnessLanes& lanes) {
  const D d;
  const DU du;
  const auto load = [&](const NearnessLanes::Numbers& numbers, std::size_t first)
                        HWY_ATTR { return hn::Load(d, numbers.data() + first); };
  for (std::size_t i = 0; i < NearnessLanes::count; i += hn::Lanes(d)) {
    const auto moved = moved_up_in_24_bits(load(lanes.q, i));
    const Boxes box{load(lanes.left, i), load(lanes.right, i), load(lanes.top, i),
                    load(lanes.bottom, i)};
    hn::Store(moved, du, lanes.moved.data() + i);
    hn::Store(nearness_in(moved, box, load(lanes.tile_column, i), load(lanes.tile_row, i)), du,
              lanes.nearness.data() + i);
  }
}

}  // namespace
}  // namespace fathom::fast::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/effort.h"
#include "tests/engines/only_target.h"
#include "tests/numeric/random_numbers.h"
#include "tests/special_values.h"

namespace fathom::fast {
HWY_EXPORT(find_nearness);
}  // namespace fathom::fast

namespace fathom {
namespace {

using namespace fast;
using checks::any_double;
using checks::Numbers;

std::uint32_t moved_up(float x) {
  return moved_up_in_24_bits(std::bit_cast<std::uint32_t>(x));
}

/// A box of pixels in a tile.
struct BoxInTile {
  std::uint32_t tile_column, tile_row, left, right, top, bottom;

  explicit BoxInTile(Numbers& n)
      : tile_column(static_cast<std::uint32_t>(n.below(n.below(4) == 0 ? 1 << 25 : 20))),
        tile_row(static_cast<std::uint32_t>(n.below(20))),
        left(static_cast<std::uint32_t>(n.below(side))),
        right(end_from(left, n)),
        top(static_cast<std::uint32_t>(n.below(side))),
        bottom(end_from(top, n)) {}

  [[nodiscard]] Nearness nearness(std::uint32_t q) const {
    return nearness_in(q, left / TileShape::block, right / TileShape::block, top / TileShape::block,
                       bottom / TileShape::block);
  }

 private:
  static constexpr int side = TileShape::size;
  static std::uint32_t end_from(std::uint32_t first, Numbers& n) {
    return std::min(TileShape::size - 1, first + static_cast<std::uint32_t>(n.below(40)));
  }
};

/// Expects of each number, in any lane and box, what nearness.h says.
void expect_equal(const std::vector<double>& numbers, Numbers& n) {
  NearnessLanes lanes{};
  for (std::size_t first = 0; first < numbers.size(); first += NearnessLanes::count) {
    std::vector<BoxInTile> boxes;
    for (std::size_t k = 0; k < NearnessLanes::count; ++k) {
      lanes.q[k] = numbers[std::min(first + k, numbers.size() - 1)];
      const BoxInTile& box = boxes.emplace_back(n);
      lanes.tile_column[k] = box.tile_column;
      lanes.tile_row[k] = box.tile_row;
      lanes.left[k] = box.tile_column * double{TileShape::size} + box.left;
      lanes.right[k] = box.tile_column * double{TileShape::size} + box.right;
      lanes.top[k] = box.tile_row * double{TileShape::size} + box.top;
      lanes.bottom[k] = box.tile_row * double{TileShape::size} + box.bottom;
    }
    HWY_DYNAMIC_DISPATCH(find_nearness)(lanes);
    for (std::size_t k = 0; k < NearnessLanes::count; ++k) {
      const std::uint32_t moved = moved_up(static_cast<float>(lanes.q[k]));
      ASSERT_EQ(static_cast<std::uint32_t>(lanes.moved[k]), moved) << std::hexfloat << lanes.q[k];
      ASSERT_EQ(static_cast<std::uint32_t>(lanes.nearness[k]), boxes[k].nearness(moved))
          << std::hexfloat << lanes.q[k] << " at " << boxes[k].left << ' ' << boxes[k].right << ' '
          << boxes[k].top << ' ' << boxes[k].bottom;
    }
  }
}

/// Where rounding to binary32 or moving up changes its mind: a binary32 number, the middle between
/// it and the next, and the neighbours of both.
void add_boundaries(float x, std::vector<double>& numbers) {
  // The next one; behind the greatest number, what would follow if there were more exponents.
  const double next = std::abs(x) == std::numeric_limits<float>::max()
                          ? std::copysign(0x1p128, x)
                          : double{std::nextafter(x, std::copysign(INFINITY, x))};
  for (const double at : {double{x}, x + (next - x) / 2}) {
    numbers.insert(numbers.end(),
                   {at, std::nextafter(at, infinity), std::nextafter(at, -infinity)});
  }
}

std::vector<double> numbers_of_all_kinds(Numbers& n) {
  std::mt19937_64 random(68);
  std::vector<double> numbers{0.0,
                              -0.0,
                              infinity,
                              -infinity,
                              std::numeric_limits<double>::max(),
                              std::numeric_limits<double>::lowest(),
                              std::numeric_limits<double>::denorm_min(),
                              -std::numeric_limits<double>::denorm_min()};
  for (const float x :
       {0.0F, std::numeric_limits<float>::denorm_min(), std::numeric_limits<float>::min(),
        std::nextafter(std::numeric_limits<float>::min(), 0.0F), 1.0F,
        std::numeric_limits<float>::max()}) {
    add_boundaries(x, numbers);
    add_boundaries(-x, numbers);
  }
  for (int i = 0; i < 10000 / checks::effort; ++i) {
    numbers.push_back(any_double(random));
    // Those that binary32 holds, subnormals of it among them.
    numbers.push_back(std::ldexp(n.unit(), n.below(290) - 155));
    // Any binary32 number, and those at the ends of the 256 steps that are left out.
    const auto bits = static_cast<std::uint32_t>(random());
    for (const std::uint32_t b : {bits, bits & 0xFFFFFF00, bits | 0xFF}) {
      const auto x = std::bit_cast<float>(b);
      if (std::isfinite(x)) add_boundaries(x, numbers);
    }
  }
  return numbers;
}

TEST(Nearness, IsTheSameByVectorsOfEveryKind) {
  for (const std::int64_t target : checks::vector_targets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    const checks::OnlyTarget only(target);
    Numbers n(69);
    expect_equal(numbers_of_all_kinds(n), n);
  }
}

TEST(Nearness, IsNeverLessThanTheNumber) {
  Numbers n(64);
  for (int i = 0; i < 20000 / checks::effort; ++i) {
    const auto x = static_cast<float>(std::ldexp(n.unit(), n.below(220) - 100));
    const std::uint32_t up = moved_up(x);
    const auto moved = std::bit_cast<float>(up);
    EXPECT_EQ(up & 0xFF, 0U);
    EXPECT_GT(moved, x);
    EXPECT_LT(moved, x + std::abs(x) * 0x1p-14F);
    const Nearness near = nearness_in(up, 1, 3, 7, 7);
    EXPECT_EQ(block_of(near), 7U * 8 + 1);
    EXPECT_TRUE(meets_more_than_two_blocks(near));
    EXPECT_EQ(near & 0xFFFFFF00, up);
  }
  EXPECT_FALSE(meets_more_than_two_blocks(nearness_in(0, 2, 3, 4, 5)));
  EXPECT_EQ(nearness_in(0, 0, 4, 0, 0), never_hidden);
  EXPECT_TRUE(std::isnan(std::bit_cast<float>(never_hidden)));
  const auto moved = [](float x) { return std::bit_cast<float>(moved_up(x)); };
  EXPECT_TRUE(std::isnan(moved(std::numeric_limits<float>::infinity())));
  EXPECT_TRUE(std::isnan(moved(std::numeric_limits<float>::max())));
  EXPECT_GT(moved(0), 0);
  EXPECT_FALSE(moved(-0.0F) < 0);
  EXPECT_FALSE(moved(-std::numeric_limits<float>::denorm_min()) < 0);
}

}  // namespace
}  // namespace fathom
#endif
