// What the stages up to the window compute and count, each number known beforehand.
#include "fathom/pipeline/geometry/geometry_stages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "fathom/failures/errors.h"
#include "fathom/numeric/rounding.h"
#include "fathom/pipeline/render_pipeline.h"
#include "tests/inputs/scene_building.h"

namespace fathom::pipeline {
namespace {

/// 32 × 32 pixels; (x, y, 2) lies at 16 + 16·x, 16 + 16·y.
Camera camera() {
  Camera camera = checks::camera_of(32, 32, 32);
  camera.near = 1;
  camera.far = 100;
  return camera;
}

PipelineOptions precise() {
  PipelineOptions options;
  options.precision = Precision::binary64;
  options.shading = Shading::none;
  return options;
}

/// Each number differs from all others, so that none can stand for another.
TEST(GeometryStages, CountWhatBecomesOfTriangles) {
  using Corners = std::array<MeshPoint, 3>;
  // Corners that run counter-clockwise as seen, y down: front faces.
  const Corners front{{{-0.5, 0.5, 2}, {0.5, 0.5, 2}, {0, -0.5, 2}}};
  const Corners back{{{0.5, 0.5, 2}, {-0.5, 0.5, 2}, {0, -0.5, 2}}};
  const Corners edge_on{{{0, 0, 2}, {0, 0, 3}, {0, 0, 4}}};
  const Corners outside{{{9, 0, 2}, {10, 0, 2}, {9, 1, 2}}};
  const Corners cut{
      {{0, 0.5, 2}, {9, 0.5, 2}, {0, -0.5, 2}}};              // a quadrangle is left: two triangles
  const Corners tip{{{0, 0, 2}, {9, 0.5, 2}, {9, -0.5, 2}}};  // a smaller triangle is left
  // Narrower than half a step of the grid of whole pixels: snapping leaves no area.
  const Corners thin{{{-0.01, 0.3, 2}, {0.01, 0.3, 2}, {0, -0.3, 2}}};
  std::vector<MeshPoint> vertices;
  std::vector<CornerIndices> triangles;
  const auto add = [&](const Corners& corners, int times) {
    for (int i = 0; i < times; ++i) {
      const auto first = static_cast<std::uint32_t>(vertices.size());
      vertices.insert(vertices.end(), corners.begin(), corners.end());
      triangles.push_back({first, first + 1, first + 2});
    }
  };
  add(front, 1), add(back, 2), add(edge_on, 3), add(outside, 4), add(cut, 5), add(thin, 6),
      add(tip, 7);
  const Scene scene = checks::scene_of(vertices, triangles);
  PipelineOptions options = precise();
  options.subpixel_bits = 0;
  const PipelineStatistics all = render_frame(scene, camera(), options, false).statistics;
  EXPECT_EQ(all.triangles, 28u);
  EXPECT_EQ(all.not_finite, 0u);
  EXPECT_EQ(all.clipped_away, 4u);
  EXPECT_EQ(all.clipped, 5u + 7);
  EXPECT_EQ(all.degenerate, 3u);
  EXPECT_EQ(all.culled, 0u);
  EXPECT_EQ(all.drawn, 1u + 2 + 2 * 5 + 6 + 7);
  EXPECT_EQ(all.turned_by_snapping, 6u);
  EXPECT_EQ(all.shaded, 0u);
  EXPECT_EQ(all.near, 1);
  EXPECT_EQ(all.far, 100);
  EXPECT_EQ(all.facings.compared, 12u);  // front, back, edge on and thin
  EXPECT_EQ(all.facings.front_in_world, 7u);
  EXPECT_EQ(all.facings.front_in_ndc, 7u);
  EXPECT_EQ(all.facings.front_in_window, 7u);
  EXPECT_EQ(all.facings.disagreeing, 0u);

  options.culling = Culling::back;
  const PipelineStatistics kept = render_frame(scene, camera(), options, false).statistics;
  EXPECT_EQ(kept.culled, 2u);
  EXPECT_EQ(kept.degenerate, 3u);
  EXPECT_EQ(kept.drawn, all.drawn - 2);
  options.culling = Culling::front;
  const PipelineStatistics turned = render_frame(scene, camera(), options, false).statistics;
  EXPECT_EQ(turned.culled, 1u + 5 + 6 + 7);
  EXPECT_EQ(turned.drawn, 2u);
  options.culling = Culling::none;
  options.front_face = FrontFace::clockwise;
  const PipelineStatistics other = render_frame(scene, camera(), options, false).statistics;
  EXPECT_EQ(other.facings.front_in_world, 2u);
  EXPECT_EQ(other.facings.front_in_window, 2u);
  EXPECT_EQ(other.turned_by_snapping, 6u);
}

/// Squares from (3, 5) to (27, 29), one behind the other, cut by y = x + 2.
TEST(GeometryStages, CountFragmentsAndBlocks) {
  std::vector<MeshPoint> vertices;
  for (const double z : {2.0, 4.0}) {
    const auto at = [&](double u, double v) {
      vertices.push_back({(u - 16) / 32 * z, (v - 16) / 32 * z, z});
    };
    at(3, 5), at(27, 5), at(27, 29), at(3, 29);
  }
  const Scene scene = checks::scene_of(vertices, {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}});
  PipelineOptions options = precise();
  const PipelineStatistics s = render_frame(scene, camera(), options, true).statistics;
  EXPECT_EQ(s.fragments, 1152u);
  EXPECT_EQ(s.depth_passed, 576u);
  EXPECT_EQ(s.shaded, 576u);
  // Of the 16 blocks of each triangle, one is wholly inside the upper one, from (16, 8); three are
  // below the line and six above it.
  EXPECT_EQ(s.blocks_full, 2u);
  EXPECT_EQ(s.blocks_skipped, 18u);
  options.antialias = {AntialiasMethod::msaa, 4};
  const PipelineStatistics multi = render_frame(scene, camera(), options, true).statistics;
  EXPECT_EQ(multi.shaded * 2, multi.fragments);  // what lies behind is not shaded
  EXPECT_GT(multi.shaded, 576u);                 // but pixels on the line between two are, twice
  EXPECT_EQ(multi.depth_passed, 4 * 576u);
  options.antialias = {};
  options.early_depth = false;
  const PipelineStatistics late = render_frame(scene, camera(), options, true).statistics;
  EXPECT_EQ(late.shaded, 1152u);
  EXPECT_EQ(late.depth_passed, 576u);
  options.scan = ScanConversion::scan_line;
  const PipelineStatistics lines = render_frame(scene, camera(), options, true).statistics;
  EXPECT_EQ(lines.fragments, 1152u);
  EXPECT_EQ(lines.shaded, 1152u);
  EXPECT_EQ(lines.depth_passed, 576u);
  options.early_depth = true;
  EXPECT_EQ(render_frame(scene, camera(), options, true).statistics.shaded, 576u);
  EXPECT_EQ(render_frame(scene, camera(), options, false).statistics.shaded, 0u);
}

TEST(GeometryStages, ObjectsAreNumberedOneAfterTheOther) {
  Scene scene = checks::scene_of({{-0.9, 0.5, 2},
                                  {-0.1, 0.5, 2},
                                  {-0.5, -0.5, 2},
                                  {0.1, 0.5, 2},
                                  {0.9, 0.5, 2},
                                  {0.5, -0.5, 2}},
                                 {{0, 1, 2}, {3, 4, 5}});
  scene.objects.push_back(scene.objects[0]);
  PipelineStatistics statistics;
  PipelineOptions options = precise();
  options.depth_format.near = 1;
  options.depth_format.far = 100;
  const auto window =
      to_window<double>(scene, camera(), options, draw_rules_of(scene, options), statistics);
  ASSERT_EQ(window.triangles.size(), 4u);
  for (std::uint32_t i = 0; i < 4; ++i) EXPECT_EQ(window.triangles[i].number, i);
  EXPECT_TRUE(window.lines.empty() && window.points.empty());
  EXPECT_EQ(window.triangles[0].corners[0].x, 16 - 0.9 * 16);
  EXPECT_EQ(window.triangles[1].corners[2].y, 8);
  EXPECT_TRUE(window.triangles[0].front);
}

/// The world's point is where exact arithmetic places it, and the normal stands on what it stood
/// on: on the two directions in its plane, and on the same side.
TEST(VertexTransform, AttributesGoWithTheirVertex) {
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> unit(-1, 1);
  int mirrored = 0;
  for (int i = 0; i < 200; ++i) {
    Object object;
    object.placed_as_is = false;
    std::array<std::array<double, 4>, 3> m{};
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 4; ++c) {
        m[r][c] = (r == c) * (i % 3 == 0 ? -1.5 : 1.5) + unit(random);
        object.world_from_mesh.rows[r][c] = Dyadic(m[r][c]);
      }
    }
    const auto apply = [&](const std::array<double, 3>& d) {
      std::array<double, 3> q{};
      for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t c = 0; c < 3; ++c) q[r] += m[r][c] * d[c];
      }
      return q;
    };
    const auto dot = [](const auto& a, const auto& b) {
      return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    };
    const auto cross = [](const auto& a, const auto& b) {
      return std::array<double, 3>{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                                   a[0] * b[1] - a[1] * b[0]};
    };
    PipelineOptions options = precise();
    options.depth_format.near = 1;
    options.depth_format.far = 100;
    Camera moved = camera();
    moved.world_to_camera[2][3] = 30;
    const VertexTransform<double> transform(moved, object, options);
    InputVertex vertex;
    vertex.position = {unit(random), unit(random), unit(random)};
    const std::array<double, 3> s{unit(random), unit(random), unit(random)},
        t{unit(random), unit(random), unit(random)};
    vertex.normal = cross(s, t);
    vertex.uv = {unit(random), unit(random)};
    vertex.colour = {unit(random), unit(random), unit(random)};
    const auto a = transform(vertex).attributes;
    const auto world = apply({vertex.position.x, vertex.position.y, vertex.position.z});
    // A few dozen roundings of numbers below 2⁶.
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(a[attribute::world + k], world[k] + m[k][3], 1e-13);
      EXPECT_EQ(a[attribute::colour + k], vertex.colour[k]);
    }
    EXPECT_NEAR(a[attribute::depth], world[2] + m[2][3] + 30, 1e-12);
    EXPECT_EQ(a[attribute::uv], vertex.uv[0]);
    EXPECT_EQ(a[attribute::uv + 1], vertex.uv[1]);
    const std::array<double, 3> normal{a[attribute::normal], a[attribute::normal + 1],
                                       a[attribute::normal + 2]};
    EXPECT_NEAR(dot(normal, apply(s)), 0, 1e-12);
    EXPECT_NEAR(dot(normal, apply(t)), 0, 1e-12);
    // It stays on the side from which s and t run counter-clockwise, also in a mirror.
    EXPECT_GT(dot(normal, cross(apply(s), apply(t))), 0);
    const auto column = [&](std::size_t c) { return std::array{m[0][c], m[1][c], m[2][c]}; };
    mirrored += dot(column(0), cross(column(1), column(2))) < 0;
  }
  EXPECT_GT(mirrored, 30);
  EXPECT_LT(mirrored, 170);
}

TEST(FillInRange, KeepsWhatTheCameraHas) {
  const Scene scene = checks::scene_of({{0, 0, 2}, {1, 0, 3}, {0, 1, 8}}, {{0, 1, 2}});
  const auto filled = [&](double near, double far, Mapping mapping, const Scene& of) {
    Camera c = checks::camera_of(8, 8, 4);
    c.near = near;
    c.far = far;
    DepthFormat format{mapping, Storage::float32, 0, 0, 1};
    fill_in_range(of, c, format);
    return std::array{format.near, format.far};
  };
  using Range = std::array<double, 2>;
  const double none = std::numeric_limits<double>::infinity();
  EXPECT_EQ(filled(0.25, none, Mapping::standard, scene), (Range{0.25, 16}));
  EXPECT_EQ(filled(0.25, none, Mapping::infinite, scene), (Range{0.25, none}));
  EXPECT_EQ(filled(0, 6, Mapping::standard, scene), (Range{1, 6}));
  EXPECT_EQ(filled(50, none, Mapping::standard, scene),
            (Range{50, 100}));  // nothing is so far away
  // Less than 1 away, at the eye, behind it, nothing at all.
  const Scene close = checks::scene_of({{0, 0, 0.25}, {1, 0, 0.5}, {0, 1, 0.5}}, {{0, 1, 2}});
  EXPECT_EQ(filled(0, none, Mapping::standard, close), (Range{0.125, 1}));
  const Scene at_eye = checks::scene_of({{0, 0, 0}, {1, 0, 0.5}, {0, 1, 0.5}}, {{0, 1, 2}});
  EXPECT_EQ(filled(0, none, Mapping::standard, at_eye), (Range{0.5e-4, 1}));
  const Scene behind = checks::scene_of({{0, 0, -2}, {1, 0, -1}, {0, 1, -3}}, {{0, 1, 2}});
  const Scene flat = checks::scene_of({{0, 0, 4}, {1, 0, 4}, {0, 1, 4}}, {{0, 1, 2}});
  EXPECT_EQ(filled(0, none, Mapping::standard, flat), (Range{2, 8}));
  EXPECT_EQ(filled(0, none, Mapping::standard, behind), (Range{1e-4, 2}));
  EXPECT_EQ(filled(0, none, Mapping::standard, Scene{}), (Range{1e-4, 2}));
}

TEST(PrimitiveAssembly, NormalsAreSumsOfAreasAndColoursTheVertexs) {
  // Two triangles at vertex 0, of areas 4 and 1/2, facing +z and +x.
  Scene scene = checks::scene_of({{1, 2, 3}, {3, 2, 3}, {1, 6, 3}, {1, 3, 3}, {1, 2, 4}, {7, 7, 7}},
                                 {{0, 1, 2}, {0, 3, 4}});
  Mesh& mesh = scene.meshes[0];
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const auto part = static_cast<float>(i) / 8;
    mesh.colours.push_back({part, part + 0.125F, part + 0.25F, 1});
    mesh.texture_coordinates.push_back({static_cast<double>(i), -static_cast<double>(i)});
  }
  const auto triangles = assemble_triangles(scene, 0, 40, FrontFace::counter_clockwise);
  using Vector = std::array<double, 3>;
  ASSERT_EQ(triangles.size(), 2u);
  EXPECT_EQ(triangles[0].number, 40u);
  EXPECT_EQ(triangles[1].number, 41u);
  EXPECT_EQ(triangles[0].corners[1].normal, (Vector{0, 0, 1}));
  EXPECT_EQ(triangles[1].corners[2].normal, (Vector{1, 0, 0}));
  const Vector& both = triangles[1].corners[0].normal;
  EXPECT_DOUBLE_EQ(both[0], 1 / std::sqrt(65));
  EXPECT_EQ(both[1], 0);
  EXPECT_DOUBLE_EQ(both[2], 8 / std::sqrt(65));
  EXPECT_EQ(triangles[1].corners[1].position.y, 3);
  EXPECT_EQ(triangles[1].corners[1].colour, (Vector{0.375, 0.5, 0.625}));
  EXPECT_EQ(triangles[1].corners[2].uv, (std::array<double, 2>{4, -4}));
  EXPECT_TRUE(has_texture_coordinates(scene));
  // Coordinates of their own for each triangle, then one that is missing, then none at all.
  mesh.texture_triangles = {{5, 4, 3}, {2, 1, 0}};
  EXPECT_EQ(assemble_triangles(scene, 0, 0, FrontFace::counter_clockwise)[1].corners[0].uv,
            (std::array<double, 2>{2, -2}));
  EXPECT_TRUE(has_texture_coordinates(scene));
  mesh.texture_triangles[1][2] = no_index;
  EXPECT_FALSE(has_texture_coordinates(scene));
  mesh.texture_triangles.clear();
  mesh.texture_coordinates.clear();
  EXPECT_FALSE(has_texture_coordinates(scene));
  EXPECT_EQ(assemble_triangles(scene, 0, 0, FrontFace::counter_clockwise)[1].corners[2].uv,
            (std::array<double, 2>{0, 0}));
  mesh.colours.clear();
  EXPECT_EQ(assemble_triangles(scene, 0, 0, FrontFace::counter_clockwise)[0].corners[2].colour,
            (Vector{1, 1, 1}));
  // Slanted in all directions.
  const Scene slanted = checks::scene_of({{1, 2, 3}, {2, 5, 5}, {4, 3, 9}}, {{0, 1, 2}});
  const Vector n =
      assemble_triangles(slanted, 0, 0, FrontFace::counter_clockwise)[0].corners[2].normal;
  const double length = std::sqrt(16 * 16 + 8 * 8);  // (1, 3, 2) × (3, 1, 6) = (16, 0, −8)
  EXPECT_DOUBLE_EQ(n[0], 16 / length);
  EXPECT_EQ(n[1], 0);
  EXPECT_DOUBLE_EQ(n[2], -8 / length);
  const Scene other = checks::scene_of({{1, 2, 3}, {2, 2, 3.5}, {4, 3, 4}}, {{0, 1, 2}});
  const Vector o =
      assemble_triangles(other, 0, 0, FrontFace::counter_clockwise)[0].corners[0].normal;
  // (1, 0, ½) × (3, 1, 1) = (−½, ½, 1)
  EXPECT_DOUBLE_EQ(o[0], -0.5 / std::sqrt(1.5));
  EXPECT_DOUBLE_EQ(o[1], 0.5 / std::sqrt(1.5));
  EXPECT_DOUBLE_EQ(o[2], 1 / std::sqrt(1.5));
}

// The triangles of NormalsAreSumsOfAreas, each with vertices of its own: 0 and 3 lie at one place,
// as -0.0 does at 0.
TEST(PrimitiveAssembly, NormalsAtAPlaceAreSumsOverAllItsVertices) {
  const Scene scene =
      checks::scene_of({{0, 2, 3}, {2, 2, 3}, {0, 6, 3}, {-0.0, 2, 3}, {0, 3, 3}, {0, 2, 4}},
                       {{0, 1, 2}, {3, 4, 5}});
  using Vector = std::array<double, 3>;
  const auto by_vertex = assemble_triangles(scene, 0, 0, FrontFace::counter_clockwise);
  EXPECT_EQ(by_vertex[0].corners[0].normal, (Vector{0, 0, 1}));
  EXPECT_EQ(by_vertex[1].corners[0].normal, (Vector{1, 0, 0}));
  const auto by_place = assemble_triangles(scene, 0, 0, FrontFace::clockwise, NormalSource::place);
  for (const std::size_t t : {0, 1}) {
    const Vector& both = by_place[t].corners[0].normal;
    EXPECT_DOUBLE_EQ(both[0], -1 / std::sqrt(65));
    EXPECT_EQ(both[1], 0);
    EXPECT_DOUBLE_EQ(both[2], -8 / std::sqrt(65));
  }
  EXPECT_EQ(by_place[0].corners[1].normal, (Vector{0, 0, -1}));
  EXPECT_EQ(by_place[1].corners[2].normal, (Vector{-1, 0, 0}));
  // Normals of the file give way to sums that are asked for.
  Scene with_normals = scene;
  with_normals.meshes[0].normals.assign(6, {0, 1, 0});
  const auto normal = [&](NormalSource source) {
    return assemble_triangles(with_normals, 0, 0, FrontFace::counter_clockwise, source)[1]
        .corners[0]
        .normal;
  };
  EXPECT_EQ(normal(NormalSource::file), (Vector{0, 1, 0}));
  EXPECT_EQ(normal(NormalSource::vertex), (Vector{1, 0, 0}));
  EXPECT_DOUBLE_EQ(normal(NormalSource::place)[2], 8 / std::sqrt(65));
}

ClipVertex<double> corner(double x, double y, double z, double w) {
  ClipVertex<double> v{{x, y, z, w}, std::vector<double>(attribute::count, 0.0)};
  for (std::size_t i = 0; i < attribute::count; ++i) {
    v.attributes[i] =
        static_cast<double>(i + 1) * (x + 2 * y + 3 * z + 4 * w);  // linear in clip space
  }
  return v;
}

void expect_linear(const ClipVertex<double>& v) {
  const auto& [x, y, z, w] = v.position;
  for (std::size_t i = 0; i < attribute::count; ++i) {
    EXPECT_NEAR(v.attributes[i], static_cast<double>(i + 1) * (x + 2 * y + 3 * z + 4 * w), 1e-12);
  }
}

TEST(ClipTriangle, CornersThatProjectNowhere) {
  using clipping::Volume;
  const auto inside = corner(0, 0, 0.5, 1), right = corner(0.5, 0, 0.5, 1);
  // All zero: no point at all. A direction: the triangle reaches to the boundary, without end.
  EXPECT_TRUE(clip_triangle<double>({inside, right, corner(0, 0, 0, 0)}, Volume::zero_one).empty());
  for (const auto& direction : {corner(0, 1, 0, 0), corner(1, 0, 0, 0), corner(0, 0, 1, 0)}) {
    const auto polygon = clip_triangle<double>({inside, right, direction}, Volume::zero_one);
    EXPECT_GE(polygon.size(), direction.position.x == 1 ? 0u : 3u);
    for (const auto& v : polygon) {
      EXPECT_GT(v.position.w, 0);
      expect_linear(v);
    }
  }
  EXPECT_TRUE(is_inside(corner(1, 1, 0, 1), Volume::zero_one));
  EXPECT_FALSE(is_inside(corner(0, 0, 0, 0), Volume::zero_one));
  EXPECT_TRUE(is_inside(corner(0, 0, 0, 0.5), Volume::zero_one));
  for (const double s : {-1.0, 1.0}) {
    EXPECT_FALSE(is_inside(corner(1.5 * s, 0, 0.5, 1), Volume::zero_one));
    EXPECT_FALSE(is_inside(corner(0, 1.5 * s, 0.5, 1), Volume::zero_one));
    EXPECT_FALSE(is_inside(corner(0, 0, 0.5 + s, 1), Volume::zero_one));
  }
}

TEST(ClipLine, KeepsWhatLiesOnTheLine) {
  using clipping::Volume;
  std::mt19937_64 random(23);
  int kept = 0, cut = 0, gone = 0;
  for (int i = 0; i < 4000; ++i) {
    const auto number = [&] { return (static_cast<int>(random() % 17) - 8) / 4.0; };
    const auto a = corner(number(), number(), number(), number());
    const auto b = corner(number(), number(), number(), number());
    const auto line = clip_line(a, b, Volume::zero_one);
    // The parts of the line that are inside, by looking at many points of it.
    double first = 2, last = -1;
    for (int k = 0; k <= 512; ++k) {
      const double t = k / 512.0;
      const auto mix = [&](double p, double q) { return p + t * (q - p); };
      const auto p = corner(mix(a.position.x, b.position.x), mix(a.position.y, b.position.y),
                            mix(a.position.z, b.position.z), mix(a.position.w, b.position.w));
      if (!is_inside(p, Volume::zero_one)) continue;
      first = std::min(first, t);
      last = std::max(last, t);
    }
    if (!line) {
      ++gone;
      EXPECT_LE(last - first, 0) << i;  // at most a point of it
      continue;
    }
    ++(is_inside(a, Volume::zero_one) && is_inside(b, Volume::zero_one) ? kept : cut);
    for (const auto& end : *line) expect_linear(end);
    const auto parameter = [&](const ClipVertex<double>& v) {
      const double d[] = {b.position.x - a.position.x, b.position.y - a.position.y,
                          b.position.z - a.position.z, b.position.w - a.position.w};
      const double q[] = {v.position.x - a.position.x, v.position.y - a.position.y,
                          v.position.z - a.position.z, v.position.w - a.position.w};
      double qd = 0, dd = 0;
      for (int k = 0; k < 4; ++k) qd += q[k] * d[k], dd += d[k] * d[k];
      return dd > 0 ? qd / dd : 0;
    };
    if (last < first) continue;  // shorter than the steps
    EXPECT_NEAR(parameter((*line)[0]), first, 1.0 / 256) << i;
    if (parameter((*line)[1]) > 0) {
      EXPECT_NEAR(parameter((*line)[1]), last, 1.0 / 256) << i;
    }
  }
  EXPECT_GT(kept, 10);
  EXPECT_GT(cut, 100);
  EXPECT_GT(gone, 1000);
}

TEST(Viewport, StretchesWhereTheRatioIsAnother) {
  const Camera c = checks::camera_of(10, 10, 1);
  PipelineOptions options;
  EXPECT_FALSE(is_stretched(c, options));
  options.viewport = WindowRectangle{0, 0, 5, 5};
  EXPECT_FALSE(is_stretched(c, options));
  options.viewport = WindowRectangle{0, 0, 5, 6};
  EXPECT_TRUE(is_stretched(c, options));
}

/// Window depth p·x + q·y + r: the slopes are p and q, whatever the corners.
TEST(WindowTriangle, TheOffsetIsThatOfItsPlane) {
  std::mt19937_64 random(29);
  std::uniform_real_distribution<double> place(0, 64), slope(-0.005, 0.005);
  for (int i = 0; i < 200; ++i) {
    const double p = slope(random), q = slope(random);
    WindowTriangle<double> t;
    for (auto& c : t.corners) {
      c.x = place(random);
      c.y = place(random);
      c.z = 0.5 + p * c.x + q * c.y;
    }
    PipelineOptions options;
    options.depth_format.storage = Storage::unorm16;
    options.polygon_offset = {4, 0, 0};
    // The quotient of two determinants, each with a few roundings; slivers are rare here.
    EXPECT_NEAR(depth_offset(t, options.depth_format.storage, options.polygon_offset),
                4 * std::max(std::abs(p), std::abs(q)), 1e-9)
        << i;
    options.polygon_offset = {0, 3, 0};
    EXPECT_DOUBLE_EQ(depth_offset(t, options.depth_format.storage, options.polygon_offset),
                     3.0 / 65535);
    options.polygon_offset = {-1, 2, 0};
    EXPECT_NEAR(depth_offset(t, options.depth_format.storage, options.polygon_offset),
                2.0 / 65535 - std::max(std::abs(p), std::abs(q)), 1e-9);
    options.polygon_offset = {};
    EXPECT_EQ(depth_offset(t, options.depth_format.storage, options.polygon_offset), 0);
    // Floats: by the exponent of the greatest depth.
    options.depth_format.storage = Storage::float32;
    options.polygon_offset = {0, 1, 0};
    t.corners[i % 3].z = 0.75;
    t.corners[(i + 1) % 3].z = 0.01;
    t.corners[(i + 2) % 3].z = 0.2;
    EXPECT_EQ(depth_offset(t, options.depth_format.storage, options.polygon_offset), 0x1p-24);
  }
}

TEST(Options, RectanglesMayReachTheLimits) {
  constexpr std::int64_t most = 1 << 20;
  const auto accepted = [](const WindowRectangle& r) {
    PipelineOptions viewport, scissor;
    viewport.viewport = r;
    scissor.scissor = r;
    EXPECT_NO_THROW(require_meaningful(viewport));
    EXPECT_NO_THROW(require_meaningful(scissor));
  };
  const auto refused = [](const WindowRectangle& r) {
    PipelineOptions options;
    options.viewport = r;
    EXPECT_THROW(require_meaningful(options), UsageError);
  };
  accepted({most, most, most, most});
  accepted({-most, -most, 1, 1});
  for (const WindowRectangle& r : {WindowRectangle{most + 1, 0, 1, 1},
                                   {0, most + 1, 1, 1},
                                   {-most - 1, 0, 1, 1},
                                   {0, -most - 1, 1, 1},
                                   {0, 0, most + 1, 1},
                                   {0, 0, 1, most + 1},
                                   {0, 0, 0, 1},
                                   {0, 0, 1, 0}}) {
    refused(r);
  }
}

/// Each of Newell's tests of planes by itself: what is behind the other's plane, and what has the
/// other before its own.
TEST(Painter, PlanesSettleWhatOneSideOfOneOfThemSettles) {
  const auto settled = [](const std::vector<MeshPoint>& points) {
    PipelineOptions options = precise();
    options.hidden_surface = HiddenSurface::painter;
    return render_frame(checks::scene_of(points, {{0, 1, 2}, {3, 4, 5}}), camera(), options, false)
        .painter;
  };
  // The farther one (it has the farthest corner) is level at z = 5 but for that; the other one's
  // plane passes through it, or not.
  const std::vector<MeshPoint> level{{-1, -1, 5}, {1, -1, 5}, {0, 1, 5}};
  const auto with_level = [&](const std::vector<MeshPoint>& other) {
    std::vector<MeshPoint> both = level;
    both.insert(both.end(), other.begin(), other.end());
    return settled(both);
  };
  // In front of z = 5, its own plane cuts the level one: test 4 alone. Depths overlap by a touch at
  // 5.
  const PainterStatistics before = with_level({{-0.2, -0.2, 4}, {0.2, -0.2, 4.99}, {0, 0.2, 4.5}});
  EXPECT_EQ(before.z_disjoint, 1u);
  const std::vector<MeshPoint> tilted{{-1, -1, 4}, {1, -1, 6}, {0, 1, 5}};
  std::vector<MeshPoint> both = tilted;
  for (const MeshPoint& p : {MeshPoint{-0.2, -0.2, 4.3}, {0.2, -0.2, 4.3}, {0, 0.2, 4.9}})
    both.push_back(p);
  const PainterStatistics in_front = settled(both);
  EXPECT_EQ(in_front.settled, (std::array<std::uint64_t, 5>{0, 0, 0, 1, 0}));
  EXPECT_EQ(in_front.moved, 0u);
  EXPECT_EQ(in_front.splits, 0u);
  // A small one behind a large one in whose plane it does not lie, deepest of all: test 3.
  std::vector<MeshPoint> behind = {{-0.2, -0.2, 5.6}, {0.2, -0.2, 6.4}, {0, 0.2, 5.5}};
  for (const MeshPoint& p : {MeshPoint{-2, -2, 4}, {2, -2, 6}, {0, 2, 5}}) behind.push_back(p);
  const PainterStatistics deepest = settled(behind);
  EXPECT_EQ(deepest.settled, (std::array<std::uint64_t, 5>{0, 0, 1, 0, 0}));
}

}  // namespace
}  // namespace fathom::pipeline
