// Each object drawn by a state of its own, held to what OpenGL defines, worked out by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fathom/failures/errors.h"
#include "fathom/image/preview.h"
#include "fathom/pipeline/geometry/window_triangle.h"
#include "fathom/pipeline/output/draw_rules.h"
#include "fathom/pipeline/render_pipeline.h"
#include "fathom/pipeline/trace.h"
#include "tests/pipeline/layers.h"

namespace fathom::pipeline {
namespace {

using testing::Each;
using testing::HasSubstr;

PipelineOptions unlit() {
  PipelineOptions options;
  options.precision = Precision::binary64;
  options.depth_format.storage = Storage::unorm16;
  options.shading = Shading::none;
  return options;
}

PipelineFrame drawn(const std::vector<Layer>& list, const PipelineOptions& options = unlit()) {
  return render_frame(layers(list), camera_of_layers(), options, true);
}

/// Which layer is seen; −1: none. The same in every pixel.
int seen(const std::vector<Layer>& list) {
  const PipelineFrame frame = drawn(list);
  std::vector<int> seen;
  for (const std::uint32_t id : frame.id)
    seen.push_back(id == no_surface ? -1 : static_cast<int>(id / 2));
  EXPECT_THAT(seen, Each(seen[0]));
  return seen[0];
}

DrawState tested(Comparison comparison) {
  DrawState state;
  state.depth_test = comparison;
  return state;
}

/// [GL46] 17.3.4, with a surface at 3 in the buffer and one that comes nearer, at it, or farther.
TEST(DepthFunction, LetsThroughWhatOpenGlDefines) {
  struct Row {
    Comparison comparison;
    bool nearer, same, farther, against_cleared, at_far;
  };
  for (const Row& row : {Row{Comparison::never, false, false, false, false, false},
                         Row{Comparison::less, true, false, false, true, false},
                         Row{Comparison::equal, false, true, false, false, true},
                         Row{Comparison::less_equal, true, true, false, true, true},
                         Row{Comparison::greater, false, false, true, false, false},
                         Row{Comparison::not_equal, true, false, true, true, false},
                         Row{Comparison::greater_equal, false, true, true, false, true},
                         Row{Comparison::always, true, true, true, true, true}}) {
    const auto wins = [&](double depth) {
      return seen({{3, {}}, {depth, tested(row.comparison)}}) == 1;
    };
    const int which = static_cast<int>(row.comparison);
    EXPECT_EQ(wins(2), row.nearer) << which;
    EXPECT_EQ(wins(3), row.same) << which;
    EXPECT_EQ(wins(4), row.farther) << which;
    EXPECT_EQ(seen({{3, tested(row.comparison)}}) == 0, row.against_cleared) << which;
    EXPECT_EQ(seen({{100, tested(row.comparison)}}) == 0, row.at_far) << which;
  }
  // Without a function of its own the strictly nearer wins, and all win against a cleared buffer.
  EXPECT_EQ(seen({{3, {}}, {3, {}}}), 0);
  EXPECT_EQ(seen({{3, {}}, {2, {}}}), 1);
  EXPECT_EQ(seen({{100, {}}}), 0);
}

// As in OpenGL with blending and without GL_DEPTH_TEST: the stencil test comes first, and a
// fragment that no depth test looks at passes.
TEST(Blending, WithoutADepthTestTheStencilTestStillDecides) {
  PipelineOptions options = unlit();
  options.blend_alpha = 0.5;
  DrawState never, seven, one_more;
  never.stencil = StencilState{.test = Comparison::never, .fail = StencilAction::invert};
  seven.stencil = StencilState{.reference = 7, .pass = StencilAction::replace};
  one_more.stencil = StencilState{.pass = StencilAction::increment};
  const PipelineFrame hidden = drawn({{3, never}}, options);
  EXPECT_THAT(hidden.stencil, Each(255));
  EXPECT_THAT(hidden.id, Each(no_surface));
  for (const Colour& c : hidden.picture.pixels) EXPECT_EQ(c, (Colour{0, 0, 0}));
  const PipelineFrame both = drawn({{2, seven}, {4, one_more, {1, 0, 0}}}, options);
  EXPECT_THAT(both.stencil, Each(8));
  for (const Colour& c : both.picture.pixels) EXPECT_EQ(c, (Colour{0.75, 0.25, 0.25}));
  // With the test on the farther one fails it.
  options.blend_depth = BlendDepth::on;
  const PipelineFrame nearer = drawn({{2, seven}, {4, one_more, {1, 0, 0}}}, options);
  EXPECT_THAT(nearer.stencil, Each(7));
  for (const Colour& c : nearer.picture.pixels) EXPECT_EQ(c, (Colour{0.5, 0.5, 0.5}));
}

TEST(DepthWrite, WithoutItASurfaceHidesNothing) {
  DrawState read_only;
  read_only.depth_write = false;
  EXPECT_EQ(seen({{3, {}}, {2, read_only}}), 1);
  EXPECT_EQ(seen({{3, {}}, {2, read_only}, {2.5, {}}}), 2);
  EXPECT_EQ(seen({{3, {}}, {2, {}}, {2.5, {}}}), 1);
  EXPECT_EQ(seen({{3, {}}, {4, read_only}}), 0);
}

TEST(ColourWrite, WithoutItASurfaceHidesUnseen) {
  DrawState unseen;
  unseen.colour_write = false;
  const PipelineFrame frame = drawn({{2, unseen}, {3, {}, {1, 0, 0}}});
  EXPECT_THAT(frame.id, Each(no_surface));
  EXPECT_THAT(frame.picture.pixels, Each(Colour{0, 0, 0}));
  EXPECT_EQ(frame.stored, drawn({{2, {}}}).stored);
}

TEST(Stencil, ActionsAreThoseOfOpenGl) {
  StencilState s;
  s.reference = 0xA5;
  const auto results = [&](std::uint8_t value) {
    std::vector<int> list;
    for (int a = 0; a <= static_cast<int>(StencilAction::invert); ++a)
      list.push_back(after(static_cast<StencilAction>(a), s, value));
    return list;
  };
  //                                         keep zero replace incr wrap decr wrap invert
  EXPECT_EQ(results(7), (std::vector<int>{7, 0, 0xA5, 8, 8, 6, 6, 0xF8}));
  EXPECT_EQ(results(255), (std::vector<int>{255, 0, 0xA5, 255, 0, 254, 254, 0}));
  EXPECT_EQ(results(0), (std::vector<int>{0, 0, 0xA5, 1, 1, 0, 255, 255}));
  s.write_mask = 0x0F;
  EXPECT_EQ(results(0x36), (std::vector<int>{0x36, 0x30, 0x35, 0x37, 0x37, 0x35, 0x35, 0x39}));
}

DrawState stencilled(const StencilState& stencil) {
  DrawState state;
  state.stencil = stencil;
  return state;
}

TEST(Stencil, TestsBeforeDepthAndActsOnEachOutcome) {
  const DrawState act = stencilled({.test = Comparison::always,
                                    .reference = 9,
                                    .fail = StencilAction::zero,
                                    .depth_fail = StencilAction::invert,
                                    .pass = StencilAction::replace});
  EXPECT_THAT(drawn({{3, act}}).stencil, Each(9));
  EXPECT_THAT(drawn({{2, {}}, {3, act}}).stencil, Each(255));
  const DrawState fails = stencilled(
      {.test = Comparison::never, .fail = StencilAction::increment, .pass = StencilAction::zero});
  EXPECT_THAT(drawn({{3, act}, {2, fails}}).stencil, Each(10));
  EXPECT_EQ(seen({{3, act}, {2, fails}}), 0);
}

/// (reference & mask) against (stencil & mask), in this order.
TEST(Stencil, ComparesTheReferenceWithWhatIsStored) {
  const DrawState mark = stencilled({.reference = 0x35, .pass = StencilAction::replace});
  const auto drawn_over = [&](Comparison comparison, std::uint8_t reference, std::uint8_t mask) {
    return seen({{3, mark},
                 {2, stencilled({.test = comparison, .reference = reference, .mask = mask})}}) == 1;
  };
  EXPECT_TRUE(drawn_over(Comparison::equal, 0x35, 255));
  EXPECT_FALSE(drawn_over(Comparison::equal, 0x05, 255));
  EXPECT_TRUE(drawn_over(Comparison::equal, 0x05, 0x0F));
  EXPECT_TRUE(drawn_over(Comparison::less, 0x34, 255));
  EXPECT_FALSE(drawn_over(Comparison::less, 0x36, 255));
  EXPECT_TRUE(drawn_over(Comparison::greater, 0x36, 255));
  EXPECT_FALSE(drawn_over(Comparison::not_equal, 0xF5, 0x0F));
}

const Layer red{3, {}, {1, 0, 0}};

Layer glass(double depth, const std::array<float, 3>& colour, bool writes = true) {
  DrawState state;
  state.alpha = 0.5;
  state.depth_write = writes;
  return {depth, state, colour};
}

/// Green glass at 2, blue glass at 2.5 behind it, drawn in this order over red.
TEST(Blending, ObeysTheDepthTestOfEachObject) {
  const auto colour = [](const std::vector<Layer>& list, const PipelineOptions& options = unlit()) {
    const PipelineFrame frame = drawn(list, options);
    EXPECT_THAT(frame.picture.pixels, Each(frame.picture.pixels[0]));
    return frame.picture.pixels[0];
  };
  const Layer green = glass(2, {0, 1, 0}), blue = glass(2.5, {0, 0, 1});
  // On: blue fails behind green. The right answer would be half green, quarter blue, quarter red.
  EXPECT_EQ(colour({red, green, blue}), (Colour{0.5, 0.5, 0}));
  EXPECT_EQ(colour({red, blue, green}), (Colour{0.25, 0.5, 0.25}));
  // Read-only: both are blended, in the order of drawing.
  const Layer green_ro = glass(2, {0, 1, 0}, false), blue_ro = glass(2.5, {0, 0, 1}, false);
  EXPECT_EQ(colour({red, green_ro, blue_ro}), (Colour{0.25, 0.25, 0.5}));
  // Behind the red wall neither is seen.
  EXPECT_EQ(colour({red, glass(4, {0, 0, 1}, false)}), (Colour{1, 0, 0}));
  // The options blend all objects that have no opacity of their own.
  PipelineOptions all = unlit();
  all.blend_alpha = 0.5;
  const std::vector<Layer> plain{{2, {}, {0, 1, 0}}, {3, {}, {1, 0, 0}}};
  EXPECT_EQ(colour(plain, all), (Colour{0.5, 0.25, 0}));
  all.blend_depth = BlendDepth::on;
  EXPECT_EQ(colour(plain, all), (Colour{0, 0.5, 0}));
  all.blend_depth = BlendDepth::read_only;
  EXPECT_EQ(colour(plain, all), (Colour{0.5, 0.25, 0}));
  all.draw_order = DrawOrder::back_to_front;
  EXPECT_EQ(colour(plain, all), (Colour{0.25, 0.5, 0}));
}

/// What is seen through glass that leaves no depth is what the map shows.
TEST(Blending, MapShowsWhatLeavesDepth) {
  EXPECT_EQ(seen({red, glass(2, {0, 1, 0})}), 1);
  EXPECT_EQ(seen({red, glass(2, {0, 1, 0}, false)}), 0);
}

/// Five layers of 24 pixels: drawn from the front only the first passes, from the back all do.
TEST(DrawOrder, DecidesHowManyFragmentsPass) {
  const std::vector<Layer> stack{{3, {}}, {5, {}}, {2, {}}, {4, {}}, {6, {}}};
  const auto passed = [&](DrawOrder order, std::uint64_t seed = 0) {
    PipelineOptions options = unlit();
    options.draw_order = order;
    options.draw_seed = seed;
    const PipelineFrame frame = drawn(stack, options);
    EXPECT_EQ(frame.statistics.fragments, 5U * 24U);
    for (const std::uint32_t id : frame.id) EXPECT_EQ(id / 2, 2U);
    return frame.statistics.depth_passed;
  };
  EXPECT_EQ(passed(DrawOrder::file), 24U * 2);
  EXPECT_EQ(passed(DrawOrder::front_to_back), 24U);
  EXPECT_EQ(passed(DrawOrder::back_to_front), 24U * 5);
  EXPECT_EQ(passed(DrawOrder::random, 3), passed(DrawOrder::random, 3));
  std::set<std::uint64_t> counts;
  for (std::uint64_t seed = 0; seed < 20; ++seed) counts.insert(passed(DrawOrder::random, seed));
  EXPECT_GT(counts.size(), 3U);
}

/// Triangles are ordered by the sum of their corners' depths: 15 is behind 14 and before 16.
TEST(DrawOrder, IsThatOfMeanDepths) {
  std::vector<WindowTriangle<double>> triangles(3);
  constexpr double depths[3][3]{{3, 5, 7}, {6, 4, 4}, {2, 2, 12}};
  for (std::size_t t = 0; t < 3; ++t) {
    triangles[t].number = static_cast<std::uint32_t>(t);
    for (std::size_t k = 0; k < 3; ++k)
      triangles[t].corners[k].attributes[attribute::depth] = depths[t][k];
  }
  const auto ordered = [&](DrawOrder order) {
    PipelineOptions options;
    options.draw_order = order;
    auto list = triangles;
    put_into_draw_order(list, options);
    return std::vector<std::uint32_t>{list[0].number, list[1].number, list[2].number};
  };
  EXPECT_EQ(ordered(DrawOrder::file), (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(ordered(DrawOrder::front_to_back), (std::vector<std::uint32_t>{1, 0, 2}));
  EXPECT_EQ(ordered(DrawOrder::back_to_front), (std::vector<std::uint32_t>{2, 0, 1}));
}

TEST(DrawState, IsRefusedWithoutADepthBuffer) {
  const std::vector<Layer> list{red, glass(2, {0, 1, 0})};
  const auto failure = [&](const PipelineOptions& options) -> std::string {
    try {
      drawn(list, options);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  PipelineOptions painter = unlit(), area = unlit();
  painter.hidden_surface = HiddenSurface::painter;
  area.antialias.method = AntialiasMethod::area;
  EXPECT_THAT(failure(area), HasSubstr("object layer 1: its 'draw' is for a depth buffer"));
  EXPECT_EQ(failure(unlit()), "");
  // An opacity needs no depth buffer.
  EXPECT_EQ(failure(painter), "");
}

/// An offset beyond the far plane is stored as the far plane, and one before the near plane as
/// that.
TEST(PolygonOffset, StaysWithinTheDepthBuffer) {
  for (const auto scan : {ScanConversion::edge_function, ScanConversion::scan_line}) {
    PipelineOptions options = unlit();
    options.scan = scan;
    const auto stored = [&](double units) {
      DrawState state;
      state.polygon_offset = PolygonOffset{0, units};
      return drawn({{3, state}}, options).stored;
    };
    EXPECT_THAT(stored(1e9), Each(StoredDepth{65535}));
    EXPECT_THAT(stored(-1e9), Each(StoredDepth{0}));
  }
}

TEST(Trace, ObeysTheScissorBox) {
  const Scene scene = layers({{3, {}}});
  PipelineOptions options = unlit();
  const auto traced = [&](std::uint32_t triangle, const Pixel& pixel) {
    return trace_triangle(scene, camera_of_layers(), options, triangle, pixel);
  };
  EXPECT_EQ(traced(0, {5, 0}).fragments + traced(1, {5, 0}).fragments, 24U);
  EXPECT_TRUE(traced(0, {5, 0}).sample->covered && traced(0, {5, 0}).sample->drawable);
  options.scissor = WindowRectangle{1, 1, 2, 3};
  EXPECT_EQ(traced(0, {5, 0}).fragments + traced(1, {5, 0}).fragments, 6U);
  EXPECT_TRUE(traced(0, {5, 0}).sample->covered);
  EXPECT_FALSE(traced(0, {5, 0}).sample->drawable);
  EXPECT_TRUE(traced(0, {2, 0}).sample->drawable);
  options.scissor = WindowRectangle{100, 100, 2, 3};
  EXPECT_EQ(traced(0, {5, 0}).fragments, 0U);
}

Colour colour_of_number(std::uint32_t number) {
  const Rgb rgb = colour_of_identifier(number);
  return {rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0};
}

/// Narrowed as the frame buffer stores it.
void expect_near(const Colour& is, const Colour& should) {
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(is[k], should[k], 1e-6);
}

TEST(SurfaceColours, AreThoseOfTheNumbersOfObjectsOrTriangles) {
  PipelineOptions options = unlit();
  const std::vector<Layer> list{{.depth = 3}, {.depth = 2}};
  options.colours = SurfaceColours::object;
  const PipelineFrame by_object = drawn(list, options);
  options.colours = SurfaceColours::triangle;
  const PipelineFrame by_triangle = drawn(list, options);
  for (std::size_t i = 0; i < by_object.id.size(); ++i) {
    expect_near(by_object.picture.pixels[i], colour_of_number(1));
    expect_near(by_triangle.picture.pixels[i], colour_of_number(by_triangle.id[i]));
  }
}

}  // namespace
}  // namespace fathom::pipeline
