// "draw" of a scene file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "fathom/failures/errors.h"
#include "fathom/scene/read_scene.h"
#include "fathom/scene/scene.h"
#include "fathom/scene/scene_fault.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using testing::HasSubstr;

class DrawStates : public testing::Test {
 protected:
  DrawStates() { folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"); }

  Scene read(const std::string& second, const std::string& first = "{}") {
    const std::string text = R"({"meshes": [{"file": "a.obj", "draw": )" + first +
                             R"(}, {"file": "a.obj", "draw": )" + second +
                             R"(}, {"file": "a.obj"}]})";
    Warnings warnings;
    return read_scene({folder.write("scene.json", text), folder.path() / "a.obj"}, {}, warnings);
  }
  std::string failure(const std::string& draw) {
    return message_of<InputError>([&] { read(draw); });
  }
  ScratchFolder folder;
};

TEST_F(DrawStates, AreOfTheObjectsThatHaveThem) {
  const Scene scene = read(R"({
    "depth_test": "gequal", "depth_write": false, "colour_write": false,
    "polygon_offset": [-1, 2.5], "alpha": 0.25,
    "stencil": {"test": "notequal", "reference": 200, "mask": 15, "write_mask": 240,
                "fail": "zero", "depth_fail": "incr_wrap", "pass": "invert"}})");
  ASSERT_EQ(scene.draw_states.size(), 4U);
  for (const std::size_t other : {0, 2, 3}) EXPECT_TRUE(is_default(scene.draw_states[other]));
  const DrawState s = draw_state_of(scene, 1);
  EXPECT_EQ(s.depth_test, Comparison::greater_equal);
  EXPECT_FALSE(s.depth_write);
  EXPECT_FALSE(s.colour_write);
  EXPECT_EQ(s.polygon_offset->factor, -1);
  EXPECT_EQ(s.polygon_offset->units, 2.5);
  EXPECT_EQ(s.alpha, 0.25);
  EXPECT_EQ(s.stencil->test, Comparison::not_equal);
  EXPECT_EQ(s.stencil->reference, 200);
  EXPECT_EQ(s.stencil->mask, 15);
  EXPECT_EQ(s.stencil->write_mask, 240);
  EXPECT_EQ(s.stencil->fail, StencilAction::zero);
  EXPECT_EQ(s.stencil->depth_fail, StencilAction::increment_wrap);
  EXPECT_EQ(s.stencil->pass, StencilAction::invert);
}

TEST_F(DrawStates, AreNoneWhereNothingIsSaid) {
  EXPECT_TRUE(read(R"({"depth_test": "nearer", "depth_write": true})").draw_states.empty());
  EXPECT_EQ(read("{}", R"({"alpha": 1})").draw_states.size(), 4U);
  EXPECT_TRUE(is_default(draw_state_of(read("{}"), 1)));
}

TEST_F(DrawStates, WrongOnesAreRefusedByTheirKey) {
  EXPECT_THAT(failure("7"), HasSubstr("meshes[1].draw"));
  EXPECT_THAT(failure(R"({"blend": 1})"), HasSubstr("blend"));
  EXPECT_THAT(failure(R"({"depth_test": "nearest"})"),
              HasSubstr("expected one of nearer, never, less, equal"));
  EXPECT_THAT(failure(R"({"polygon_offset": [1]})"), HasSubstr("polygon_offset"));
  EXPECT_THAT(failure(R"({"alpha": 1.5})"), HasSubstr("alpha"));
  EXPECT_THAT(failure(R"({"alpha": -0.1})"), HasSubstr("alpha"));
  EXPECT_THAT(failure(R"({"stencil": {"reference": 256}})"), HasSubstr("reference"));
  EXPECT_THAT(failure(R"({"stencil": {"pass": "increment"}})"), HasSubstr("incr_wrap"));
}

TEST_F(DrawStates, ThatSomebodyFilledInAreLookedAt) {
  const auto fault = [&](const auto& change) {
    Scene scene = read("{}");
    scene.draw_states.resize(4);
    change(scene);
    return find_fault(scene).value_or("");
  };
  EXPECT_EQ(fault([](Scene&) {}), "");
  EXPECT_THAT(fault([](Scene& s) { s.draw_states.resize(3); }), HasSubstr("draw states"));
  EXPECT_THAT(fault([](Scene& s) { s.draw_states[2].alpha = std::nan(""); }),
              HasSubstr("object 2: an opacity"));
  EXPECT_THAT(fault([](Scene& s) {
                s.draw_states[3].polygon_offset = PolygonOffset{0, INFINITY};
              }),
              HasSubstr("object 3: a polygon offset"));
}

}  // namespace
}  // namespace fathom
