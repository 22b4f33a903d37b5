// What a command does where memory is short: --max-memory, limits of the process, small files that
// unpack to large maps. tests/faults lets each single allocation fail.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <sstream>

#include "packed_maps.h"
#include "run_program.h"
#include "sample_files.h"
#include "test_folder.h"

namespace fathom::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class Memory : public ::testing::Test {
 protected:
  Memory() {
    folder_.write("square.obj", square_obj);
    folder_.write("older.png", "older");
  }

  Outcome fathom(const std::vector<std::string>& arguments) const {
    return run_fathom(arguments, {.folder = folder_.path()});
  }

  /// One line, status 3, and nothing new in the folder.
  void expect_refusal(const std::vector<std::string>& arguments, const std::string& said) const {
    RunOptions options{.folder = folder_.path()};
    options.memory = rlim_t{512} << 20;
    const auto before = folder_.names();
    const Outcome outcome = run_fathom(arguments, options);
    EXPECT_EQ(outcome.status, 3);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, "fathom: error: " + said + "\n");
    EXPECT_EQ(folder_.read("older.png"), "older");
    EXPECT_EQ(folder_.names(), before);
  }

  /// Each command that reads maps.
  void expect_refusal_by_all(const std::string& map, const std::string& said) const {
    expect_refusal({"info", map}, said);
    expect_refusal({"preview", map, "-o", "older.png"}, said);
    expect_refusal({"convert", map, "-o", "older.png"}, said);
    expect_refusal({"compare", map, map, "--heatmap", "older.png"}, said);
  }

  TestFolder folder_;
};

TEST_F(Memory, ASmallExrThatUnpacksToGigabytes) {
  folder_.write("black.exr", black_exr(20000, 20000));
  ASSERT_LT(folder_.read("black.exr").size(), 2000000U);
#ifdef FATHOM_SANITIZED
  expect_refusal_by_all("black.exr",
                        "black.exr: an image of 20000×20000 pixels needs 1.6 GB; such a small file "
                        "may unpack to 536.9 MB; --max-memory SIZE allows more");
#else
  expect_refusal_by_all(
      "black.exr",
      "black.exr: an image of 20000×20000 pixels needs 1.6 GB; ulimit -v allows 536.9 MB");
#endif
  const Outcome outcome = fathom({"info", "black.exr"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_EQ(outcome.err,
            "fathom: error: black.exr: an image of 20000×20000 pixels needs 1.6 GB; such a small "
            "file may unpack to 536.9 MB; --max-memory SIZE allows more\n");
}

TEST_F(Memory, ASmallPngThatUnpacksToGigabytes) {
  folder_.write("black.png", black_png(9000, 9000));
  const Outcome outcome = fathom({"preview", "black.png", "-o", "older.png"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_EQ(outcome.err,
            "fathom: error: black.png: an image of 9000×9000 pixels needs 648.0 MB; such a small "
            "file may unpack to 536.9 MB; --max-memory SIZE allows more\n");
  EXPECT_EQ(folder_.read("older.png"), "older");
}

/// A constant map is no bomb: what it takes is what decides, not how well it is packed.
TEST_F(Memory, ASmallFileOfUsualSizeIsRead) {
  folder_.write("black.exr", black_exr(2000, 2000));
  const Outcome outcome = fathom({"info", "black.exr"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("2000"));
}

TEST_F(Memory, MaxMemoryDecidesWhatAMapMayTake) {
  folder_.write("black.exr", black_exr(4000, 4000));
  expect_refusal(
      {"info", "black.exr", "--max-memory", "60M"},
      "black.exr: an image of 4000×4000 pixels needs 64.0 MB; --max-memory allows 62.9 MB");
  EXPECT_EQ(fathom({"info", "black.exr", "--max-memory", "200M"}).status, 0);
}

TEST_F(Memory, MaxMemoryDecidesHowLargeAnImageIsRendered) {
  // Z and A, and 16 rows of them three times for ZIP.
  expect_refusal(
      {"render", "square.obj", "--size", "8000x8000", "--max-memory", "100M", "-o", "a.exr"},
      "an image of 8000x8000 pixels needs 515.1 MB; --max-memory allows 104.9 MB");
  // Z, and a file as large.
  expect_refusal(
      {"render", "square.obj", "--size", "8000x8000", "--max-memory", "100M", "-o", "a.npy"},
      "an image of 8000x8000 pixels needs 512.0 MB; --max-memory allows 104.9 MB");
  expect_refusal({"render", "square.obj", "--size", "8000x8000", "--max-memory", "100M", "--deep",
                  "-o", "a.exr"},
                 "an image of 8000x8000 pixels needs 512.0 MB; --max-memory allows 104.9 MB");
  const Outcome outcome =
      fathom({"render", "square.obj", "--size", "64x48", "--max-memory", "100M", "-o", "a.exr"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

TEST_F(Memory, MaxMemoryIsASize) {
  for (const std::string text : {"0", "x", "-1", "1.5G", "2GB", "M", "9999999999T"}) {
    const Outcome outcome = fathom({"info", "square.obj", "--max-memory", text});
    EXPECT_EQ(outcome.status, 2) << text;
    EXPECT_EQ(outcome.err,
              "fathom: error: --max-memory: '" + text + "' is not a size, such as 512M or 2G\n");
  }
  for (const std::string text : {"1000000000", "900000K", "512M", "2G", "1T"}) {
    EXPECT_EQ(fathom({"info", "square.obj", "--max-memory", text}).status, 0) << text;
  }
}

/// What no check foresees: the areas of many triangles apart from each other.
TEST_F(Memory, WhatNobodyForesawIsOutOfMemory) {
  std::ostringstream mesh;
  for (int i = 0; i < 100000; ++i) {
    const int x = i % 400, y = i / 400;
    mesh << "v " << x << ' ' << y << " 0\nv " << x + 0.5 << ' ' << y << " 0\nv " << x << ' '
         << y + 0.5 << " 0\nf -3 -2 -1\n";
  }
  folder_.write("many.obj", mesh.str());
#ifndef FATHOM_SANITIZED
  const auto before = folder_.names();
  const Outcome outcome = fathom({"visible", "many.obj", "--max-memory", "20M", "--threads", "1"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_EQ(outcome.err,
            "fathom: error: out of memory: the input or the image is too large; --max-memory "
            "allows 21.0 MB\n");
  EXPECT_EQ(folder_.names(), before);
#endif
}

#ifndef FATHOM_SANITIZED

/// 400 triangles across each other, whose visible areas are long exact numbers.
std::string crossing_triangles() {
  std::minstd_rand random;
  std::uniform_real_distribution<double> across(-1, 1), depth(2, 3);
  std::ostringstream mesh;
  mesh.precision(17);
  for (int i = 0; i < 3 * 400; ++i) {
    mesh << "v " << across(random) << ' ' << across(random) << ' ' << depth(random) << '\n';
  }
  for (int i = 1; i < 3 * 400; i += 3) {
    mesh << "f " << i << ' ' << i + 1 << ' ' << i + 2 << '\n';
  }
  return mesh.str();
}

/// From about what the loader takes to more than most of the work does. In two runs of five GMP
/// would abort, and in others a thread of TBB's.
TEST_F(Memory, EveryLimitOnAddressesEndsInOneLine) {
  folder_.write("crossing.obj", crossing_triangles());
  const auto before = folder_.names();
  int refused = 0;
  for (rlim_t kilobytes = 24000; kilobytes < 42000; kilobytes += 600) {
    const Outcome outcome = run_fathom(
        {"visible", "crossing.obj", "--size", "64x48", "--threads", "2", "-o", "answer.txt"},
        {.folder = folder_.path(), .memory = kilobytes << 10});
    if (outcome.status == 127 || outcome.status == 0) continue;  // 127: the loader has no room
    ++refused;
    EXPECT_EQ(outcome.status, 3) << kilobytes;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_THAT(outcome.err, StartsWith("fathom: error: "));
    EXPECT_EQ(folder_.names(), before);
  }
  EXPECT_GT(refused, 10);
}
#endif

}  // namespace
}  // namespace fathom::test
