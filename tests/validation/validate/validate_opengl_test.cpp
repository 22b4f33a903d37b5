#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/apps/run_program.h"
#include "tests/apps/test_folder.h"
#include "tests/places.h"
#include "tests/validation/validate/validate_runs.h"

/// `fathom validate` with OpenGL as it is installed (FATHOM_PEERS), on surfaces without a display
/// and on Xvfb.
namespace fathom::test {
namespace {

using testing::HasSubstr;

// Each number of samples that the driver offers is granted as it is asked for.
TEST(ValidateOpenGl, EveryVariantIsExplained) {
  std::size_t single = 0, several = 0;
  for (const auto& result : results_of("opengl", "sphere,orthographic")) {
    expect_explained(result);
    if (!is_multisampled(result)) {
      ++single;
    } else {
      const std::string variant = result["variant"], version = result["version"];
      const std::string count = variant.substr(variant.find(' ') + 1);
      EXPECT_THAT(version, HasSubstr(", " + count + " granted"));
      EXPECT_GT(result["errors"]["pixels"], 0);
      ++several;
    }
  }
  EXPECT_EQ(single, 2U * 6);
  EXPECT_GT(several, 0U);  // OpenGL 4.5 demands 4 samples of depth ([GL46] table 23.60)
}

// One triangle, 16 pixels wide: softpipe steps a depth of 16 bits from pixel to pixel by a whole
// number of codes, rounded towards zero, so that it drifts by up to a code a pixel
// (docs/validation.md).
TEST(ValidateOpenGl, SoftpipesStepsOf16BitsAreFound) {
  const TestFolder folder;
  folder.write("sheet.obj", "v -4 -4 3\nv 4 -4 4\nv 0 8 3.5\nf 1 2 3\n");
  folder.write("camera.json",
               R"({"width": 16, "height": 2, "projection": "perspective", "fx": 16, "fy": 16,
                   "cx": 8, "cy": 1, "world_to_camera": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]],
                   "near": 1, "far": 10, "pixel_centre": 0.5})");
  const Outcome outcome =
      run_fathom({"validate", "--against", "opengl@softpipe,opengl", "sheet.obj", "--camera",
                  "camera.json", "--variants", "unorm16,unorm24", "--out", "report"},
                 {.folder = folder.path()});
  EXPECT_EQ(outcome.status, 1) << outcome.out << outcome.err;
  const auto results = nlohmann::json::parse(folder.read("report/report.json"))["results"];
  ASSERT_EQ(results.size(), 4U);
  for (const auto& result : results) {
    const bool drifts = result["renderer"] == "opengl@softpipe" && result["variant"] == "unorm16";
    EXPECT_EQ(result["pixels"]["unexplained"] > 0, drifts) << result.dump();
    const std::string version = result["version"];
    EXPECT_EQ(version.find("softpipe") != std::string::npos,
              result["renderer"] == "opengl@softpipe");
  }
}

TEST(ValidateOpenGl, ADriverThatIsNotThereIsNamed) {
  const std::string command = "LIBGL_DRIVERS_PATH=/nonexistent " + program_path() +
                              " validate --against opengl@softpipe,embree --scene sphere --size "
                              "32x24 --variants unorm24,robust";
  const Outcome outcome = run({"/bin/sh", "-c", command});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, HasSubstr("softpipe: OpenGL has no such driver here; a Mesa that is "
                                     "built with it provides it"));
  EXPECT_THAT(outcome.out, HasSubstr("sphere, embree robust: "));
}

TEST(ValidateOpenGl, SamplesThatADriverDoesNotOfferAreRefused) {
  const TestFolder folder;
  const Outcome outcome =
      run_fathom({"validate", "--render", "opengl@softpipe", "--variants", "unorm24 4 samples",
                  source_dir() / "data/meshes/cube.obj", "--size", "32x24", "-o", "cube.exr"},
                 {.folder = folder.path()});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, HasSubstr("no framebuffer with this depth attachment and 4 samples"));
}

/// A shell that runs `fathom validate --against opengl` on an Xvfb which is ours: `server` is
/// what stands in its place. Says whether all that were started are gone afterwards; half a minute
/// is for a machine that has other things to do.
Outcome validate_on_xvfb(const TestFolder& folder, const std::string& server,
                         const std::string& arguments, const std::string& then = "") {
  folder.write("Xvfb", "#!/bin/sh\necho $$ >>pids\n" + server);
  const std::string script =
      "chmod +x Xvfb; export PATH=$PWD:$PATH FATHOM_OPENGL_DISPLAY=xvfb\n" + program_path() +
      " validate --against opengl --variants unorm24 --scene sphere --size 32x24 " + arguments +
      " &\n" + then +
      "\nwait $!; echo status $?\n"
      "for i in $(seq 600); do\n"
      "  left=0; for p in $(cat pids); do kill -0 $p 2>/dev/null && left=1; done\n"
      "  [ $left = 0 ] && echo all servers are gone && break\n"
      "  sleep 0.05\n"
      "done\n";
  return run({"timeout", "60", "/bin/sh", "-c", script}, {.folder = folder.path()});
}

const std::string real_server = "PATH=${PATH#*:} exec Xvfb \"$@\"\n";

TEST(ValidateOpenGl, WithoutSurfacelessContextsAnXvfbIsStartedAndEnded) {
  const TestFolder folder;
  const Outcome outcome = validate_on_xvfb(folder, real_server, "--out report");
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, HasSubstr("status 0"));
  EXPECT_THAT(outcome.out, HasSubstr("all servers are gone"));
  const auto result = nlohmann::json::parse(folder.read("report/report.json"))["results"][0];
  EXPECT_THAT(std::string(result["version"]), testing::EndsWith(", on Xvfb"));
  EXPECT_EQ(result["pixels"]["unexplained"], 0);
}

TEST(ValidateOpenGl, AnXvfbThatHangsIsEndedWithTheRenderer) {
  const TestFolder folder;
  const Outcome outcome = validate_on_xvfb(folder, "exec sleep 600\n", "--time-limit 2");
  EXPECT_THAT(outcome.out, HasSubstr("did not end within 2 seconds"));
  EXPECT_THAT(outcome.out, HasSubstr("status 3"));
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, HasSubstr("all servers are gone"));
}

TEST(ValidateOpenGl, AnInterruptedRunEndsItsXvfb) {
  const TestFolder folder;
  const Outcome outcome = validate_on_xvfb(folder, "exec sleep 600\n", "--out report",
                                           "until [ -s pids ]; do sleep 0.05; done; kill -TERM $!");
  EXPECT_THAT(outcome.out, HasSubstr("status 130"));
  EXPECT_THAT(outcome.out, HasSubstr("all servers are gone"));
}

}  // namespace
}  // namespace fathom::test
