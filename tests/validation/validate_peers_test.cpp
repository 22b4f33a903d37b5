#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/apps/run_program.h"
#include "tests/apps/test_folder.h"
#include "tests/places.h"

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

// Every way but those of several samples, of which the driver says how many it offers: each of
// OpenGL's is granted as it is asked for; VTK is asked for 8 in any case.
TEST(ValidatePeers, EveryPixelIsExplained) {
  const auto results = results_of("opengl,vtk,embree", "sphere,calibrated,orthographic");
  std::size_t single = 0, several = 0;
  for (const auto& result : results) {
    EXPECT_EQ(result["pixels"]["unexplained"], 0) << result.dump();
    EXPECT_TRUE(result["findings"].empty()) << result.dump();
    EXPECT_LT(result["bounds"]["may_share"], 0.1) << result.dump();
    const std::string variant = result["variant"], version = result["version"];
    if (variant.find(" samples") == std::string::npos) {
      ++single;
    } else if (result["renderer"] == "opengl") {
      const std::string count = variant.substr(variant.find(' ') + 1);
      EXPECT_THAT(version, HasSubstr(", " + count + " granted"));
      EXPECT_EQ(result["errors"]["pixels"] > 0, true);
      ++several;
    }
  }
  EXPECT_EQ(single, 3U * (6 + 9 + 2));
  EXPECT_GT(several, 0U);  // OpenGL 4.5 demands 4 samples of depth ([GL46] table 23.60)
}

// The wall at 8000, seen by three quarters of the pixels, is not told from far at 10⁷ times near by
// a depth that passes through z_ndc/2 + 1/2; the others tell it.
TEST(ValidatePeers, ReversedAndLogarithmicDepthsReachFar) {
  const TestFolder folder;
  const Outcome outcome = run_fathom(
      {"validate", "--against", "vtk", "--scene", "range", "--size", "64x48", "--variants",
       "unorm24,float32 reversed,float32 reversed by shader,float32 logarithmic", "--out",
       "report"},
      {.folder = folder.path()});
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  const auto results = nlohmann::json::parse(folder.read("report/report.json"))["results"];
  ASSERT_EQ(results.size(), 4U);
  for (const auto& result : results) {
    const int edge = result["pixels"]["edge"];
    const double typical = result["errors"]["median_relative"];
    if (result["variant"] == "unorm24") {
      EXPECT_GT(edge, 64 * 48 / 2);
    } else {
      EXPECT_LT(edge, 64 * 48 / 50) << result["variant"];
      EXPECT_LT(typical, 2e-6) << result["variant"];
    }
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

TEST(ValidatePeers, WithoutSurfacelessContextsAnXvfbIsStartedAndEnded) {
  const TestFolder folder;
  const Outcome outcome = validate_on_xvfb(folder, real_server, "--out report");
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, HasSubstr("status 0"));
  EXPECT_THAT(outcome.out, HasSubstr("all servers are gone"));
  const auto result = nlohmann::json::parse(folder.read("report/report.json"))["results"][0];
  EXPECT_THAT(std::string(result["version"]), testing::EndsWith(", on Xvfb"));
  EXPECT_EQ(result["pixels"]["unexplained"], 0);
}

TEST(ValidatePeers, AnXvfbThatHangsIsEndedWithTheRenderer) {
  const TestFolder folder;
  const Outcome outcome = validate_on_xvfb(folder, "exec sleep 600\n", "--time-limit 2");
  EXPECT_THAT(outcome.out, HasSubstr("did not end within 2 seconds"));
  EXPECT_THAT(outcome.out, HasSubstr("status 3"));
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, HasSubstr("all servers are gone"));
}

TEST(ValidatePeers, AnInterruptedRunEndsItsXvfb) {
  const TestFolder folder;
  const Outcome outcome = validate_on_xvfb(folder, "exec sleep 600\n", "--out report",
                                           "until [ -s pids ]; do sleep 0.05; done; kill -TERM $!");
  EXPECT_THAT(outcome.out, HasSubstr("status 130"));
  EXPECT_THAT(outcome.out, HasSubstr("all servers are gone"));
}

TEST(ValidatePeers, WithoutXvfbTheMessageSaysWhatToInstall) {
  const std::string command = "PATH=/nonexistent FATHOM_OPENGL_DISPLAY=xvfb " + program_path() +
                              " validate --against vtk,opengl --scene sphere --size 32x24"
                              " --variants unorm24";
  const Outcome outcome = run({"/bin/sh", "-c", command});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 2) << outcome.out;
  EXPECT_THAT(outcome.out, HasSubstr("the packages libegl1 and libgl1-mesa-dri provide it"));
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

// VTK's pictures and the pipeline's, of meshes seen from outside and, of the house's roof, inside.
TEST(ValidatePeers, ColoursAreThoseOfTheFormulas) {
  const std::string cube = source_dir() / "data/meshes/cube.obj";
  const std::string house = source_dir() / "data/meshes/house.gltf";
  const std::vector<std::vector<std::string>> scenes{{"--scene", "sphere,spot"}, {cube}, {house}};
  for (const auto& scene : scenes) {
    std::vector<std::string> arguments{"validate", "--colour", "--size", "128x96"};
    arguments.insert(arguments.end(), scene.begin(), scene.end());
    const Outcome outcome = run_fathom(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("phong, VTK Gouraud: "));
    EXPECT_THAT(outcome.out, HasSubstr(" background, 0 unexplained\n"));
  }
  const TestFolder folder;
  EXPECT_EQ(
      run_fathom({"validate", "--colour", "--scene", "sphere", "--size", "32x24", "--out", "r"},
                 {.folder = folder.path()})
          .status,
      0);
  const auto results = nlohmann::json::parse(folder.read("r/colours.json"))["results"];
  ASSERT_EQ(results.size(), 5U);
  for (const auto& result : results) {
    EXPECT_EQ(result["pixels"]["unexplained"], 0);
    EXPECT_GT(result["pixels"]["inside"], 300);
  }
  EXPECT_EQ(folder.read("r/sphere-gouraud.png").substr(1, 3), "PNG");
}

TEST(ValidatePeers, ColoursThatCannotBeComparedAreRefused) {
  const Outcome outcome =
      run_fathom({"validate", "--colour", "--scene", "orthographic,sphere", "--size", "32x24"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.out, HasSubstr("colours are compared for perspective cameras"));
  EXPECT_THAT(outcome.out, HasSubstr("sphere: phong, VTK Phong: "));
  EXPECT_EQ(run_fathom({"validate", "--colour", "--against", "vtk"}).status, 2);
  for (const auto& option : {"--variants", "--baseline", "--model", "--channel", "-o"}) {
    const Outcome refused = run_fathom({"validate", "--colour", option, "x"});
    EXPECT_EQ(refused.status, 2) << option;
    EXPECT_THAT(refused.err, HasSubstr("has no meaning with --colour"));
  }
  const Outcome missing = run_fathom({"validate", "--colour", "missing.obj"});
  EXPECT_EQ(missing.status, 3);
  EXPECT_THAT(missing.err, HasSubstr("missing.obj: cannot be opened"));
}

TEST(ValidatePeers, WhatTheOtherDrewIsAMapOfOurs) {
  const TestFolder folder;
  const std::string cube = source_dir() / "data/meshes/cube.obj";
  const Outcome outcome =
      run_fathom({"validate", "--render", "vtk", cube, "--size", "40x30", "-o", "vtk.exr"},
                 {.folder = folder.path()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(run_fathom({"info", "vtk.exr"}, {.folder = folder.path()}).status, 0);
}

}  // namespace
}  // namespace fathom::test
