// docs/sources.md, visibility: errors 22 to 32. Error 25 is of a clipper: tests/clipping.

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "fathom/clipping/cohen_sutherland.h"
#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/homogeneous.h"
#include "fathom/pipeline/render_pipeline.h"
#include "tests/inputs/scene_building.h"
#include "tests/pipeline/errata_cases.h"

namespace fathom::pipeline {
namespace {

using fathom::checks::scene_of;

TEST(Errata, E22_TheProjectionOfAPointBehindTheEye) {
  Camera camera = window_camera(8, 8);
  camera.projection.model = ProjectionModel::perspective;
  camera.near = 1;
  camera.far = 2;
  PipelineOptions options;
  options.depth_format.mapping = Mapping::opengl;
  fill_in_range({}, camera, options.depth_format);
  const VertexTransform<double> transform(camera, {}, options);
  // The frame of the source, z backward: (0, 0, n) is behind the eye.
  const auto clip = transform.to_clip({0, 0, 1});
  EXPECT_EQ(clip.z, -7);
  EXPECT_EQ(clip.w, -1);
  // 3 = (f + n)/(f − n) bounds z/w from below, for points behind the eye; none of them has it.
  double before = 1e300;
  for (const double z : {0.125, 1.0, 8.0, 64.0, 4096.0}) {
    const auto p = transform.to_clip({0, 0, z});
    EXPECT_GT(p.z / p.w, 3);
    EXPECT_LT(p.z / p.w, before);
    before = p.z / p.w;
  }
  EXPECT_LT(before, 3.001);
}

TEST(Errata, E23_TheSignInTheHomogeneousIntersection) {
  // R = (3, 0, 0, 1), S = (0, 0, 0, 2) and the plane x = w: x(t) − w(t) = 2 + t(−3 − 1).
  using clipping::Rational;
  const clipping::Segment4<Rational> segment{{3, 0, 0, 1}, {0, 0, 0, 2}};
  clipping::LiangBarskyTrace<Rational> trace;
  const auto part = clipping::clip_homogeneous(segment, clipping::Volume::zero_one,
                                               clipping::Half::upper, &trace);
  ASSERT_TRUE(part);
  EXPECT_EQ(trace.t_entering, Rational(1, 2));
  EXPECT_EQ(trace.t_leaving, Rational(1));
  EXPECT_EQ(part->start.x, Rational(3, 2));
  EXPECT_EQ(part->start.w, Rational(3, 2));
  // The source's x(t) − w(t) = R_x − R_w + t((S_w − R_w) − (S_x − R_x)) is 0 at −½, and not there.
  const Rational t = trace.t_entering, rx = 3, rw = 1, sx = 0, sw = 2;
  EXPECT_EQ(rx - rw + t * ((sx - rx) - (sw - rw)), 0);
  EXPECT_EQ(rx - rw + t * ((sw - rw) - (sx - rx)), 4);
}

TEST(Errata, E24_ASharedOutcodeIsTestTwo) {
  // From the left of the window to above it, past its corner.
  using clipping::Rational;
  const clipping::Segment2<Rational> D{{-1, 3}, {1, 9}};
  const clipping::Window<Rational> window{0, 0, 4, 4};
  std::vector<clipping::CohenSutherlandStep<Rational>> trace;
  EXPECT_FALSE(clipping::cohen_sutherland(D, window, &trace));
  ASSERT_EQ(trace.size(), 2u);
  EXPECT_EQ(clipping::to_bits(trace[0].E1), "0001");  // left: the source has 0010
  EXPECT_EQ(clipping::to_bits(trace[0].E2), "1000");
  EXPECT_EQ(trace[0].test, 4);
  // E3 = (0, 6) and E2 share the top: the source says test 4.
  EXPECT_EQ(trace[1].segment.start, (clipping::Point2<Rational>{0, 6}));
  EXPECT_EQ(trace[1].E1 & trace[1].E2, clipping::outcode::top);
  EXPECT_EQ(trace[1].test, 2);
}

std::vector<double> facing_shares(bool closed) {
  // A cube, or an open box: its front removed.
  std::vector<MeshPoint> v;
  for (int i = 0; i < 8; ++i) v.push_back({i & 1 ? 1. : -1., i & 2 ? 1. : -1., i & 4 ? 5. : 3.});
  std::vector<CornerIndices> t{{4, 5, 7}, {4, 7, 6}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7},
                               {1, 7, 5}, {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3}};
  if (closed) t.push_back({0, 2, 3}), t.push_back({0, 3, 1});
  const Scene scene = scene_of(v, t);
  Camera camera;
  camera.width = camera.height = 64;
  camera.projection.fx = camera.projection.fy = 64;
  camera.projection.cx = camera.projection.cy = 32;
  camera.near = 1;
  camera.far = 10;
  PipelineOptions options;
  const auto none = render_frame(scene, camera, options, false);
  options.culling = Culling::back;
  const auto back = render_frame(scene, camera, options, false);
  double different = 0;
  for (std::size_t i = 0; i < none.id.size(); ++i)
    different += (none.id[i] == no_surface) != (back.id[i] == no_surface);
  return {different, static_cast<double>(back.statistics.culled)};
}

TEST(Errata, E26_CullingNeedsAClosedSurface) {
  EXPECT_EQ(facing_shares(true)[0], 0);   // closed: nothing is missing
  EXPECT_GT(facing_shares(false)[0], 0);  // open: a hole, however convex
  // 10 of 12 faces of the cube are culled from straight ahead: half is an average.
  EXPECT_EQ(facing_shares(true)[1], 10);
}

TEST(Errata, E27_NormalInNdcAndDeterminantAreTheSameNumber) {
  const std::array<NdcVertex<double>, 3> t{
      {{-0.5, -0.5, 0.1, 1, {}}, {0.5, -0.5, 0.7, 1, {}}, {0, 0.5, 0.2, 1, {}}}};
  const double n_z = (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[1].y - t[0].y) * (t[2].x - t[0].x);
  EXPECT_GT(n_z, 0);  // "positive: remove" would remove this front face
  EXPECT_EQ(facing_in_ndc(t, FrontFace::counter_clockwise), Facing::front);
}

TEST(Errata, E28_CullingAfterTheDivisionSeesWhatIsDrawn) {
  // Of a triangle with a corner behind the eye, the signed area of the divided corners is that of
  // another triangle; clipping comes first.
  std::vector<ClipVertex<double>> t;
  for (const auto& [x, y, w] : {std::array{-1., -1., 2.}, {1., -1., 2.}, {0., 3., -1.}})
    t.push_back({{x, y, w > 0 ? 1. : -2., w}, std::vector<double>(attribute::count)});
  const auto area = [](const auto& v) {
    return (v[1].x - v[0].x) * (v[2].y - v[0].y) - (v[2].x - v[0].x) * (v[1].y - v[0].y);
  };
  std::vector<NdcVertex<double>> wrong, right;
  for (const auto& corner : t) wrong.push_back(divide(corner));
  for (const auto& corner : clip_triangle(t, clipping::Volume::zero_one))
    right.push_back(divide(corner));
  ASSERT_GE(right.size(), 3u);
  EXPECT_LT(area(wrong), 0);
  EXPECT_GT(area(right), 0);
  // The stage itself: the same triangle, y down, keeps every pixel when back faces are culled, and
  // loses all of them when it is turned.
  Camera camera = window_camera(64, 64);
  camera.projection.model = ProjectionModel::perspective;
  camera.projection.fx = camera.projection.fy = camera.projection.cx = camera.projection.cy = 32;
  camera.near = 0.5;
  camera.far = 10;
  const auto pixels = [&](CornerIndices corners, Culling culling) {
    PipelineOptions options;
    options.culling = culling;
    const Scene scene = scene_of({{-1, 1, 2}, {1, 1, 2}, {0, -3, -1}}, {corners});
    const PipelineFrame frame = render_frame(scene, camera, options, false);
    EXPECT_EQ(frame.statistics.clipped, 1u);
    return std::count(frame.id.begin(), frame.id.end(), 0u);
  };
  const auto all = pixels({0, 1, 2}, Culling::none);
  EXPECT_GT(all, 500);
  EXPECT_EQ(pixels({0, 1, 2}, Culling::back), all);
  EXPECT_EQ(pixels({0, 1, 2}, Culling::front), 0);
  EXPECT_EQ(pixels({0, 2, 1}, Culling::back), 0);
  EXPECT_EQ(pixels({0, 2, 1}, Culling::front), all);
}

TEST(Errata, E29_OneViewDirectionIsWrongInPerspective) {
  // A face to the side, turned a little away from the axis, but towards the eye.
  const std::array<WorldVertex<double>, 3> t{{{4, 0, 4}, {4.2, 0, 6}, {4, 1, 4}}};
  const auto eye = facing_in_world(t, {0, 0, 0}, true, false, FrontFace::counter_clockwise);
  const auto fixed = facing_in_world(t, {0, 0, -1}, false, false, FrontFace::counter_clockwise);
  EXPECT_NE(eye, fixed);
}

TEST(Errata, E30_SortingByTheFarthestCornerAloneIsWrong) {
  // A small triangle before a large slanted one that begins nearer and ends farther.
  const Scene scene =
      scene_of({{-4, -4, 2}, {4, -4, 2}, {0, 6, 9}, {-1, 0, 6}, {1, 0, 6}, {0, -1, 6.5}},
               {{3, 4, 5}, {0, 1, 2}});
  Camera camera;
  camera.width = camera.height = 64;
  camera.projection.fx = camera.projection.fy = 64;
  camera.projection.cx = camera.projection.cy = 32;
  camera.near = 1;
  camera.far = 20;
  PipelineOptions options;
  options.precision = Precision::binary64;
  const PipelineFrame buffer = render_frame(scene, camera, options, false);
  options.hidden_surface = HiddenSurface::painter;
  const PipelineFrame painter = render_frame(scene, camera, options, false);
  EXPECT_EQ(buffer.id, painter.id);
  EXPECT_GT(painter.painter.comparisons, 0u);  // zmax alone does not settle it
}

TEST(Errata, E31_TheTablesContradictThemselves) {
  // A triangle whose coverage at pixel centres is the black one of the 12-column tables: its sides
  // are x = 5.4 − k/2 and x = 5.8 + 3k/5 at the centre of row k.
  const double top = -4. / 11;
  const auto at = [](double k, double x) { return MeshPoint{x, k + 0.5, 0.5}; };
  const Scene scene = scene_of({at(top, 5.4 - top / 2), at(20, 17.8), at(20, -4.6)}, {{0, 1, 2}});
  PipelineOptions options;
  options.precision = Precision::binary64;
  options.shading = Shading::none;
  options.background = {0, 0, 0};
  Camera camera = window_camera(12, 9);
  camera.near = 0.125;
  const PipelineFrame frame = render_frame(scene, camera, options, true);
  const auto row = [&](std::size_t y, const auto& word) {
    std::string words;
    for (std::size_t x = 0; x < 12; ++x) words += (x ? " " : "") + std::string(word(12 * y + x));
    return words;
  };
  const auto depth = [&](std::size_t y) {
    return row(y, [&](std::size_t i) { return frame.depth[i] == 0.5F ? ".5" : "1.0"; });
  };
  const auto colour = [&](std::size_t y) {
    return row(y, [&](std::size_t i) { return frame.picture.pixels[i][0] > 0.5F ? "B" : "W"; });
  };
  // Row 7 of the source, and those beside it, which do agree.
  EXPECT_EQ(depth(5), "1.0 1.0 1.0 .5 .5 .5 .5 .5 .5 1.0 1.0 1.0");
  EXPECT_EQ(colour(5), "W W W B B B B B B W W W");
  EXPECT_EQ(depth(6), "1.0 1.0 .5 .5 .5 .5 .5 .5 .5 1.0 1.0 1.0");
  EXPECT_EQ(colour(6), "W W B B B B B B B W W W");
  EXPECT_NE(colour(6), "W W B B B B B B B B W W");  // its colours
  EXPECT_EQ(depth(7), "1.0 1.0 .5 .5 .5 .5 .5 .5 .5 .5 1.0 1.0");
  EXPECT_EQ(colour(7), "W W B B B B B B B B W W");
}

TEST(Errata, E32_TheDeterminantsLastFactor) {
  // (x2−x1)(y3−y1) − (x3−x1)(y3−y1) has another sign for many a triangle.
  int different = 0;
  for (int i = 0; i < 5 * 5 * 5 * 5; ++i) {
    const int x2 = i % 5 - 2, y2 = i / 5 % 5 - 2, x3 = i / 25 % 5 - 2, y3 = i / 125 - 2;
    const int wrong = x2 * y3 - x3 * y3, right = x2 * y3 - x3 * y2;
    const Facing facing = right > 0 ? Facing::front : right < 0 ? Facing::back : Facing::edge_on;
    const Facing theirs = wrong > 0 ? Facing::front : wrong < 0 ? Facing::back : Facing::edge_on;
    std::array<NdcVertex<double>, 3> ndc{};
    ndc[0].x = ndc[0].y = 0.5;  // nothing depends on where x1 and y1 are
    ndc[1] = {0.5 + x2, 0.5 + y2, 0, 1, {}};
    ndc[2] = {0.5 + x3, 0.5 + y3, 0, 1, {}};
    EXPECT_EQ(facing_in_ndc(ndc, FrontFace::counter_clockwise), facing);
    std::array<WindowVertex<double>, 3> window{};  // y down
    for (std::size_t k = 0; k < 3; ++k) window[k] = {ndc[k].x, -ndc[k].y, 0, 1, {}};
    EXPECT_EQ(facing_in_window(window, FrontFace::counter_clockwise), facing);
    different += facing != theirs;
  }
  EXPECT_GT(different, 100);
}

}  // namespace
}  // namespace fathom::pipeline
