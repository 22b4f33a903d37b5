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
  EXPECT_EQ(results.size(), 3U * (7 + 6 + 2));
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

// Blender, which here sleeps, and the folder of its files go with the program.
TEST(ValidatePeers, AnInterruptedRunLeavesNothingBehind) {
  const TestFolder folder;
  folder.write("blender",
               "#!/bin/sh\n[ \"$1\" = --version ] && exit\necho $$ >pid.part\n"
               "mv pid.part pid\nexec sleep 600\n");
  const std::string script =
      "chmod +x blender; mkdir tmp; export PATH=$PWD:$PATH TMPDIR=$PWD/tmp\n" + program_path() +
      " validate --against blender --scene sphere --size 32x24 &\n"
      "until [ -e pid ]; do sleep 0.05; done\n"
      "ls tmp; kill -TERM $!; wait $!; echo status $?\n"
      "until [ -z \"$(ls tmp)\" ] && ! kill -0 $(cat pid) 2>/dev/null; do sleep 0.05; done\n"
      "echo nothing left";
  const Outcome outcome =
      run({"timeout", "30", "/bin/sh", "-c", script}, {.folder = folder.path()});
  EXPECT_THAT(outcome.out, HasSubstr("fathom-validate-"));
  EXPECT_THAT(outcome.out, HasSubstr("status 130"));
  EXPECT_THAT(outcome.out, HasSubstr("nothing left"));
}

TEST(ValidatePeers, CamerasThatBlenderCannotExpressAreRefused) {
  const TestFolder folder;
  const Outcome outcome = run_fathom(
      {"validate", "--against", "blender,embree", "--scene", "calibrated", "--size", "32x24"},
      {.folder = folder.path()});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.out, HasSubstr("calibrated, blender cycles: "));
  EXPECT_THAT(outcome.out, HasSubstr("calibrated, embree robust: "));
}

TEST(ValidatePeers, WithoutOpenGlTheOthersRun) {
  const std::string command = "__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent.json " + program_path() +
                              " validate --against vtk,opengl,embree --scene sphere --size 32x24";
  const Outcome outcome = run({"/bin/sh", "-c", command});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, HasSubstr("the packages libegl1 and libgl1-mesa-dri provide it"));
  EXPECT_THAT(outcome.out, HasSubstr("sphere, embree robust: "));
}

TEST(ValidatePeers, WhatCannotBeWrittenIsSaidBeforeAnythingIsDrawn) {
  const TestFolder folder;
  folder.write("file", "");
  const Outcome outcome =
      run_fathom({"validate", "--against", "embree", "--scene", "sphere", "--out", "file"},
                 {.folder = folder.path()});
  EXPECT_EQ(outcome.status, 4);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, HasSubstr("file: cannot make this folder"));
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
