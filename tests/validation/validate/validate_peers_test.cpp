#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/apps/run_program.h"
#include "tests/apps/test_folder.h"
#include "tests/places.h"
#include "tests/validation/validate/validate_runs.h"

/// `fathom validate --against …` with several renderers that are really there (FATHOM_PEERS), or
/// not.
namespace fathom::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

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

TEST(ValidatePeers, WithoutOpenGlTheOthersRun) {
  const std::string command = "__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent.json " + program_path() +
                              " validate --against vtk,opengl,embree --scene sphere --size 32x24";
  const Outcome outcome = run({"/bin/sh", "-c", command});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, HasSubstr("the packages libegl1 and libgl1-mesa-dri provide it"));
  EXPECT_THAT(outcome.out, HasSubstr("sphere, embree robust: "));
}

TEST(ValidatePeers, WithoutXvfbTheMessageSaysWhatToInstall) {
  const std::string command = "PATH=/nonexistent FATHOM_OPENGL_DISPLAY=xvfb " + program_path() +
                              " validate --against vtk,opengl --scene sphere --size 32x24"
                              " --variants unorm24";
  const Outcome outcome = run({"/bin/sh", "-c", command});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, StartsWith("no map was drawn\n"));
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 3) << outcome.out;
  EXPECT_THAT(outcome.out, HasSubstr("the packages libegl1 and libgl1-mesa-dri provide it"));
}

}  // namespace
}  // namespace fathom::test
