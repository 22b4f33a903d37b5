// Maps that cannot be read, by every command that reads maps.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/apps/run_program.h"
#include "tests/apps/sample_files.h"
#include "tests/apps/test_folder.h"

namespace fathom::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

struct BadMap {
  std::string name;
  std::string file;
  /// Makes the content from that of the good map of this suffix.
  std::string (*spoil)(std::string good);
};

void PrintTo(const BadMap& map, std::ostream* stream) {
  *stream << map.name;
}

std::string half(std::string good) {
  return good.substr(0, good.size() / 2);
}
std::string nothing(std::string) {
  return "";
}
std::string text(std::string) {
  return "this is no map\n";
}

std::string with_bytes(std::string good, const std::string& from, const std::string& to) {
  return good.replace(good.find(from), from.size(), to);
}

std::vector<BadMap> bad_maps() {
  return {
      {"ExrTruncated", "bad.exr", half},
      {"ExrEmpty", "bad.exr", nothing},
      {"ExrText", "bad.exr", text},
      {"ExrHeaderOnly", "bad.exr", [](std::string good) { return good.substr(0, 200); }},
      {"PfmTruncated", "bad.pfm", half},
      {"PfmHuge", "bad.pfm",
       [](std::string) { return std::string("Pf\n2000000000 2000000000\n-1\n"); }},
      {"PfmNoSize", "bad.pfm", [](std::string) { return std::string("Pf\neight six\n-1\n"); }},
      {"PngTruncated", "bad.png", half},
      {"PngSignatureOnly", "bad.png", [](std::string good) { return good.substr(0, 8); }},
      {"PngCorrupt", "bad.png",
       [](std::string good) { return with_bytes(std::move(good), "IDAT", "IDAX"); }},
      {"ColmapTruncated", "bad.bin", half},
      {"ColmapOverlong", "bad.bin", [](std::string good) { return good + "abcd"; }},
      {"ColmapHuge", "bad.bin",
       [](std::string good) {
         return with_bytes(std::move(good), "8&6&", "4000000000&4000000000&");
       }},
      {"ColmapTwoChannels", "bad.bin",
       [](std::string good) { return with_bytes(std::move(good), "6&1&", "6&2&"); }},
      {"ColmapNegative", "bad.bin",
       [](std::string good) {
         good.back() = '\xbf';
         return good;
       }},
      {"ColmapNaN", "bad.bin",
       [](std::string good) { return good.substr(0, good.size() - 4) + "\xff\xff\xff\x7f"; }},
      {"TiffIsNotRead", "bad.npy", [](std::string) { return std::string("II*\0abcdefgh", 12); }},
      {"NpyTruncated", "bad.npy", half},
      {"NpyHuge", "bad.npy",
       [](std::string good) {
         return with_bytes(std::move(good), "(6, 8)", "(9999999, 9999999)");
       }},
      {"NpyObjects", "bad.npy",
       [](std::string good) { return with_bytes(std::move(good), "<f4", "|O8"); }},
  };
}

class BadMapFile : public ::testing::TestWithParam<BadMap> {
 protected:
  void SetUp() override {
    const BadMap& bad = GetParam();
    const std::string good = "good" + bad.file.substr(bad.file.find('.'));
    folder_.write("square.obj", square_obj);
    folder_.write("camera.json", square_camera);
    const Outcome rendered =
        run_fathom({"render", "square.obj", "--camera", "camera.json", "-o", good},
                   {.folder = folder_.path()});
    ASSERT_EQ(rendered.status, 0) << rendered.err;
    folder_.write(bad.file, bad.spoil(folder_.read(good)));
    folder_.write("older.png", "older");
  }

  void expect_refusal(std::vector<std::string> arguments) {
    const auto before = folder_.names();
    RunOptions options{.folder = folder_.path()};
    options.memory = rlim_t{2} << 30;
    const Outcome outcome = run_fathom(arguments, options);
    EXPECT_EQ(outcome.status, 3) << arguments[0] << outcome.out;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_THAT(outcome.err, StartsWith("fathom: error: " + GetParam().file + ":"));
    EXPECT_THAT(outcome.err, Not(HasSubstr("out of memory")));
    EXPECT_EQ(folder_.read("older.png"), "older");
    EXPECT_EQ(folder_.names(), before);
  }

  TestFolder folder_;
};

TEST_P(BadMapFile, IsRefusedByEveryCommand) {
  const std::string& bad = GetParam().file;
  const std::string good = "good" + bad.substr(bad.find('.'));
  expect_refusal({"preview", bad, "-o", "older.png"});
  expect_refusal({"compare", good, bad, "--heatmap", "older.png"});
  expect_refusal({"compare", bad, good, "--heatmap", "older.png"});
  expect_refusal({"convert", bad, "-o", "older.png"});
}

INSTANTIATE_TEST_SUITE_P(All, BadMapFile, ::testing::ValuesIn(bad_maps()),
                         [](const auto& test) { return test.param.name; });

TEST(BadMap, DirectoryAndMissingFile) {
  const TestFolder folder;
  std::filesystem::create_directory(folder / "map.exr");
  for (const std::string map : {"map.exr", "nowhere.exr"}) {
    const Outcome outcome = run_fathom({"preview", map, "-o", "p.png"}, {.folder = folder.path()});
    EXPECT_EQ(outcome.status, 3);
    EXPECT_THAT(outcome.err, StartsWith("fathom: error: " + map + ":"));
    EXPECT_EQ(folder.names(), std::vector<std::string>{"map.exr"});
  }
}

}  // namespace
}  // namespace fathom::test
