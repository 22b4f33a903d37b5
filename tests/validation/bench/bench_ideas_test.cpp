// `fathom bench --parts`: what is switched, what is counted, what is refused; no times.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/bench/parts/ideas.h"
#include "apps/bench/parts/parts_report.h"
#include "fathom/failures/errors.h"
#include "validation/scenes/shapes.h"

namespace fathom::bench {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A count of a variant, which has to have it.
double count_of(const VariantTimes& variant, const std::string& name) {
  for (const Count& count : variant.counts)
    if (count.name == name) return count.value;
  ADD_FAILURE() << variant.name << " has no " << name;
  return -1;
}

/// A variant that draws `numbers`, and notes that it was drawn.
Variant drawing(const std::string& name, const Picture& numbers, const Picture& expected,
                std::vector<std::string>* log = nullptr) {
  return {.name = name,
          .draw =
              [name, log] {
                if (log) log->push_back(name);
              },
          .picture = [numbers] { return numbers; },
          .expected = std::make_shared<const Picture>(expected)};
}

TEST(Ideas, AWrongPictureIsRefusedBeforeAnythingIsTimed) {
  std::vector<std::string> log;
  Idea idea{"lanes",
            {drawing("plain", {1, 2, 3}, {1, 2, 3}, &log),
             drawing("broken", {1, 0, 0}, {1, 2, 3}, &log)}};
  try {
    time_idea(idea, 5);
    FAIL() << "was timed";
  } catch (const WrongPicture& error) {
    EXPECT_STREQ(error.what(), "lanes, broken: 2 values of the picture are wrong");
  }
  EXPECT_THAT(log, ElementsAre("plain", "broken"));
  idea.variants[1] = drawing("smaller", {1, 2}, {1, 2, 3});
  EXPECT_THROW(time_idea(idea, 1), WrongPicture);
}

TEST(Ideas, WhereArithmeticIsNotExactDifferencesAreCounted) {
  Idea idea{"lanes", {drawing("rounded", {1, 0, 0}, {1, 2, 3})}};
  idea.variants[0].may_differ = true;
  EXPECT_EQ(count_of(time_idea(idea, 1).variants[0], "differ"), 2);
}

TEST(Ideas, VariantsAreTimedInTurnEachRoundFromAnotherOn) {
  std::vector<std::string> log;
  const Idea idea{"", {drawing("a", {}, {}, &log), drawing("b", {}, {}, &log)}};
  const IdeaTimes times = time_idea(idea, 3);
  // They are so fast that each draws several times in a row.
  log.erase(std::unique(log.begin(), log.end()), log.end());
  EXPECT_THAT(log, ElementsAre("a", "b", "a", "b", "a", "b"));  // a b, a b, b a, a b
  EXPECT_EQ(times.variants[1].plain, "a");
  EXPECT_EQ(times.variants[1].milliseconds.size(), 3U);
  EXPECT_EQ(times.variants[0].speed_up, 1);
}

TEST(Ideas, MedianIsTheMiddleOrTheMeanOfTheTwoInTheMiddle) {
  EXPECT_EQ((VariantTimes{.milliseconds = {1, 2, 9}}.median_ms()), 2);
  EXPECT_EQ((VariantTimes{.milliseconds = {1, 2, 4, 9}}.median_ms()), 3);
}

TEST(Ideas, OneThatThereIsNotIsRefused) {
  const PartsScene scene(make_scene("sphere-8", 16, 16));
  EXPECT_THROW(ideas_named("sorting", scene, {1}), UsageError);
}

/// Of a small sphere; each time_idea() compares the pictures of all variants.
std::vector<IdeaTimes> times_of(const std::string& name, const std::string& scene_name) {
  const PartsScene scene(make_scene(scene_name, 96, 54));
  std::vector<IdeaTimes> times;
  for (const Idea& idea : ideas_named(name, scene, {1, 2})) times.push_back(time_idea(idea, 1));
  return times;
}

TEST(Ideas, LanesTestAllOfTheirGroups) {
  // One triangle with a box of 5 × 3 pixels.
  PartsScene scene(make_scene("sphere-8", 16, 16));
  scene.window.triangles = {{{{{0, 0}, {5 * 256, 0}, {0, 3 * 256}}}, {}}};
  scene.setups = set_up_edges(scene.window);
  for (const Idea& idea : lanes(scene)) {
    const IdeaTimes times = time_idea(idea, 1);
    if (times.name == "lanes of the fast engine") continue;
    EXPECT_EQ(count_of(times.variants[0], "steps"), 15);
    EXPECT_EQ(count_of(times.variants[0], "edge functions"), 45);
    EXPECT_EQ(count_of(times.variants[2], "steps"), 6);  // two groups of 4 in each of 3 rows
    EXPECT_EQ(count_of(times.variants[2], "edge functions"), 3 * 24);
    EXPECT_EQ(count_of(times.variants[2], "lanes used %"), 62.5);
    EXPECT_EQ(count_of(times.variants[4], "steps"), 3);
  }
}

TEST(Ideas, LanesAreThoseOfTheTextbookAndOfTheEngine) {
  const std::vector<IdeaTimes> times = times_of("lanes", "sphere-2k");
  ASSERT_EQ(times.size(), 3U);
  EXPECT_EQ(times[0].variants.size(), 5U);
  EXPECT_EQ(times[1].variants.size(), 6U);
  EXPECT_GE(times[2].variants.size(), 1U);
  EXPECT_EQ(count_of(times[2].variants.front(), "samples tested"),
            count_of(times[2].variants.back(), "samples tested"));
}

TEST(Ideas, BlocksSparePixels) {
  const IdeaTimes times = times_of("blocks", "few-large").at(0);
  ASSERT_EQ(times.variants.size(), 8U);
  EXPECT_EQ(times.variants[3].plain, times.variants[2].name);
  for (const std::size_t plain : {0U, 2U}) {
    EXPECT_LT(count_of(times.variants[plain + 1], "pixels tested"),
              count_of(times.variants[plain], "pixels tested"));
  }
}

TEST(Ideas, OrderDecidesHowManyFragmentsAreShaded) {
  const std::vector<IdeaTimes> all = times_of("early-rejection", "few-large");
  ASSERT_EQ(all.size(), 2U);
  const std::vector<VariantTimes>& v = all[0].variants;
  ASSERT_EQ(v.size(), 6U);
  for (std::size_t i = 0; i < 6; i += 2) {
    const double fragments = count_of(v[i], "fragments"), written = count_of(v[i], "written");
    EXPECT_EQ(fragments, count_of(v[0], "fragments"));
    EXPECT_EQ(count_of(v[i], "shaded"), fragments);
    EXPECT_EQ(count_of(v[i + 1], "shaded"), written);
    EXPECT_EQ(count_of(v[i], "fail the test"), fragments - written);
  }
  // random, back to front, front to back
  EXPECT_LT(count_of(v[0], "written"), count_of(v[2], "written"));
  EXPECT_LT(count_of(v[4], "written"), count_of(v[0], "written"));
  const std::vector<VariantTimes>& fast = all[1].variants;
  ASSERT_EQ(fast.size(), 6U);
  EXPECT_LT(count_of(fast[4], "written"), count_of(fast[2], "written"));
}

// Two sheets, a thousandth apart at 900: the same number to the depth buffer, so that the order
// decides which of the two depths channel Z has.
TEST(Ideas, EquallyNearSurfacesMayBeDrawnInAnyOrder) {
  Mesh mesh;
  for (const double z : {900.001, 900.0}) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const MeshPoint corner : {MeshPoint{-900, -900, z}, {900, -900, z}, {0, 900, z}})
      mesh.vertices.push_back(corner);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  mesh.face_count = 2;
  Camera camera = simple_camera({16, 16});
  camera.near = 0.1;
  camera.far = 1000;
  const PartsScene scene({"sheets", as_scene({mesh}, "sheets"), camera});
  const std::vector<Idea> ideas = early_rejection(scene);
  const IdeaTimes times = time_idea(ideas.at(0), 1);
  const double fragments = count_of(times.variants[0], "fragments");
  EXPECT_GT(fragments, 0);
  EXPECT_EQ(count_of(times.variants[2], "written"), fragments / 2);
}

TEST(Ideas, TheFastEngineIsNotReorderedWhereThereAreSeveralObjects) {
  EXPECT_EQ(times_of("early-rejection", "room").size(), 1U);
}

TEST(Ideas, ATileForTheWholeImageHasEachTriangleOnce) {
  const std::vector<VariantTimes> v = times_of("tiles", "sphere-2k").at(0).variants;
  ASSERT_EQ(v.size(), 6U);
  EXPECT_EQ(count_of(v.back(), "tiles"), 1);
  EXPECT_EQ(count_of(v.back(), "triangles x tiles"), count_of(v.front(), "triangles x tiles"));
  EXPECT_EQ(count_of(v[1], "tiles"), 6 * 4);
}

TEST(Ideas, ThreadsShareTheTiles) {
  const std::vector<VariantTimes> v = times_of("threads", "sphere-2k").at(0).variants;
  ASSERT_EQ(v.size(), 4U);
  EXPECT_EQ(v[0].name, "tiles of 64x64, 1 thread");
  EXPECT_EQ(v[3].name, "fast engine, 2 threads");
  EXPECT_EQ(v[3].plain, "fast engine, 1 thread");
  EXPECT_EQ(count_of(v[0], "most of a thread"), count_of(v[0], "tiles"));
}

// From three radii away a cap of the sphere is seen whose share of the area is (1 − 1/3)/2. Facing
// is that of flat triangles, so the outline is off by less than their size.
TEST(Ideas, CullingLeavesOutTwoThirdsOfASphereSeenFromThreeRadii) {
  const std::vector<VariantTimes> v = times_of("culling", "sphere-20k").at(0).variants;
  ASSERT_EQ(v.size(), 4U);
  EXPECT_EQ(count_of(v[0], "culled"), 0);
  EXPECT_NEAR(count_of(v[1], "culled %"), 200.0 / 3, 1);
  EXPECT_NEAR(count_of(v[3], "culled %"), 200.0 / 3, 1);
  // Each pixel of the sphere is covered once from the front and once from behind.
  EXPECT_EQ(count_of(v[0], "fragments"), 2 * count_of(v[1], "fragments"));
}

TEST(Ideas, CullingIsLeftOutWhereItChangesThePicture) {
  EXPECT_TRUE(times_of("culling", "few-large").empty());
}

PartsOfScene parts() {
  PartsOfScene result{"sphere-8", 8, 40, 30, {}, {"culling: why"}};
  result.ideas.push_back(
      {"lanes",
       "a note",
       {{.name = "1 lane", .plain = "1 lane", .milliseconds = {2, 4, 9}, .counts = {{"steps", 12}}},
        {.name = "16 lanes",
         .plain = "1 lane",
         .milliseconds = {1, 2},
         .speed_up = 2.5,
         .counts = {{"steps", 1}, {"lanes used %", 62.5}}}}});
  return result;
}

TEST(PartsReport, TableHasAColumnForEachCount) {
  EXPECT_EQ(heading(parts()), "sphere-8: 8 triangles, 40x30\n");
  EXPECT_EQ(table(parts().ideas[0]),
            "lanes (a note)\n"
            "            median ms   least ms  x plain        steps  lanes used %\n"
            "  1 lane        4.000      2.000        1           12             -\n"
            "  16 lanes      1.500      1.000     2.50            1          62.5\n"
            "\n");
}

TEST(PartsReport, TableOfRules) {
  EXPECT_THAT(table(std::vector<RuleCounts>{{"demo", 16830, 16970}}),
              HasSubstr("  demo       16830       16970         140\n"));
}

TEST(PartsReport, JsonHasWhatTheTablesHave) {
  const Machine machine{"some processor", 2, 1U << 30, "some system", "some compiler"};
  const auto json = nlohmann::json::parse(to_json(machine, {parts()}, {{"demo", 16830, 16970}}));
  EXPECT_EQ(json["machine"]["processors"], 2);
  ASSERT_EQ(json["results"].size(), 2U);
  const nlohmann::json& result = json["results"][1];
  EXPECT_EQ(result["scene"], "sphere-8");
  EXPECT_EQ(result["triangles"], 8);
  EXPECT_EQ(result["width"], 40);
  EXPECT_EQ(result["idea"], "lanes");
  EXPECT_EQ(result["variant"], "16 lanes");
  EXPECT_EQ(result["plain"], "1 lane");
  EXPECT_EQ(result["median_ms"], 1.5);
  EXPECT_EQ(result["runs"], 2);
  EXPECT_EQ(result["speed_up"], 2.5);
  EXPECT_EQ(result["counts"]["steps"], 1);
  EXPECT_EQ(result["counts"]["lanes used %"], 62.5);
  EXPECT_EQ(json["left_out"][0]["why"], "culling: why");
  EXPECT_EQ(json["closed_edges"][0]["half_open"], 16830);
  EXPECT_EQ(json["closed_edges"][0]["closed"], 16970);
}

}  // namespace
}  // namespace fathom::bench
