#include <gtest/gtest.h>

#include <vector>

#include "apps/bench/machine.h"
#include "apps/bench/measurement.h"
#include "apps/bench/resident_memory.h"
#include "fathom/failures/errors.h"
#include "validation/child/in_child.h"

namespace fathom::bench {
namespace {

using validation::in_child;

TEST(BenchFrames, TheFirstIsNotCountedAndClearingIsNotTimed) {
  int drawn = 0, cleared = 0;
  const Frames frames = time_frames(
      4, [&] { ++drawn; }, [&] { ++cleared; }, std::chrono::milliseconds(0));
  EXPECT_EQ(drawn, 5);
  EXPECT_EQ(cleared, 5);
  EXPECT_EQ(frames.milliseconds.size(), 4U);
  EXPECT_TRUE(std::is_sorted(frames.milliseconds.begin(), frames.milliseconds.end()));
}

TEST(BenchFrames, TheFirstCountsWhereItIsTheOnlyOne) {
  const Frames frames = time_frames(0, [] {});
  EXPECT_EQ(frames.milliseconds, std::vector<double>{frames.first_ms});
}

TEST(BenchMemory, ItsPeakOfMemoryIsItsOwn) {
  constexpr std::size_t large = 64U << 20;
  const auto peak_after = [](std::size_t bytes) {
    return in_child([&] {
      forget_peak();
      { const std::vector<char> block(bytes, 'x'); }
      return peak_resident_bytes();
    });
  };
  const std::uint64_t with_block = peak_after(large), without = peak_after(0);
  EXPECT_GE(with_block, without + large / 2);  // the kernel counts pages in batches
}

TEST(BenchProcessors, AChildKeepsToOne) {
  EXPECT_EQ(in_child([] {
              keep_to_processors(1);
              return processor_count();
            }),
            1);
}

TEST(BenchRenderers, EnginesAreMeasured) {
  const Plan plan{.scene = "sphere-512", .width = 64, .height = 36, .threads = 1, .repeat = 2};
  std::vector<std::uint64_t> covered;
  for (const char* renderer : {"fast", "fast-kept", "reference"}) {
    const std::vector<Measurement> measurements = measure_in_child(renderer, plan);
    ASSERT_EQ(measurements.size(), 1U);
    EXPECT_EQ(measurements[0].renderer, renderer);
    EXPECT_EQ(measurements[0].milliseconds.size(), 2U);
    EXPECT_GT(measurements[0].milliseconds.front(), 0);
    EXPECT_GT(measurements[0].peak_bytes, 0U);
    covered.push_back(measurements[0].covered_pixels);
  }
  EXPECT_GT(covered[0], 0U);
  EXPECT_EQ(covered[0], covered[1]);
  EXPECT_EQ(covered[0], covered[2]);
  EXPECT_THROW(measure("raytracer", plan), UsageError);
  EXPECT_EQ(count_triangles_in_child(plan), 512U);
}

}  // namespace
}  // namespace fathom::bench
