#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/run_program.h"
#include "tests/apps/test_folder.h"
#include "tests/places.h"

/// `fathom bench`, which starts fathom-bench, as users run it.
namespace fathom::test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A small comparison with the reference engine.
std::vector<std::string> small(const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"bench", "--size",  "40x30",    "--repeat",
                                     "2",     "--peers", "reference"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(BenchProgram, ShowsATableAndWritesJson) {
  const TestFolder folder;
  const Outcome outcome =
      run_fathom(small({"--scene", "sphere-200,few-large", "--threads", "1", "--json", "t.json"}),
                 {.folder = folder.path()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, HasSubstr("sphere-200: 200 triangles, 40x30, 1 thread\n"));
  EXPECT_THAT(outcome.out, HasSubstr("\n  fast-kept "));
  EXPECT_THAT(outcome.out, HasSubstr("\n  reference "));

  const auto json = nlohmann::json::parse(folder.read("t.json"));
  EXPECT_TRUE(json.contains("machine"));
  ASSERT_EQ(json["results"].size(), 6U);
  EXPECT_EQ(json["results"][0]["renderer"], "fast");
  EXPECT_EQ(json["results"][1]["renderer"], "fast-kept");
  EXPECT_EQ(json["results"][2]["renderer"], "reference");
  EXPECT_EQ(json["results"][3]["scene"], "few-large");
  EXPECT_EQ(json["results"][0]["covered_pixels"], json["results"][1]["covered_pixels"]);
  EXPECT_EQ(json["results"][0]["covered_pixels"], json["results"][2]["covered_pixels"]);
}

TEST(BenchProgram, JsonAloneOnStandardOutput) {
  const Outcome outcome = run_fathom(small({"--scene", "sphere-8", "--json", "-"}));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(nlohmann::json::parse(outcome.out)["results"].size(), 3U);
}

TEST(BenchProgram, TimesAMeshFileAndEverySizeAndNumberOfThreads) {
  const std::string mesh = source_dir() / "data/meshes/cube.obj";
  const Outcome outcome = run_fathom({"bench", "--scene", mesh, "--size", "16x16,8x8", "--threads",
                                      "1,1", "--peers", "none", "--repeat", "1", "--json", "-"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  ASSERT_EQ(json["results"].size(), 2U * 4);
  EXPECT_EQ(json["results"][7]["width"], 8);
  EXPECT_EQ(json["results"][7]["triangles"], 12);
}

/// A small run of the ideas.
std::vector<std::string> parts(const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"bench",  "--parts", "--scene",  "sphere-200",
                                     "--size", "40x30",   "--repeat", "1"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(BenchProgram, ShowsWhatEachIdeaBrings) {
  const TestFolder folder;
  const Outcome outcome =
      run_fathom(parts({"--threads", "1,1", "--json", "t.json"}), {.folder = folder.path()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, HasSubstr("\nsphere-200: 200 triangles, 40x30\n"));
  for (const char* idea : {"lanes of binary32", "lanes of binary64", "lanes of the fast engine",
                           "blocks before pixels", "early rejection, pipeline",
                           "early rejection, fast engine", "tiles", "threads", "culling"}) {
    EXPECT_THAT(outcome.out, HasSubstr(std::string("\n") + idea));
  }
  EXPECT_THAT(outcome.out, testing::ContainsRegex("demo, near triangle +13955 +13955 +0\n"));
  EXPECT_THAT(outcome.out, testing::ContainsRegex("demo, far triangle +16830 +16970 +140\n"));

  const auto json = nlohmann::json::parse(folder.read("t.json"));
  EXPECT_TRUE(json.contains("machine"));
  EXPECT_EQ(json["results"][0]["idea"], "lanes of binary32");
  EXPECT_EQ(json["closed_edges"].size(), 3U);
  EXPECT_EQ(json["left_out"].size(), 0U);
}

TEST(BenchProgram, TimesOnlyTheIdeasThatAreNamed) {
  const Outcome outcome = run_fathom(parts({"--idea", "tiles,blocks", "--json", "-"}));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  ASSERT_EQ(json["results"].size(), 8U + 6);
  EXPECT_EQ(json["results"][0]["idea"], "blocks before pixels");
  EXPECT_EQ(json["results"][8]["idea"], "tiles");
}

TEST(BenchProgram, SaysWhyAnIdeaIsLeftOut) {
  const Outcome outcome = run_fathom({"bench", "--parts", "--scene", "few-large", "--size", "40x30",
                                      "--repeat", "1", "--idea", "culling"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("\nculling: changes the picture"));
}

TEST(BenchProgram, MaskedOcclusionCullingIsTimedWithOneThreadOrSaidNotToBeBuiltIn) {
  const Outcome outcome =
      run_fathom({"bench", "--scene", "sphere-200", "--size", "40x30", "--threads", "1", "--repeat",
                  "1", "--peers", "masked-occlusion-culling", "--json", "-"});
#ifdef FATHOM_MASKED_OCCLUSION_CULLING
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  ASSERT_EQ(json["results"].size(), 3U);
  EXPECT_EQ(json["results"][2]["renderer"], "masked-occlusion-culling");
#else
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("masked-occlusion-culling is not built in"));
#endif
}

struct Refused {
  std::string name;
  std::vector<std::string> arguments;
  int status;
  std::string message;
};

void PrintTo(const Refused& refused, std::ostream* stream) {
  *stream << refused.name;
}

class BenchRefuses : public testing::TestWithParam<Refused> {};

TEST_P(BenchRefuses, InOneLineAndLeavesNoFile) {
  const TestFolder folder;
  const Outcome outcome = run_fathom(GetParam().arguments, {.folder = folder.path()});
  EXPECT_EQ(outcome.status, GetParam().status);
  EXPECT_THAT(outcome.err, HasSubstr(GetParam().message));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

INSTANTIATE_TEST_SUITE_P(
    All, BenchRefuses,
    testing::Values(
        Refused{"Scene", small({"--scene", "sphere"}), 2, "there is no scene 'sphere'"},
        Refused{"SceneOfValidate", small({"--scene", "spot"}), 2, "did you mean 'mesh'?"},
        Refused{"SphereOfNothing", small({"--scene", "sphere-0"}), 2, "sphere-0"},
        Refused{"Peer", {"bench", "--peers", "opengl"}, 2, "'opengl' is not one of"},
        Refused{"Size", {"bench", "--size", "40"}, 2, "--size"},
        Refused{"NoThreads", small({"--threads", "x"}), 2, "--threads"},
        Refused{"TooManyThreads", small({"--threads", "100000"}), 2, "more than the"},
        Refused{"NoRepeat", {"bench", "--repeat", "0"}, 2, "--repeat"},
        Refused{"Channel", small({"--channels", "depth"}), 2, "there is no channel 'depth'"},
        Refused{"Option", small({"--frobnicate"}), 2, "--frobnicate"},
        Refused{"Idea", parts({"--idea", "sorting"}), 2, "'sorting'"},
        Refused{"IdeaOfNoParts", small({"--idea", "lanes"}), 2, "--idea belongs to --parts"},
        Refused{"PartsBesidePeers", parts({"--peers", "none"}), 2, "--peers"},
        Refused{"PartsWithChannels", parts({"--channels", "Z"}), 2, "--channels"},
        Refused{"PartsOfNoMesh", {"bench", "--parts", "--scene", "missing.obj"}, 3, "missing.obj"},
        Refused{"PartsToNoFolder", parts({"--json", "/dev/null/t.json"}), 4, "/dev/null/t.json"},
        Refused{"MissingMesh", small({"--scene", "missing.obj", "--json", "t.json"}), 3,
                "missing.obj"},
        Refused{"NoFolder", small({"--scene", "sphere-8", "--json", "/dev/null/t.json"}), 4,
                "/dev/null/t.json"}),
    [](const auto& refused) { return refused.param.name; });

}  // namespace
}  // namespace fathom::test
