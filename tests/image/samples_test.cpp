#include "fathom/image/samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <new>

namespace fathom {
namespace {

/// Below and above the size from which on memory comes in huge pages.
constexpr std::size_t counts[] = {1, 1000, (1U << 19) - 1, 1U << 19, (1U << 20) + 5};

TEST(Samples, AreZeroAndCanAllBeWritten) {
  for (const std::size_t count : counts) {
    Samples<float> samples(count);
    ASSERT_EQ(samples.size(), count);
    EXPECT_TRUE(std::all_of(samples.begin(), samples.end(), [](float x) { return x == 0; }));
    std::fill(samples.begin(), samples.end(), 2.5F);
    EXPECT_EQ(samples[count - 1], 2.5F);
    EXPECT_EQ(samples.at(0), 2.5F);
    EXPECT_THROW(static_cast<void>(samples.at(count)), std::out_of_range);
  }
  EXPECT_TRUE(Samples<double>().empty());
  EXPECT_TRUE(Samples<double>(0).empty());
}

TEST(Samples, CopiesAreTheirOwn) {
  for (const std::size_t count : counts) {
    Samples<std::uint32_t> a(count, 7);
    const Samples<std::uint32_t> b = a;
    EXPECT_EQ(a, b);
    a[count - 1] = 8;
    EXPECT_FALSE(a == b);
    EXPECT_EQ(b[count - 1], 7U);
    Samples<std::uint32_t> c;
    c = b;
    EXPECT_EQ(c, b);
    const Samples<std::uint32_t> moved = std::move(c);
    EXPECT_EQ(moved, b);
    EXPECT_TRUE(c.empty());  // NOLINT(bugprone-use-after-move): it is what is asked
  }
  EXPECT_EQ((Samples<float>{1, 2, 3}), (Samples<float>(std::vector<float>{1, 2, 3})));
  EXPECT_FALSE((Samples<float>{1, 2, 3}) == (Samples<float>{1, 2}));
}

TEST(Samples, LentMemoryIsWrittenAndLeftToItsOwner) {
  std::array<float, 3> memory{7, 8, 9};
  {
    auto lent = Samples<float>::lent(memory.data(), memory.size());
    EXPECT_EQ(lent, (Samples<float>{7, 8, 9}));
    lent[1] = 5;
    const Samples<float> copy = lent;
    EXPECT_NE(copy.data(), memory.data());
    auto moved = std::move(lent);
    EXPECT_EQ(moved.data(), memory.data());
    moved = Samples<float>{1};
  }
  EXPECT_EQ(memory, (std::array<float, 3>{7, 5, 9}));
}

TEST(Samples, MoreThanThereIsIsRefused) {
  EXPECT_THROW(Samples<double>(std::size_t{1} << 60), std::bad_alloc);
}

}  // namespace
}  // namespace fathom
