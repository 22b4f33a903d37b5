// What a trace shows of the scene: fragments, the output merger at a pixel, lines and points, the
// painter's order; held against the frames that the pipeline renders.
#include "fathom/pipeline/trace.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "fathom/failures/errors.h"
#include "fathom/pipeline/render_pipeline.h"
#include "tests/pipeline/layers.h"

namespace fathom::pipeline {
namespace {

PipelineOptions unlit() {
  PipelineOptions options;
  options.shading = Shading::none;
  options.depth_format = {Mapping::opengl, Storage::unorm16, 0, 0, 1};
  return options;
}

/// Two layers and, in front of both, a triangle that covers half of the image, a line and a point.
Scene mixed_scene() {
  Scene scene = layers({{3, {}, {1, 0, 0}}, {2, {}, {0, 1, 0}}});
  Mesh mesh;
  mesh.vertices = {{-1, -1, 1},       {1, -1, 1},      {-1, 1, 1},
                   {-0.6, -0.4, 1.5}, {0.9, 0.6, 1.5}, {0.2, 0.1, 0.75}};
  mesh.triangles = {{0, 1, 2}};
  mesh.face_of_triangle = {0};
  mesh.face_count = 1;
  mesh.lines = {{3, 4}};
  mesh.points = {5};
  mesh.colours.assign(6, {0, 0, 1, 1});
  Object object;
  object.mesh = scene.meshes.size();
  object.name = "mixed";
  scene.meshes.push_back(std::move(mesh));
  scene.objects.push_back(std::move(object));
  scene.draw_states.emplace_back();
  return scene;
}

/// The steps at each pixel lead from the cleared buffer to the frame that is rendered.
void expect_steps_to_the_frame(const Scene& scene, const PipelineOptions& options) {
  const Camera camera = camera_of_layers();
  const PipelineFrame frame = render_frame(scene, camera, options, true);
  std::size_t steps = 0;
  for (std::int64_t y = 0; y < 4; ++y) {
    for (std::int64_t x = 0; x < 6; ++x) {
      const auto merger = watch_frame(scene, camera, options, Pixel{x, y}).merger;
      const auto i = static_cast<std::size_t>(6 * y + x);
      steps += merger.size();
      ASSERT_FALSE(merger.empty());
      EXPECT_EQ(merger.front().before.id, no_surface);
      for (std::size_t k = 1; k < merger.size(); ++k) {
        EXPECT_EQ(merger[k].before.colour, merger[k - 1].after.colour);
        EXPECT_EQ(merger[k].before.stored, merger[k - 1].after.stored);
        EXPECT_EQ(merger[k].before.id, merger[k - 1].after.id);
        EXPECT_EQ(merger[k].before.stencil, merger[k - 1].after.stencil);
      }
      const StoredSample& last = merger.back().after;
      EXPECT_EQ(last.id, frame.id[i]);
      EXPECT_EQ(last.stored, frame.stored[i]);
      EXPECT_EQ(last.stencil, frame.stencil[i]);
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_EQ(static_cast<double>(last.colour[c]), frame.picture.pixels[i][c]);
    }
  }
  PipelineOptions late = options;
  late.early_depth = false;
  EXPECT_EQ(steps, render_frame(scene, camera, late, true).statistics.fragments);
}

TEST(Trace, TheOutputMergerEndsWithTheFrame) {
  const Scene scene = mixed_scene();
  PipelineOptions options = unlit();
  expect_steps_to_the_frame(scene, options);
  options.draw_order = DrawOrder::front_to_back;
  expect_steps_to_the_frame(scene, options);
  options.blend_alpha = 0.25;
  expect_steps_to_the_frame(scene, options);
  options.blend_depth = BlendDepth::on;
  expect_steps_to_the_frame(scene, options);
  options = unlit();
  options.precision = Precision::binary64;
  options.scan = ScanConversion::scan_line;
  expect_steps_to_the_frame(scene, options);
  options = unlit();
  options.hidden_surface = HiddenSurface::painter;
  expect_steps_to_the_frame(layers({{2, {}, {1, 0, 0}}, {3, {}, {0, 1, 0}}}), options);
  DrawState mask;
  mask.stencil = StencilState{};
  mask.stencil->reference = 1;
  mask.stencil->pass = StencilAction::replace;
  expect_steps_to_the_frame(layers({{3, mask}, {2, {}}}), unlit());
}

TEST(Trace, TheDepthTestHasBothValues) {
  const Scene scene = mixed_scene();
  const auto trace = trace_primitive(scene, camera_of_layers(), unlit(), 0,
                                     {.pixel = Pixel{5, 0}, .merger = true});
  ASSERT_EQ(trace.merger.size(), 2u);  // the layers; the triangle leaves this corner free
  // f(D) = far (D − near) / (D (far − near)) in 16 bits; 3 is drawn before 2, which is nearer.
  const auto code = [](double depth) {
    return static_cast<std::uint64_t>(std::lround(65535 * 100 * (depth - 0.5) / (depth * 99.5)));
  };
  EXPECT_EQ(trace.merger[0].fragment.stored.bits, code(3));
  EXPECT_EQ(trace.merger[0].before.stored.bits, 65535u);
  EXPECT_EQ(trace.merger[1].before.stored.bits, code(3));
  EXPECT_EQ(trace.merger[1].fragment.stored.bits, code(2));
  EXPECT_EQ(trace.merger[1].outcome, Outcome::passed);
  PipelineOptions backwards = unlit();
  backwards.draw_order = DrawOrder::front_to_back;
  const auto late = trace_primitive(scene, camera_of_layers(), backwards, 0,
                                    {.pixel = Pixel{5, 0}, .merger = true});
  ASSERT_EQ(late.merger.size(), 2u);
  EXPECT_EQ(late.merger[1].outcome, Outcome::depth_failed);
  EXPECT_EQ(late.merger[1].after.stored.bits, code(2));
}

TEST(Trace, ListsTheFragmentsThatAreCounted) {
  const Scene scene = mixed_scene();
  const Camera camera = camera_of_layers();
  const auto triangles = static_cast<std::uint32_t>(triangle_count(scene));
  for (std::uint32_t number = 0; number < triangles + 2; ++number) {
    const auto trace = trace_primitive(scene, camera, unlit(), number, {.fragments = true});
    EXPECT_EQ(trace.fragment_list.size(), trace.fragments) << number;
    EXPECT_GT(trace.fragments, 0u) << number;
    std::set<std::pair<std::int64_t, std::int64_t>> pixels;
    for (const FragmentTrace& f : trace.fragment_list) {
      EXPECT_TRUE(pixels.emplace(f.pixel.y, f.pixel.x).second);
      // It is the fragment that reaches the output merger at that pixel.
      const auto merger = watch_frame(scene, camera, unlit(), f.pixel).merger;
      const auto step = std::find_if(merger.begin(), merger.end(), [&](const MergeStep& s) {
        return s.fragment.number == number;
      });
      ASSERT_NE(step, merger.end());
      EXPECT_EQ(step->fragment.stored, f.stored);
      EXPECT_EQ(step->fragment.window_z, f.window_z);
      EXPECT_EQ(step->fragment.depth, f.depth);
      EXPECT_EQ(step->colour, f.colour);
    }
    EXPECT_TRUE(trace_primitive(scene, camera, unlit(), number, {}).fragment_list.empty());
    EXPECT_EQ(trace_primitive(scene, camera, unlit(), number, {}).fragments, trace.fragments);
  }
}

TEST(Trace, FollowsLinesAndPoints) {
  const Scene scene = mixed_scene();
  const Camera camera = camera_of_layers();
  const auto line = trace_primitive(scene, camera, unlit(), 5, {.fragments = true});
  EXPECT_EQ(line.kind, PrimitiveKind::line);
  ASSERT_EQ(line.corners.size(), 2u);
  ASSERT_EQ(line.polygon.size(), 2u);
  // u = 3 + 4 x/z, v = 2 + 4 y/z
  EXPECT_NEAR(line.polygon[0].window[0], 1.4, 1e-6);
  EXPECT_NEAR(line.polygon[0].window[1], 2 - 1.6 / 1.5, 1e-6);
  EXPECT_NEAR(line.polygon[1].window[0], 5.4, 1e-6);
  EXPECT_EQ(line.fragments, 5u);  // columns 1 to 5
  const auto point = trace_primitive(scene, camera, unlit(), 6, {.fragments = true});
  EXPECT_EQ(point.kind, PrimitiveKind::point);
  ASSERT_EQ(point.fragment_list.size(), 1u);
  EXPECT_EQ(point.fragment_list[0].pixel, (Pixel{4, 2}));
  EXPECT_NEAR(point.fragment_list[0].depth, 0.75, 1e-6);
  EXPECT_THROW(trace_primitive(scene, camera, unlit(), 7, {}), UsageError);
  EXPECT_THROW(trace_triangle(scene, camera, unlit(), 5, std::nullopt), UsageError);
  PipelineOptions wireframe = unlit();
  wireframe.shading = Shading::wireframe;
  EXPECT_THROW(trace_primitive(scene, camera, wireframe, 0, {}), UsageError);
  EXPECT_EQ(trace_primitive(scene, camera, wireframe, 5, {}).fragments, 5u);
}

/// Two triangles that penetrate: one is cut in two by the plane of the other.
TEST(Trace, ThePaintersOrderShowsItsSplits) {
  Scene scene;
  scene.meshes.resize(1);
  scene.meshes[0].vertices = {{-2, -1, 2},   {2, -1, 4},   {0, 1.5, 3},
                              {-2, -1.2, 4}, {2, -0.8, 2}, {0, 1.4, 3.1}};
  scene.meshes[0].triangles = {{0, 1, 2}, {3, 4, 5}};
  scene.meshes[0].face_of_triangle = {0, 1};
  scene.meshes[0].face_count = 2;
  scene.objects.resize(1);
  PipelineOptions options = unlit();
  options.hidden_surface = HiddenSurface::painter;
  const Camera camera = camera_of_layers();
  const auto trace = trace_primitive(scene, camera, options, 0, {.painter = true});
  const auto frame = render_frame(scene, camera, options, false);
  std::map<PainterStep::Kind, std::uint64_t> steps;
  std::set<std::size_t> whole, painted;
  for (const PainterStep& step : trace.painter.steps) {
    ++steps[step.kind];
    if (step.kind == PainterStep::Kind::split) {
      whole.insert(step.cut);
      EXPECT_EQ(trace.painter.polygons[step.behind].part_of, step.cut);
      EXPECT_EQ(trace.painter.polygons[step.before].part_of, step.cut);
    }
    if (step.kind == PainterStep::Kind::painted) {
      EXPECT_TRUE(painted.insert(step.P).second);
    }
  }
  EXPECT_GE(frame.painter.splits, 1u);
  EXPECT_EQ(steps[PainterStep::Kind::split], frame.painter.splits);
  EXPECT_EQ(steps[PainterStep::Kind::moved], frame.painter.moved);
  EXPECT_EQ(steps[PainterStep::Kind::z_disjoint], frame.painter.z_disjoint);
  std::uint64_t settled = 0;
  for (const auto count : frame.painter.settled) settled += count;
  EXPECT_EQ(steps[PainterStep::Kind::settled], settled);
  // Painted is each polygon that was not cut, once.
  EXPECT_EQ(painted.size() + whole.size(), trace.painter.polygons.size());
  for (const std::size_t cut : whole) EXPECT_FALSE(painted.contains(cut));
}

}  // namespace

/// Each of 500 triangles that share their depths is compared with all that follow it.
TEST(Trace, APaintersOrderOfTooManyStepsIsRefused) {
  Scene scene;
  scene.meshes.resize(1);
  Mesh& mesh = scene.meshes[0];
  std::vector<MeshPoint> vertices;
  for (std::uint32_t t = 0; t < 500; ++t) {
    const double x = (t - 250.0) / 250;
    vertices.insert(vertices.end(), {{x, -1, 2}, {x + 0.003, -1, 3}, {x, 1, 3}});
    mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    mesh.face_of_triangle.push_back(t);
  }
  mesh.vertices = std::move(vertices);
  mesh.face_count = 500;
  scene.objects.resize(1);
  PipelineOptions options = unlit();
  options.hidden_surface = HiddenSurface::painter;
  const Camera camera = camera_of_layers();
  EXPECT_EQ(render_frame(scene, camera, options, false).painter.splits, 0u);
  EXPECT_THROW(trace_primitive(scene, camera, options, 0, {.painter = true}), InputError);
}

}  // namespace fathom::pipeline
