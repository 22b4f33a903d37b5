#include "fathom/attribution/judgement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/model/named_models.h"
#include "fathom/attribution/model_survey.h"
#include "fathom/attribution/other_scene.h"
#include "tests/attribution/sphere_maps.h"
#include "tests/special_values.h"

/// What is said of maps whose renderer was called by a wrong name.
namespace fathom::attribution {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using namespace fathom::test;

Judgement judged(const std::shared_ptr<const Truth>& truth, const OtherMap& map,
                 const std::string& model) {
  Judgement found = judge(truth, map, model_for(model, truth->camera));
  name_other_scene(truth->camera, map, found);
  return found;
}

std::vector<std::string> kinds(const Judgement& found) {
  std::vector<std::string> kinds;
  for (const Finding& finding : found.attribution.findings) kinds.push_back(finding.kind);
  return kinds;
}

std::size_t first_surface(const Truth& truth) {
  std::size_t i = truth.depths.size() / 2 + truth.camera.width / 2;
  while (!(truth.depths[i] < infinity)) ++i;
  return i;
}

// 24 bits between near 0.001 and far are coarser at depth 3 than binary32 is.
TEST(Judgement, ARightMapOfAnotherModelBlamesTheModelAlone) {
  const auto truth = sphere_seen_by(sphere_camera(0.001, 20));
  const Judgement found = judged(truth, in_codes(*truth, 24, 0.001, 20), "float32-ray");
  ASSERT_EQ(kinds(found), std::vector<std::string>{"model"});
  EXPECT_EQ(found.model.name.substr(0, 3), "gl-");
  EXPECT_EQ(found.attribution.count(PixelClass::unexplained), 0U);
  EXPECT_GT(found.attribution.findings[0].pixels, 16U);
  EXPECT_THAT(found.attribution.findings[0].text,
              StartsWith("the model float32-ray does not fit: as " + found.model.name +
                         " every pixel is explained"));
  EXPECT_THAT(found.attribution.findings[0].text,
              testing::EndsWith("; give the model " + found.model.name));
  EXPECT_THAT(found.attribution.findings[0].evidence,
              testing::Contains(StartsWith("gl-unorm24: ")));
}

// Where depths and outlines are those of the scene, it is the scene, whatever model was named.
TEST(Judgement, AShiftIsFoundThoughTheModelIsWrong) {
  const auto truth = sphere_seen_by(sphere_camera(0.01, 20));
  Camera aside = truth->camera;
  aside.projection.cx += 0.125;
  aside.projection.cy += 0.375;
  const Truth drawn = seen_by(*truth, aside);
  const Judgement found = judged(truth, in_codes(drawn, 24, 0.01, 20), "float32-ray");
  ASSERT_EQ(kinds(found), (std::vector<std::string>{"shift", "model"}))
      << cause_of(*found.truth, found.other, found.attribution);
  EXPECT_EQ(found.attribution.count(PixelClass::unexplained), 0U);
  const std::vector<Estimate>& shift = found.attribution.findings[0].estimates;
  ASSERT_EQ(shift.size(), 2U);
  EXPECT_NEAR(shift[0].value, 0.125, 0.001);
  EXPECT_NEAR(shift[1].value, 0.375, 0.001);
  EXPECT_THAT(found.attribution.findings[1].text,
              HasSubstr("does not fit: as " + found.model.name +
                        " the fault explains every pixel; give the model"));
  EXPECT_THAT(verdict_text(*found.truth, found.other, found.attribution),
              StartsWith("failed: the image is shifted by (-0.12"));
}

// A storage that is coarse would allow the pixel; but no code of it is what the others hold.
TEST(Judgement, APixelThatIsWrongByItselfIsUnexplainedWhateverOtherModelsAllow) {
  const auto truth = sphere_seen_by(sphere_camera(0.1, 20));
  OtherMap map = in_binary32(*truth);
  const std::size_t wrong = first_surface(*truth);
  map.depths[wrong] = map.values[wrong] = double{static_cast<float>(1.0002 * truth->depths[wrong])};
  const Judgement named = judged(truth, map, "float32-ray");
  EXPECT_EQ(kinds(named), std::vector<std::string>{"isolated-pixels"});
  EXPECT_EQ(named.model.name, "float32-ray");
  EXPECT_EQ(named.attribution.classes[wrong], PixelClass::unexplained);
  EXPECT_EQ(named.attribution.count(PixelClass::convention), 0U);
  const Judgement any = judge(truth, map, std::nullopt);
  EXPECT_EQ(kinds(any), std::vector<std::string>{"isolated-pixels"}) << any.model.name;
}

// Few pixels of a map of large pixels leave the bounds of rays, and those of Cycles are wide there.
TEST(Judgement, WherePixelsAreBlamedTheModelThatExplainsThemIsNamed) {
  Camera camera = look_from({.azimuth = 35, .elevation = 25}, {0, 0, 0}, 3,
                            {.width = 48, .height = 36, .vertical_fov = 45});
  camera.near = 0.011;
  camera.far = 100;
  const auto truth = sphere_seen_by(camera);
  const Judgement found = judged(truth, in_codes(*truth, 24, 0.011, 100), "float32-ray");
  EXPECT_EQ(found.model.name, "float32-ray");
  ASSERT_EQ(kinds(found), std::vector<std::string>{"isolated-pixels"});
  EXPECT_EQ(found.attribution.findings[0].alternatives, std::vector<std::string>{"model"});
  EXPECT_THAT(found.attribution.findings[0].text,
              HasSubstr("; or the model float32-ray does not fit: as "));
  EXPECT_THAT(found.attribution.findings[0].text, HasSubstr("gl-unorm24"));
}

/// Depths as integers of one scale, read with another.
OtherMap in_codes_of(const Truth& truth, double stored, double read,
                     double (*round)(double) = std::nearbyint) {
  OtherMap map = in_binary32(truth);
  for (double& depth : map.depths) {
    if (depth < infinity) depth = round(depth * stored) / read;
  }
  map.values = map.depths;
  map.code_scale = read;
  return map;
}

TEST(Judgement, AWrongScaleOfCodesIsNamed) {
  const auto truth = sphere_seen_by(sphere_camera(0.1, 100));
  const auto expect = [&](const OtherMap& map, const std::string& text) {
    for (const char* model : {"", "gl-unorm24", "float32-ray"}) {
      Judgement found = *model == 0 ? judge(truth, map, std::nullopt) : judged(truth, map, model);
      name_other_scene(truth->camera, map, found);
      ASSERT_EQ(kinds(found), std::vector<std::string>{"scale"})
          << text << cause_of(*found.truth, found.other, found.attribution);
      EXPECT_THAT(found.attribution.findings[0].text, HasSubstr(text));
      EXPECT_EQ(found.attribution.count(PixelClass::unexplained), 0U) << text;
    }
  };
  expect(in_codes_of(*truth, 1000, 5000), "stored = 0.2·depth: a unit has 1000 codes, not 5000");
  expect(in_codes_of(*truth, 5000, 1000), "stored = 5·depth: a unit has 5000 codes, not 1000");
  expect(in_codes_of(*truth, 256, 1000), "stored = 0.256·depth: a unit has 256 codes, not 1000");
  expect(in_codes_of(*truth, 100, 1000), "stored = 0.1·depth: a unit has 100 codes, not 1000");
  expect(in_codes_of(*truth, 1000, 5000, std::floor),
         "stored = 0.2·depth, rounded down: a unit has 1000 codes, not 5000");
}

TEST(Judgement, OtherCurvesAreNoFaultOfTheScene) {
  const auto truth = sphere_seen_by(sphere_camera(0.1, 100));
  const auto finding = [&](double (*stored)(double)) {
    OtherMap map = in_binary32(*truth);
    for (double& depth : map.depths) {
      if (depth < infinity) depth = double{static_cast<float>(stored(depth))};
    }
    map.values = map.depths;
    Judgement found = judge(truth, map, std::nullopt);
    name_other_scene(truth->camera, map, found);
    const std::vector<Finding>& findings = found.attribution.findings;
    return findings.empty() ? "" : findings[0].kind + ": " + findings[0].text;
  };
  EXPECT_THAT(finding([](double d) { return std::atan(2 * d - 4); }),
              StartsWith("decoding: the map stores a function of the depth, which rises with it"));
}

TEST(Judgement, WithoutNearAndFarItSaysThatNoRasterizerWasTried) {
  Camera camera = sphere_camera(0.001, 20);
  const auto clipped = sphere_seen_by(camera);
  camera.near = 0;
  camera.far = infinity;
  const auto truth = sphere_seen_by(camera);
  const Judgement found = judged(truth, in_codes(*clipped, 24, 0.001, 20), "float32-ray");
  ASSERT_FALSE(found.attribution.notes.empty());
  EXPECT_EQ(found.attribution.notes.back().kind, "model");
  EXPECT_THAT(found.attribution.notes.back().text, HasSubstr("has not both near and far"));
}

TEST(Judgement, AChosenModelWithoutNearAndFarIsNotTheOnlyOne) {
  Camera camera = sphere_camera(0.01, 20);
  const auto clipped = sphere_seen_by(camera);
  camera.near = 0;
  camera.far = infinity;
  const auto truth = sphere_seen_by(camera);
  const Judgement found = judge(truth, in_codes(*clipped, 24, 0.01, 20), std::nullopt);
  EXPECT_EQ(found.model.name, "cycles");
  EXPECT_EQ(found.attribution.count(PixelClass::unexplained), 0U);
  EXPECT_THAT(found.attribution.notes.back().text, HasSubstr("has not both near and far"));
  const Judgement of_rays = judge(truth, in_binary32(*truth), std::nullopt);
  EXPECT_EQ(of_rays.model.name, "float32-ray");
  for (const Finding& note : of_rays.attribution.notes)
    EXPECT_THAT(note.text, testing::Not(HasSubstr("has not both near and far")));
}

// A thousandth of noise, which no model has; a sphere on its background is not another scene for
// it.
TEST(Judgement, ASceneWithNoiseIsNoOtherScene) {
  const auto truth = sphere_seen_by(sphere_camera(0.5, 20));
  OtherMap map = in_binary32(*truth);
  std::uint32_t seed = 1;
  for (double& depth : map.depths) {
    seed = seed * 1664525U + 1013904223U;
    if (depth < infinity) depth *= 1 + ((seed >> 8) / 16777216.0 - 0.5) * 0.004;
  }
  map.values = map.depths;
  const Judgement found = judged(truth, map, "float32-ray");
  EXPECT_THAT(kinds(found), testing::Not(testing::Contains("other-scene")));
  EXPECT_THAT(cause_of(*found.truth, found.other, found.attribution), HasSubstr("unexplained"));
}

TEST(Judgement, AnotherSceneIsCalledSo) {
  const auto truth = sphere_seen_by(sphere_camera(0.5, 20));
  Camera elsewhere = truth->camera;
  elsewhere.projection.fx /= 3;
  elsewhere.projection.fy /= 5;
  const Judgement found = judged(truth, in_binary32(seen_by(*truth, elsewhere)), "gl-unorm24");
  EXPECT_TRUE(kinds(found) == std::vector<std::string>{"other-scene"} ||
              found.attribution.count(PixelClass::convention) > 0)
      << cause_of(*found.truth, found.other, found.attribution);
  OtherMap wall = in_binary32(*truth);
  for (std::size_t i = 0; i < wall.depths.size(); ++i) {
    wall.depths[i] = wall.values[i] = 1.0 + 0.001 * static_cast<double>(i % 160 * (i / 160) % 97);
  }
  const Judgement other = judged(truth, wall, "gl-unorm24");
  EXPECT_EQ(kinds(other), std::vector<std::string>{"other-scene"});
  EXPECT_THAT(other.attribution.findings[0].text, testing::Not(HasSubstr("  ")));
  EXPECT_THAT(other.attribution.findings[0].text, testing::Not(HasSubstr("values from 0 to 1")));
  for (std::size_t i = 0; i < wall.depths.size(); ++i) wall.values[i] = wall.depths[i] *= 0.5;
  const Judgement undecoded = judged(truth, wall, "gl-unorm24");
  ASSERT_EQ(kinds(undecoded), std::vector<std::string>{"other-scene"});
  EXPECT_THAT(undecoded.attribution.findings[0].text,
              testing::EndsWith("; values from 0 to 1: rows of a depth buffer from the bottom, not "
                                "decoded?"));
}

TEST(Judgement, AnotherSceneOfAnotherSizeHasTheSizes) {
  const auto seen_in = [](std::uint32_t width, std::uint32_t height) {
    Camera camera = look_from({.azimuth = 35, .elevation = 25}, {0, 0, 0}, 3,
                              {.width = width, .height = height, .vertical_fov = 90});
    camera.near = 0.5;
    camera.far = 20;
    return camera;
  };
  const auto drawn = sphere_seen_by(seen_in(120, 160));
  OtherMap map = in_binary32(*drawn);
  for (std::size_t i = 0; i < map.depths.size(); ++i) {
    const auto noise = static_cast<double>(i * 7919 % 101);
    map.depths[i] = map.values[i] = double{static_cast<float>(map.depths[i] * (2 + noise / 50))};
  }
  const Camera camera = seen_in(160, 120);
  const Judgement found = judge_map("map", map, bench::as_scene({bench::sphere(128)}, "sphere"),
                                    camera, model_for("gl-unorm24", camera));
  ASSERT_EQ(kinds(found), std::vector<std::string>{"other-scene"});
  EXPECT_THAT(found.attribution.findings[0].text,
              StartsWith("the map has 120x160 pixels, the camera 160x120; neither outlines nor"));
}

TEST(Judgement, AsksWhetherIntegersAreCodesOfADepthBuffer) {
  const Scene scene = bench::as_scene({bench::sphere(128)}, "sphere");
  OtherMap map{.width = 2, .height = 1, .depths = {9, 16777215}, .values = {9, 16777215}};
  map.triangles = {9, 16777215};
  const auto refusal = [&] {
    try {
      (void)judge_map("map", map, scene, Camera(), std::nullopt);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(refusal(), testing::HasSubstr("codes of a depth buffer? decode them"));
  map.values[0] = map.depths[0] = 2.5;  // depths and triangles in two channels
  EXPECT_THAT(refusal(), testing::EndsWith("expected the SCENE that it was drawn from"));
}

TEST(ForeignValues, OfCodesThereAreNoneInTheirOwnStorage) {
  const auto truth = sphere_seen_by(sphere_camera(0.1, 20));
  const Camera& camera = truth->camera;
  EXPECT_EQ(foreign_values(camera, in_codes(*truth, 16, 0.1, 20), model_named("gl-unorm16")), 0U);
  EXPECT_EQ(foreign_values(camera, in_codes(*truth, 24, 0.1, 20), model_named("gl-unorm24")), 0U);
  EXPECT_EQ(foreign_values(camera, in_binary32(*truth), model_named("float32-ray")), 0U);
  EXPECT_EQ(foreign_values(camera, in_binary32(*truth), model_named("gl-float32-reversed")), 0U);
}

// Nearly every depth lies between two codes of 16 bits; of 24 bits there are too few codes for
// them, where near is so small that a code is 10⁻³ of the depth.
TEST(ForeignValues, OfDepthsInBinary32MostAreForeignToACoarseStorage) {
  const auto truth = sphere_seen_by(sphere_camera(0.00005, 20));
  std::uint64_t surfaces = 0;
  for (const double depth : truth->depths) surfaces += depth < infinity ? 1 : 0;
  const OtherMap map = in_binary32(*truth);
  EXPECT_GT(foreign_values(truth->camera, map, model_named("gl-unorm24")), surfaces / 2);
  Camera ordinary = truth->camera;
  ordinary.near = 0.1;
  EXPECT_GT(foreign_values(ordinary, map, model_named("gl-unorm16")), surfaces / 2);
}

}  // namespace
}  // namespace fathom::attribution
