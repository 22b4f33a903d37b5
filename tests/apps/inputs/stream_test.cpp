// fathom render --stream.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "tests/apps/run_program.h"
#include "tests/apps/sample_files.h"
#include "tests/apps/test_folder.h"
#include "tests/places.h"

namespace fathom::test {
namespace {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using Json = nlohmann::json;

const std::string meshes = source_dir() / "data/meshes/";

class Streaming : public ::testing::Test {
 protected:
  Outcome fathom(const std::vector<std::string>& arguments) const {
    return run_fathom(arguments, {.folder = folder_.path()});
  }
  TestFolder folder_;
};

/// Byte for byte the file that the fast engine writes from memory.
TEST_F(Streaming, WritesTheSameFile) {
  const std::vector<std::string> scene{meshes + "cube.stl", meshes + "cube-big-endian.ply"};
  const std::vector<std::vector<std::string>> cases{
      {"--channels", "Z,A,Zlow,distance,id,face,object,N,P,bary", "-o", "map.exr"},
      {"-o", "depth-and-coverage.npz"},
      {"--size", "300x200", "--view", "10,40", "-o", "map.pfm"},
      {"--channels", "distance", "--dtype", "float64", "--cull", "back", "-o", "map.npy"},
      {"--png-scale", "5000", "-o", "map.png"}};
  for (const auto& more : cases) {
    std::vector<std::string> plain{"render", scene[0], scene[1], "--engine", "fast"};
    plain.insert(plain.end(), more.begin(), more.end());
    std::vector<std::string> streamed{"render",   scene[0],  scene[1],
                                      "--stream", "--stats", "s.json"};
    streamed.insert(streamed.end(), more.begin(), more.end());
    const Outcome first = fathom(plain);
    EXPECT_EQ(first.status, 0) << first.err;
    const std::string truth = folder_.read(more.back());
    const Outcome second = fathom(streamed);
    EXPECT_EQ(second.status, 0) << second.err;
    EXPECT_EQ(second.err, first.err);
    EXPECT_TRUE(folder_.read(more.back()) == truth) << more.back();
    const Json stats = Json::parse(folder_.read("s.json"));
    EXPECT_EQ(stats.at("engine"), "fast");
    EXPECT_EQ(stats.at("triangles"), 24);
  }
}

TEST_F(Streaming, VerifiesToo) {
  const Outcome outcome = fathom({"render", meshes + "cube.stl", "--stream", "--verify", "500",
                                  "--size", "100x80", "-o", "map.exr"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.err, MatchesRegex("fathom: map.exr: 50[0-9] of 8000 pixels verified by exact "
                                        "arithmetic( \\(.*\\))?, all agree\n"));
}

TEST_F(Streaming, RefusesWhatCannotBeStreamed) {
  folder_.write("square.obj", square_obj);
  folder_.write("cut.stl", std::string(80, ' ') + std::string("\1\0\0\0", 4));
  struct Case {
    std::vector<std::string> arguments;
    int status;
    std::string says;
  };
  const std::vector<Case> cases{
      {{"square.obj"},
       3,
       "square.obj: is not a binary STL or PLY, the formats that can be streamed"},
      {{meshes + "cube-ascii.stl"}, 3, "is not a binary STL or PLY"},
      {{meshes + "cube.ply"}, 3, "is not a binary STL or PLY"},
      {{"cut.stl"}, 3, "cut.stl: byte 84: the file ends, expected 134 bytes for 1 triangle"},
      {{"missing.stl"}, 3, "missing.stl: cannot be opened"},
      {{"-", "--mesh-format", "stl"}, 2, "standard input, cannot be read in parts"},
      {{meshes + "cube.stl", "--engine", "reference"}, 2, "--stream is for the fast engine"}};
  for (const Case& c : cases) {
    std::vector<std::string> arguments{"render", "--stream", "-o", "map.exr"};
    arguments.insert(arguments.end(), c.arguments.begin(), c.arguments.end());
    const Outcome outcome = fathom(arguments);
    EXPECT_EQ(outcome.status, c.status) << c.arguments[0];
    EXPECT_THAT(outcome.err, HasSubstr(c.says));
  }
  EXPECT_EQ(folder_.names(), (std::vector<std::string>{"cut.stl", "square.obj"}));
}

#ifndef FATHOM_SANITIZED
/// A wavy sheet of 8 million triangles, 400 MB, by a process that is allowed 380 MB of addresses in
/// all.
TEST_F(Streaming, AFileLargerThanTheMemoryAllowed) {
  constexpr std::uint32_t side = 2000;
  std::string stl(80, ' ');
  const std::uint32_t count = 2 * side * side;
  stl.append(reinterpret_cast<const char*>(&count), 4);
  stl.resize(84 + std::size_t{50} * count);
  const auto put_corner = [&](std::size_t at, std::uint32_t i, std::uint32_t j) {
    const float corner[3] = {static_cast<float>(i), static_cast<float>(j),
                             static_cast<float>(20 * std::sin(i * 0.01) * std::cos(j * 0.02))};
    std::memcpy(stl.data() + at, corner, sizeof corner);
  };
  std::size_t at = 84;
  for (std::uint32_t j = 0; j < side; ++j) {
    for (std::uint32_t i = 0; i < side; ++i, at += 100) {
      put_corner(at + 12, i, j), put_corner(at + 24, i + 1, j), put_corner(at + 36, i + 1, j + 1);
      put_corner(at + 62, i, j), put_corner(at + 74, i + 1, j + 1), put_corner(at + 86, i, j + 1);
    }
  }
  folder_.write("sheet.stl", stl);
  const RunOptions limited{.folder = folder_.path(), .memory = rlim_t{380000000}};
  const Outcome whole =
      run_fathom({"render", "sheet.stl", "--engine", "fast", "-o", "a.exr"}, limited);
  EXPECT_NE(whole.status, 0);
  const Outcome streamed = run_fathom({"render", "sheet.stl", "--stream", "-o", "a.exr"}, limited);
  EXPECT_EQ(streamed.status, 0);
  EXPECT_EQ(streamed.err, "");
  // The channels are Z and A: triangles waited on the disk. Where it has no room for them:
  RunOptions full = limited;
  full.file_size = rlim_t{10000000};
  const Outcome failed = run_fathom({"render", "sheet.stl", "--stream", "-o", "b.exr"}, full);
  EXPECT_EQ(failed.status, 4);
  EXPECT_THAT(failed.err, HasSubstr("(what does not fit into memory): File too large"));
  EXPECT_EQ(std::count(failed.err.begin(), failed.err.end(), '\n'), 1);
  // And as from memory, which here there is.
  const Outcome kept = fathom({"render", "sheet.stl", "--stream", "-o", "c.exr"});
  EXPECT_EQ(kept.status, 0);
  EXPECT_TRUE(folder_.read("c.exr") == folder_.read("a.exr"));
  EXPECT_EQ(folder_.names(), (std::vector<std::string>{"a.exr", "c.exr", "sheet.stl"}));
}
#endif

}  // namespace
}  // namespace fathom::test
