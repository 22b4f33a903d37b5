#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "tests/apps/run_program.h"
#include "tests/apps/test_folder.h"
#include "tests/places.h"
#include "tests/validation/validate/validate_runs.h"

/// `fathom validate` with VTK as it is installed (FATHOM_PEERS): its depths and its colours.
namespace fathom::test {
namespace {

using testing::HasSubstr;

TEST(ValidateVtk, EveryVariantIsExplained) {
  std::size_t single = 0, several = 0;
  for (const auto& result : results_of("vtk", "sphere,orthographic")) {
    expect_explained(result);
    ++(is_multisampled(result) ? several : single);
  }
  EXPECT_EQ(single, 2U * 11);
  EXPECT_GT(several, 0U);  // its default, 8, is always asked for
}

/// All that a number has.
std::string digits(double number) {
  return nlohmann::json(number).dump();
}

/// Exercise 3 of the course with the nearer sheet first in the file: two oblique sheets, one 0.0001
/// behind the other.
void write_sheets(const TestFolder& folder, double distance) {
  const double d = distance, s = distance / 3;
  const double corners[4][3] = {{-s, -s, d}, {s, -s, d * 1.2}, {s, s, d * 1.4}, {-s, s, d * 1.2}};
  std::string obj;
  for (const double behind : {0.0, 0.0001})
    for (const auto& [x, y, z] : corners)
      obj += "v " + digits(x * (z + behind) / z) + " " + digits(y * (z + behind) / z) + " " +
             digits(z + behind) + "\n";
  folder.write("sheets.obj", obj + "f 1 2 3\nf 1 3 4\nf 5 6 7\nf 5 7 8\n");
}

void write_front_camera(const TestFolder& folder) {
  folder.write("camera.json", R"({"width": 96, "height": 96, "fx": 96, "fy": 96, "cx": 48, "cy": 48,
    "pixel_centre": 0.5, "world_to_camera": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]],
    "near": 0.001, "far": 1000})");
}

/// The results of a run on sheets.obj, by the names of their variants; all explained.
std::map<std::string, nlohmann::json> results_on_sheets(const TestFolder& folder,
                                                        const std::string& renderer) {
  const Outcome outcome = run_fathom({"validate", "sheets.obj", "--camera", "camera.json",
                                      "--against", renderer, "--out", "report"},
                                     {.folder = folder.path()});
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  std::map<std::string, nlohmann::json> found;
  const auto report = nlohmann::json::parse(folder.read("report/report.json"));
  for (const auto& result : report["results"]) {
    EXPECT_EQ(result["pixels"]["unexplained"], 0) << result.dump();
    found[result["variant"]] = result;
  }
  return found;
}

// Pixels at which the wrong sheet certainly covers the sample. tests/validation/peers_test.cpp has
// all pixels that show it, 2610 and 2874 of 2931: the rest of them are edges.
TEST(ValidateVtk, WrongSheetsAreCounted) {
  using Counts = std::map<std::string, int>;
  const Counts at_2{
      {"own", 2560}, {"unorm16", 2862}, {"unorm24", 2560}, {"unorm32", 2560}, {"float32", 2560}};
  const Counts at_10{
      {"own", 2809}, {"unorm16", 2862}, {"unorm24", 2809}, {"unorm32", 2809}, {"float32", 2809}};
  for (const auto& [distance, counts] : {std::pair{2.0, at_2}, {10.0, at_10}}) {
    const TestFolder folder;
    write_sheets(folder, distance);
    write_front_camera(folder);
    auto found = results_on_sheets(folder, "vtk");
    for (const auto& [variant, count] : counts) {
      const auto& result = found[variant];
      EXPECT_EQ(result["z_fighting"]["pixels"], count) << distance << " " << variant;
      EXPECT_EQ(result["pixels"]["z-fight"], count);
      // Exact depths of 32 bits tell the sheets apart; those of 24 bits do not.
      const int by_format = result["z_fighting"]["by_format_alone"];
      EXPECT_EQ(by_format == 0, variant == "own" || variant == "unorm32") << variant;
    }
    // Peeled layers are blended: nobody knows which sheet a pixel shows.
    EXPECT_EQ(found["own peeled"]["z_fighting"]["triangle_numbers"], false);
    EXPECT_EQ(found["own peeled"]["z_fighting"]["pixels"], nullptr);
    EXPECT_EQ(found["own behind peeled"]["z_fighting"], found["own"]["z_fighting"]);
  }
}

// The wall at 8000, seen by three quarters of the pixels, is not told from far at 10⁷ times near by
// a depth that passes through z_ndc/2 + 1/2; the others tell it.
TEST(ValidateVtk, ReversedAndLogarithmicDepthsReachFar) {
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
      // 176: VTK's positions move the facets of the nearest spheres, and their numbers show it.
      EXPECT_LT(edge, 64 * 48 / 16) << result["variant"];
      EXPECT_LT(typical, 2e-6) << result["variant"];
    }
  }
}

// Something translucent in front leaves no trace in VTK's depth buffer.
TEST(ValidateVtk, APaneThatIsPeeledLeavesDepthsAsTheyAre) {
  const TestFolder folder;
  const std::string cube = source_dir() / "data/meshes/cube.obj";
  const auto drawn = [&](const std::string& variant, const std::string& file) {
    const Outcome outcome = run_fathom(
        {"validate", "--render", "vtk", cube, "--size", "40x30", "--variants", variant, "-o", file},
        {.folder = folder.path()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return folder.read(file);
  };
  EXPECT_TRUE(drawn("own behind peeled", "behind.pfm") == drawn("own", "own.pfm"));
}

// The catalogue of faults in VTK's own map: nothing is found in the right one, and every fault that
// is large enough is rightly named.
TEST(ValidateVtk, FaultsInItsMapAreFoundAndNamed) {
  const TestFolder folder;
  const Outcome outcome = run_fathom({"validate", "--faults", "--against", "vtk", "--scene", "spot",
                                      "--size", "160x120", "--out", "faults"},
                                     {.folder = folder.path()});
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("1 right map; "));
  const auto faults = nlohmann::json::parse(folder.read("faults/faults.json"))["faults"];
  EXPECT_GE(faults.size(), 100U);
  EXPECT_THAT(folder.read("faults/faults.md"), HasSubstr("| camera | roll |"));
}

// VTK's pictures and the pipeline's, of meshes seen from outside and, of the house's roof, inside.
TEST(ValidateVtk, ColoursAreThoseOfTheFormulas) {
  const std::string cube = source_dir() / "data/meshes/cube.obj";
  const std::string house = source_dir() / "data/meshes/house.gltf";
  for (const auto& mesh : {cube, house}) {
    const Outcome outcome = run_fathom({"validate", "--colour", "--size", "128x96", mesh});
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

TEST(ValidateVtk, ColoursThatCannotBeComparedAreRefused) {
  const Outcome outcome =
      run_fathom({"validate", "--colour", "--scene", "orthographic,sphere", "--size", "32x24"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.out, HasSubstr("colours are compared for perspective cameras"));
  EXPECT_THAT(outcome.out, HasSubstr("sphere: phong, VTK Phong: "));
  EXPECT_EQ(run_fathom({"validate", "--colour", "--against", "vtk"}).status, 2);
  for (const auto& option : {"--variants", "--baseline", "--model", "--channel"}) {
    const std::string value = option == std::string("--model") ? "float32-ray" : "x";
    const Outcome refused = run_fathom({"validate", "--colour", option, value});
    EXPECT_EQ(refused.status, 2) << option;
    EXPECT_THAT(refused.err, HasSubstr("has no meaning with --colour"));
  }
  const Outcome missing = run_fathom({"validate", "--colour", "missing.obj"});
  EXPECT_EQ(missing.status, 3);
  EXPECT_THAT(missing.err, HasSubstr("missing.obj: cannot be opened"));
}

TEST(ValidateVtk, WhatTheOtherDrewIsAMapOfOurs) {
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
