#include "fathom/attribution/model_choice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fathom/attribution/model/named_models.h"
#include "tests/attribution/sphere_maps.h"
#include "tests/special_values.h"

namespace fathom::attribution {
namespace {

Truth sphere(double near, double far) {
  return *test::sphere_seen_by(test::sphere_camera(near, far));
}

OtherMap in_codes(const Truth& truth, int bits) {
  return test::in_codes(truth, bits, truth.camera.near, truth.camera.far);
}

// Pixels are so small that a thousandth of one, by which Cycles may be off, is less than a code.
TEST(ModelChoice, SixteenBits) {
  const Truth truth = sphere(0.5, 20);
  const ModelChoice choice = chosen_model(truth, in_codes(truth, 16));
  EXPECT_EQ(choice.chosen.model.name, "gl-unorm16") << testing::PrintToString(choice.evidence);
  EXPECT_EQ(choice.chosen.attribution.count(PixelClass::unexplained), 0U);
  ASSERT_EQ(choice.evidence.size(), 7U);  // none of VTK's is needed
  EXPECT_THAT(choice.evidence[0],
              testing::StartsWith("gl-unorm16: every pixel is explained, bounds "));
}

// Of those that explain all, the one with the narrowest bounds.
TEST(ModelChoice, TheNarrowest) {
  const Truth truth = sphere(0.5, 20);
  const ModelChoice choice = chosen_model(truth, in_codes(truth, 52));
  const double width = choice.chosen.attribution.sharpness.median_relative_width;
  for (const RendererModel& model : named_models()) {
    const Attribution other = attribute(truth, in_codes(truth, 52), model);
    EXPECT_EQ(other.count(PixelClass::unexplained), 0U);
    EXPECT_LE(width, other.sharpness.median_relative_width) << model.name;
  }
}

/// A room of five walls, from within: walls pass the eye, so that a reversed depth buffer may hold
/// anything at all pixels.
Truth room_from_within() {
  Mesh room;
  for (const double z : {-2.3, -6.0})
    for (const double y : {-1.3, 1.3})
      for (const double x : {-1.9, 1.9}) room.vertices.push_back({x, y, z});
  room.triangles = {{4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4}, {2, 6, 7},
                    {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  Camera camera = look_at({0.3, 0.2, -4}, {0.1, 0, -6}, {0, 1, 0},
                          {.width = 128, .height = 96, .vertical_fov = 70});
  camera.near = 0.05;
  camera.far = 20;
  return make_truth(bench::as_scene({room}, "room"), camera);
}

TEST(ModelChoice, AWrongNearPrecedesBoundsThatDecideNothing) {
  const Truth truth = room_from_within();
  for (const double near : {0.025, 0.1, 0.5}) {
    const ModelChoice choice = chosen_model(truth, test::in_misread_codes(truth, 32, near, 20));
    const Attribution& found = choice.chosen.attribution;
    EXPECT_EQ(found.count(PixelClass::unexplained), 0U) << testing::PrintToString(choice.evidence);
    ASSERT_EQ(found.findings.size(), 1U) << near;
    EXPECT_EQ(found.findings[0].kind, "decoding") << found.findings[0].text;
  }
}

TEST(ModelChoice, CodesBetweenOtherPlanes) {
  const Truth truth = room_from_within();
  const ModelChoice choice = chosen_model(truth, test::in_codes(truth, 16, 0.025, 20));
  ASSERT_EQ(choice.chosen.attribution.findings.size(), 1U);
  EXPECT_EQ(choice.chosen.attribution.findings[0].kind, "clip-planes");
  EXPECT_EQ(choice.chosen.model.name, "gl-unorm16");
}

/// Depths that no surface has. Only bounds that allow nearly any depth explain them.
OtherMap scattered(const Truth& truth) {
  OtherMap map = test::in_binary32(truth);
  for (std::size_t i = 0; i < map.depths.size(); ++i) {
    map.depths[i] *= 0.5 + 0.03125 * static_cast<double>(i * i % 13);
  }
  map.values = map.depths;
  return map;
}

TEST(ModelChoice, CannotTell) {
  const Truth truth = room_from_within();
  const OtherMap map = scattered(truth);
  const Attribution found = chosen_model(truth, map).chosen.attribution;
  ASSERT_EQ(found.findings.size(), 1U);
  EXPECT_EQ(found.findings[0].kind, "undecided");
  EXPECT_THAT(verdict_text(truth, map, found),
              testing::StartsWith("cannot tell: as gl-float32-reversed every pixel is explained, "
                                  "but nearly any depth is allowed; give the near, "));
  EXPECT_GT(found.sharpness.loose_share, 0.9);
}

// It may have drawn the map. Nothing is blamed, and the verdict is not that the map is right.
TEST(ModelChoice, ANamedModelThatDecidesNothingCannotTell) {
  const Truth truth = room_from_within();
  const OtherMap map = scattered(truth);
  const ModelTrial mine = judged_by(truth, map, model_named("gl-float32-reversed"));
  EXPECT_EQ(mine.model.name, "gl-float32-reversed");
  EXPECT_TRUE(mine.attribution.findings.empty());
  ASSERT_EQ(mine.attribution.notes.size(), 1U);
  EXPECT_EQ(mine.attribution.notes[0].kind, "undecided");
  EXPECT_EQ(verdict_text(truth, map, mine.attribution),
            "cannot tell: as gl-float32-reversed every pixel is explained, but nearly any depth is "
            "allowed (12288 pixels)");
}

TEST(ModelChoice, ANamedModelThatDecidesNothingNotesAFaultByAnotherModel) {
  const Truth truth = room_from_within();
  for (const double near : {0.025, 0.1, 0.5}) {
    const OtherMap map = test::in_misread_codes(truth, 32, near, 20);
    const ModelTrial mine = judged_by(truth, map, model_named("gl-float32-reversed"));
    const Attribution& found = mine.attribution;
    // With near at 0.025 depths are greater than the bounds allow.
    if (near == 0.025) {
      ASSERT_FALSE(found.findings.empty());
      EXPECT_EQ(found.findings[0].kind, "decoding") << found.findings[0].text;
      continue;
    }
    EXPECT_TRUE(found.findings.empty()) << found.findings[0].text;
    EXPECT_THAT(verdict_text(truth, map, found),
                testing::AllOf(testing::StartsWith("cannot tell: as gl-float32-reversed "),
                               testing::HasSubstr(" a fault explains every pixel: depths were "
                                                  "decoded with ")));
  }
}

TEST(ModelChoice, AWrongNearIsNoReasonToNameAModelThatDecidesNothing) {
  const Truth truth = room_from_within();
  for (const char* named : {"gl-unorm24", "gl-float32", "float32-ray"}) {
    for (const double near : {0.025, 0.1, 0.5}) {
      const OtherMap map = test::in_misread_codes(truth, 32, near, 20);
      const Attribution found = judged_by(truth, map, model_named(named)).attribution;
      EXPECT_EQ(found.count(PixelClass::unexplained), 0U) << named << near;
      ASSERT_EQ(found.findings.size(), 1U) << named << near;
      EXPECT_EQ(found.findings[0].kind, "decoding") << found.findings[0].text;
    }
  }
}

TEST(ModelChoice, NoModelThatDecidesSomethingExplains) {
  const Truth truth = room_from_within();
  const ModelTrial wide = judged_by(truth, scattered(truth), model_named("gl-unorm24"));
  EXPECT_EQ(wide.model.name, "gl-float32-reversed");
  ASSERT_EQ(wide.attribution.findings.size(), 1U);
  EXPECT_EQ(wide.attribution.findings[0].kind, "model");
  EXPECT_EQ(
      wide.attribution.findings[0].text,
      "the model gl-unorm24 does not fit: as gl-float32-reversed every pixel is explained, "
      "but nearly any depth is allowed; give the near, the far and the model of the renderer");
}

TEST(ModelChoice, ANarrowerModelAcquitsForANamedModelThatDecidesNothing) {
  const Truth truth = room_from_within();
  const RendererModel reversed = model_named("gl-float32-reversed");
  const ModelTrial right = judged_by(truth, test::in_binary32(truth), reversed);
  EXPECT_EQ(right.attribution.count(PixelClass::unexplained), 0U);
  EXPECT_TRUE(right.attribution.findings.empty()) << right.attribution.findings[0].text;
  EXPECT_EQ(right.model.name, "float32-ray");
  ASSERT_EQ(right.attribution.notes.size(), 1U);
  EXPECT_EQ(right.attribution.notes[0].text,
            "as gl-float32-reversed nearly any depth is allowed; judged as float32-ray, within "
            "narrower bounds");
}

TEST(ModelChoice, WithoutFarOnlyRays) {
  const Truth truth = sphere(0, infinity);
  const ModelChoice choice = chosen_model(truth, test::in_binary32(truth));
  EXPECT_EQ(choice.chosen.model.name, "float32-ray");
  EXPECT_EQ(choice.evidence.size(), 2U);
}

}  // namespace
}  // namespace fathom::attribution
