#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "fathom/attribution/faults/storage.h"
#include "fathom/attribution/judgement.h"
#include "fathom/attribution/model/named_models.h"
#include "tests/attribution/sphere_maps.h"

/// Maps that were stored between a near and a far that the camera does not have.
namespace fathom::attribution {
namespace {

using namespace fathom::test;

struct Stored {
  std::string model;
  int bits;
  ClipPlanes camera, map;
};

std::vector<Stored> stored_maps() {
  return {{"gl-unorm24", 24, {0.1, 100}, {0.001, 100}},
          {"gl-unorm24", 24, {0.1, 20}, {0.0005, 1500}},
          {"gl-unorm16", 16, {0.5, 20}, {0.1, 20}},
          {"gl-unorm16", 16, {0.5, 20}, {0.125, 1000}},
          {"gl-unorm16", 16, {0.01, 100}, {0.1, 50}}};
}

class StoredPlanesOf : public testing::TestWithParam<Stored> {};

TEST_P(StoredPlanesOf, AreReadOffTheMap) {
  const auto& [model, bits, given, drawn] = GetParam();
  const auto truth = sphere_seen_by(sphere_camera(given.near, given.far));
  const OtherMap map = in_codes(*truth, bits, drawn.near, drawn.far);
  const std::optional<ClipPlanes> found = stored_planes(truth->camera, map, model_named(model));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->near, drawn.near);
  EXPECT_EQ(found->far, drawn.far);
}

INSTANTIATE_TEST_SUITE_P(Maps, StoredPlanesOf, testing::ValuesIn(stored_maps()));

TEST(StoredPlanes, OfARightMapAreThoseOfTheCamera) {
  for (const double near : {0.001, 0.1}) {
    const auto truth = sphere_seen_by(sphere_camera(near, 100));
    for (const int bits : {16, 24}) {
      const RendererModel model = model_named("gl-unorm" + std::to_string(bits));
      EXPECT_FALSE(stored_planes(truth->camera, in_codes(*truth, bits, near, 100), model));
    }
    EXPECT_FALSE(stored_planes(truth->camera, in_binary32(*truth), model_named("gl-unorm24")));
    EXPECT_FALSE(stored_planes(truth->camera, in_binary32(*truth), model_named("float32-ray")));
  }
}

TEST(StoredPlanes, AreTheFindingWithTheModelNamedAndWithout) {
  const auto truth = sphere_seen_by(sphere_camera(0.1, 100));
  const OtherMap map = in_codes(*truth, 24, 0.001, 100);
  const std::optional<RendererModel> named = model_named("gl-unorm24");
  for (const auto& model : {named, std::optional<RendererModel>()}) {
    const Judgement found = judge(truth, map, model);
    EXPECT_EQ(found.model.name, "gl-unorm24");
    EXPECT_EQ(found.attribution.count(PixelClass::unexplained), 0U);
    ASSERT_EQ(found.attribution.findings.size(), 1U);
    EXPECT_EQ(found.attribution.findings[0].kind, "clip-planes");
    EXPECT_EQ(found.attribution.findings[0].text,
              "near and far of the map are 0.001 and 100, those of the camera are 0.1 and 100");
  }
}

// Near and far of many digits are not read off.
TEST(StoredPlanes, AreAPossibleCauseWhereTheyCannotBeRead) {
  const auto truth = sphere_seen_by(sphere_camera(0.1, 100));
  const OtherMap map = in_codes(*truth, 24, 0.00034567, 87.654);
  const Judgement found = judge(truth, map, model_named("gl-unorm24"));
  EXPECT_GT(found.attribution.count(PixelClass::unexplained), 0U);
  EXPECT_TRUE(found.attribution.findings.empty()) << found.attribution.findings[0].text;
  ASSERT_FALSE(found.attribution.notes.empty());
  EXPECT_EQ(found.attribution.notes.back().kind, "clip-planes");
  EXPECT_EQ(
      found.attribution.notes.back().text,
      "check that the map was drawn with this camera, and with its near 0.1 and far 100, on which "
      "the model gl-unorm24 depends");
}

// A lattice of codes is not enough: the surfaces have to be where the camera sees them.
TEST(StoredPlanes, AreNotBlamedForAnotherScene) {
  const auto truth = sphere_seen_by(sphere_camera(0.1, 100));
  Camera elsewhere = truth->camera;
  elsewhere.projection.fx /= 3;
  const OtherMap map = in_codes(seen_by(*truth, elsewhere), 24, 0.001, 100);
  const Judgement found = judge(truth, map, model_named("gl-unorm24"));
  for (const Finding& finding : found.attribution.findings) EXPECT_NE(finding.kind, "clip-planes");
}

// Sixteen bits are so coarse that no line through 1/stored and 1/depth holds for most pixels.
TEST(DrawnPlanes, AreFoundThoughTheMapWasDecodedWithTheCameras) {
  const auto truth = sphere_seen_by(sphere_camera(0.5, 20));
  for (const double near : {0.25, 0.05}) {
    const OtherMap map = in_misread_codes(*truth, 16, near, 20);
    const Judgement found = judge(truth, map, model_named("gl-unorm16"));
    EXPECT_EQ(found.model.name, "gl-unorm16");
    EXPECT_EQ(found.attribution.count(PixelClass::unexplained), 0U) << near;
    ASSERT_EQ(found.attribution.findings.size(), 1U) << near;
    const Finding& finding = found.attribution.findings[0];
    EXPECT_EQ(finding.kind, "decoding");
    EXPECT_EQ(finding.text,
              "depths were decoded with the wrong near and far: the map was drawn with near " +
                  std::string(near == 0.25 ? "0.25" : "0.05") + " and far 20, not 0.5 and 20");
    ASSERT_EQ(finding.estimates.size(), 2U);
    EXPECT_EQ(finding.estimates[0].value, near);
    EXPECT_EQ(finding.estimates[1].value, 20);
  }
}

}  // namespace
}  // namespace fathom::attribution
