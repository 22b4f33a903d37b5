#include "fathom/scene/motion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "fathom/failures/errors.h"
#include "fathom/numeric/rounding.h"

namespace fathom {
namespace {

using ::testing::HasSubstr;

std::string motion_of(const std::string& keyframes) {
  return R"({"objects": [{"name": "door", "keyframes": )" + keyframes + "}]}";
}

constexpr const char* identity = "[[1,0,0,0],[0,1,0,0],[0,0,1,0]]";

std::string keyframe(const std::string& time, const std::string& transform = identity) {
  return R"({"time": )" + time + R"(, "transform": )" + transform + "}";
}

std::string refusal(const std::string& text) {
  try {
    (void)read_motion(text, "m.json");
  } catch (const InputError& error) {
    return error.what();
  }
  return "taken";
}

Scene two_doors() {
  Scene scene;
  scene.meshes.emplace_back();
  scene.meshes[0].vertices = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  scene.meshes[0].triangles = {{0, 1, 2}};
  scene.meshes[0].face_count = 1;
  for (const char* name : {"door", "wall", "door"}) scene.objects.push_back({.name = name});
  scene.objects[2].world_from_mesh.rows[0][3] = 10.0;
  scene.objects[2].placed_as_is = false;
  return scene;
}

double x_of(const Object& object) {
  return round_to_binary64(to_world(object, {0, 0, 1}).x);
}

/// 2 → 5 between the times 1 and 4: x = 1 + time; at rest before and after.
TEST(Motion, IsLinearBetweenKeyframesAndAtRestOutside) {
  const Motion motion =
      read_motion(motion_of("[" + keyframe("1", "[[1,0,0,2],[0,1,0,0],[0,0,1,0]]") + "," +
                            keyframe("4", "[[3,0,0,5],[0,1,0,0],[0,0,1,0],[0,0,0,1]]") + "]"),
                  "m.json");
  ASSERT_EQ(motion.objects.size(), 1U);
  EXPECT_EQ(motion.objects[0].object, "door");
  const auto row = [&](double time) {
    const WorldFromMesh m = transform_at(motion.objects[0], time);
    return std::pair(round_to_binary64(m.rows[0][0]), round_to_binary64(m.rows[0][3]));
  };
  EXPECT_EQ(row(-7), std::pair(1.0, 2.0));
  EXPECT_EQ(row(1), std::pair(1.0, 2.0));
  EXPECT_EQ(row(1.75), std::pair(1.5, 2.75));
  EXPECT_EQ(row(2.5), std::pair(2.0, 3.5));
  EXPECT_EQ(row(4), std::pair(3.0, 5.0));
  EXPECT_EQ(row(1e300), std::pair(3.0, 5.0));
  // Every object of the name, on top of where the scene places it; others stay.
  MovingScene moving(two_doors(), motion);
  const Scene& scene = moving.at(1.75);
  EXPECT_EQ(x_of(scene.objects[0]), 2.75);
  EXPECT_EQ(x_of(scene.objects[1]), 0);
  EXPECT_EQ(x_of(scene.objects[2]), 1.5 * 10 + 2.75);
  // Each time is reckoned from the placement, not from the time before.
  EXPECT_EQ(x_of(moving.at(1).objects[2]), 12);
  EXPECT_EQ(x_of(std::move(moving).take(4).objects[0]), 5);
}

TEST(Motion, TimesFarApartDoNotOverflow) {
  const Motion motion =
      read_motion(motion_of("[" + keyframe("-1.7e308", "[[1,0,0,0],[0,1,0,0],[0,0,1,0]]") + "," +
                            keyframe("1.7e308", "[[1,0,0,4],[0,1,0,0],[0,0,1,0]]") + "]"),
                  "m.json");
  EXPECT_EQ(round_to_binary64(transform_at(motion.objects[0], 0).rows[0][3]), 2);
}

TEST(Motion, RefusesWhatMeansNothing) {
  const std::string first = keyframe("1");
  EXPECT_THAT(refusal(motion_of("[" + first + "," + keyframe("1") + "]")),
              HasSubstr("m.json: objects[0].keyframes[1].time: the times of keyframes have to "));
  EXPECT_THAT(refusal(motion_of("[" + first + "," + keyframe("0.5") + "]")), HasSubstr("increase"));
  EXPECT_THAT(refusal(motion_of("[]")), HasSubstr("at least one keyframe"));
  EXPECT_THAT(refusal(motion_of("[" + keyframe("1", "[[1,0,0,0]]") + "]")), HasSubstr("transform"));
  EXPECT_THAT(refusal(motion_of(R"([{"time": 1}])")), HasSubstr("transform"));
  EXPECT_THAT(refusal(R"({"objects": [], "speed": 1})"), HasSubstr("speed"));
  EXPECT_THAT(refusal("[]"), HasSubstr("no object"));
  EXPECT_THAT(refusal(R"({"objects": [{"name": "a", "keyframes": [)" + first +
                      R"(]}, {"name": "a", "keyframes": [)" + first + "]}]}"),
              HasSubstr("twice"));
}

TEST(MovingScene, RefusesNamesThatAreNotThereAndMotionsThatAreNone) {
  const auto made = [](Motion motion) { return MovingScene(two_doors(), std::move(motion)); };
  EXPECT_THROW(made({{{"window", {{0, {}}}}}}), InputError);
  EXPECT_THROW(made({{{"door", {}}}}), InputError);
  EXPECT_THROW(made({{{"door", {{1, {}}, {1, {}}}}}}), InputError);
  EXPECT_THROW(made({{{"door", {{std::numeric_limits<double>::quiet_NaN(), {}}}}}}), InputError);
  MovingScene moving = made({{{"door", {{1, {}}}}}});
  EXPECT_THROW(moving.at(std::numeric_limits<double>::infinity()), UsageError);
}

}  // namespace
}  // namespace fathom
