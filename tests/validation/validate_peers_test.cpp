#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/run_program.h"
#include "tests/apps/test_folder.h"

/// `fathom validate --against …` with renderers that are really there (FATHOM_PEERS), small.
namespace fathom::test {
namespace {

using testing::HasSubstr;

nlohmann::json results_of(const std::string& renderers, const std::string& scenes) {
  const TestFolder folder;
  const Outcome outcome = run_fathom(
      {"validate", "--against", renderers, "--scene", scenes, "--size", "64x48", "--out", "report"},
      {.folder = folder.path()});
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(folder.read("report/report.html"), HasSubstr("</html>"));
  return nlohmann::json::parse(folder.read("report/report.json"))["results"];
}

TEST(ValidatePeers, EveryPixelIsExplained) {
  const auto results = results_of("opengl,vtk,embree", "sphere,calibrated,orthographic");
  EXPECT_EQ(results.size(), 3U * (7 + 5 + 2));
  for (const auto& result : results) {
    EXPECT_EQ(result["pixels"]["unexplained"], 0) << result.dump();
    EXPECT_LT(result["bounds"]["may_share"], 0.1) << result.dump();
  }
}

// The rays meet corners exactly, where Embree's fast test lets some through: they are counted as
// what they are. OpenGL, which snaps corners, misses none.
TEST(ValidatePeers, RaysThroughCornersAreCountedAsMissed) {
  for (const auto& result : results_of("opengl,embree", "vertices")) {
    const bool is_default = result["variant"] == "default";
    const int missed = result["pixels"]["missed surface"];
    if (is_default) {
      EXPECT_GT(missed, 0) << result.dump();
    }
    if (result["renderer"] == "opengl") {
      EXPECT_EQ(missed, 0) << result.dump();
    }
  }
}

TEST(ValidatePeers, ARendererThatIsNotThereLeavesTheOthersToRun) {
  const TestFolder folder;
  const std::string command = "PATH=/nonexistent " + program_path() +
                              " validate --against blender,embree --scene sphere --size 32x24";
  const Outcome outcome = run({"/bin/sh", "-c", command});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.out, HasSubstr("blender is not installed: the package blender provides it"));
  EXPECT_THAT(outcome.out, HasSubstr("sphere, embree robust: "));
}

TEST(ValidatePeers, ARendererThatTakesTooLongIsEnded) {
  const TestFolder folder;
  folder.write("blender", "#!/bin/sh\nexec sleep 600\n");
  const std::string command =
      "chmod +x blender; PATH=$PWD:$PATH " + program_path() +
      " validate --against blender --scene sphere --size 32x24 --time-limit 1";
  const Outcome outcome = run({"/bin/sh", "-c", command}, {.folder = folder.path()});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.out, HasSubstr("did not end within 1 seconds"));
}

TEST(ValidatePeers, WhatTheOtherDrewIsAMapOfOurs) {
  const TestFolder folder;
  const std::string cube = FATHOM_SOURCE_DIR "/data/meshes/cube.obj";
  const Outcome outcome =
      run_fathom({"validate", "--render", "vtk", cube, "--size", "40x30", "-o", "vtk.exr"},
                 {.folder = folder.path()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(run_fathom({"info", "vtk.exr"}, {.folder = folder.path()}).status, 0);
}

}  // namespace
}  // namespace fathom::test
