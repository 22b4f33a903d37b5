#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <string>
#include <vector>

#include "fathom/numeric/errors.h"
#include "validation/bench/in_child.h"
#include "validation/bench/measurement.h"
#include "validation/bench/processors.h"
#include "validation/bench/renderers.h"
#include "validation/bench/resident_memory.h"

namespace fathom::bench {
namespace {

using testing::HasSubstr;

template <class Error>
std::string message_of(const std::function<std::string()>& work) {
  try {
    run_in_child(work);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

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

TEST(BenchChild, ReturnsItsText) {
  const std::string long_text(1'000'000, 'x');
  EXPECT_EQ(run_in_child([&] { return long_text; }), long_text);
  EXPECT_EQ(run_in_child([] { return std::string(); }), "");
}

TEST(BenchChild, FailsAsItsWorkDoes) {
  EXPECT_EQ(message_of<UsageError>([]() -> std::string { throw UsageError("such usage"); }),
            "such usage");
  EXPECT_EQ(message_of<InputError>([]() -> std::string { throw InputError("such input"); }),
            "such input");
  EXPECT_EQ(message_of<InputError>([]() -> std::string { throw std::bad_alloc(); }),
            "out of memory");
}

TEST(BenchChild, ASignalIsAnError) {
  EXPECT_THAT(message_of<InputError>([]() -> std::string {
                ::raise(SIGKILL);
                return "";
              }),
              HasSubstr("signal 9"));
}

TEST(BenchChild, ItsPeakOfMemoryIsItsOwn) {
  constexpr std::size_t large = 64U << 20;
  const auto peak_after = [](std::size_t bytes) {
    return std::stoull(run_in_child([&] {
      forget_peak();
      { const std::vector<char> block(bytes, 'x'); }
      return std::to_string(peak_resident_bytes());
    }));
  };
  const std::uint64_t with_block = peak_after(large), without = peak_after(0);
  EXPECT_GE(with_block, without + large / 2);  // the kernel counts pages in batches
}

TEST(BenchProcessors, AChildKeepsToOne) {
  EXPECT_EQ(run_in_child([] {
              keep_to_processors(1);
              return std::to_string(processor_count());
            }),
            "1");
}

TEST(BenchRenderers, EnginesAreMeasured) {
  const Plan plan{.scene = "sphere-512", .width = 64, .height = 36, .threads = 1, .repeat = 2};
  std::vector<std::uint64_t> covered;
  for (const char* renderer : {"fast", "reference"}) {
    const auto measurements =
        measurements_from_text(run_in_child([&] { return to_text(measure(renderer, plan)); }));
    ASSERT_EQ(measurements.size(), 1U);
    EXPECT_EQ(measurements[0].renderer, renderer);
    EXPECT_EQ(measurements[0].milliseconds.size(), 2U);
    EXPECT_GT(measurements[0].milliseconds.front(), 0);
    EXPECT_GT(measurements[0].peak_bytes, 0U);
    covered.push_back(measurements[0].covered_pixels);
  }
  EXPECT_GT(covered[0], 0U);
  EXPECT_EQ(covered[0], covered[1]);
  EXPECT_THROW(measure("raytracer", plan), UsageError);
}

}  // namespace
}  // namespace fathom::bench
