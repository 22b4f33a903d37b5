// Visible edges against a judge that compares all triangles at the middle of every piece of every
// line.
#include "fathom/area/visible_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "fathom/failures/errors.h"
#include "tests/adversaries.h"
#include "tests/area/crowds.h"
#include "tests/area/judged_edges.h"
#include "tests/area/surfaces.h"
#include "tests/inputs/adversarial_scenes.h"
#include "tests/inputs/random_scenes.h"
#include "tests/inputs/soup.h"
#include "tests/inputs/spheres.h"
#include "tests/oracle/against_oracle.h"

namespace fathom {
namespace {

using checks::Case;
using checks::JudgedEdge;
using oracle::Point;
using oracle::Q;

std::vector<VisibleEdge> edges_of(const Scene& scene, const Camera& camera,
                                  const EdgeOptions& options = {.edges = EdgeSelection::all}) {
  std::vector<VisibleEdge> edges;
  visible_edges(scene, camera, options, [&](const VisibleEdge& edge) { edges.push_back(edge); });
  return edges;
}

Point point_of(const ImagePlace& place) {
  return {checks::rational(place.u), checks::rational(place.v)};
}

checks::JudgedScene judged_scene(const Scene& scene, const Camera& camera) {
  checks::JudgedScene judged{
      checks::ray_camera(camera), camera.width, camera.height, checks::triangles_of(scene), {}};
  const TriangleSource triangles(scene);
  for (std::uint32_t number = 0; number < triangles.count(); ++number)
    judged.objects.push_back(triangles.origin(number).object);
  return judged;
}

/// Whether p lies on the segment.
bool is_between(const Point& from, const Point& to, const Point& p) {
  const Q turn = (to[0] - from[0]) * (p[1] - from[1]) - (to[1] - from[1]) * (p[0] - from[0]);
  return sgn(turn) == 0 && std::min(from, to) <= p && p <= std::max(from, to);
}

/// Every piece of the judge is on one edge, with its sides, and the ends of an edge are ends of
/// pieces.
void expect_judged(const std::vector<VisibleEdge>& edges, const std::vector<JudgedEdge>& pieces) {
  std::vector<bool> is_found(pieces.size());
  for (const VisibleEdge& edge : edges) {
    const Point from = point_of(edge.from), to = point_of(edge.to);
    Q length = 0;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const JudgedEdge& piece = pieces[k];
      if (!is_between(from, to, piece.from) || !is_between(from, to, piece.to)) continue;
      EXPECT_FALSE(is_found[k]) << "drawn twice";
      is_found[k] = true;
      EXPECT_EQ(edge.owner, piece.owner);
      EXPECT_EQ(edge.other, piece.other ? *piece.other : VisibleEdge::background);
      EXPECT_EQ(edge.joined, piece.joined);
      length += abs(piece.to[0] - piece.from[0]) + abs(piece.to[1] - piece.from[1]);
    }
    EXPECT_EQ(length, abs(to[0] - from[0]) + abs(to[1] - from[1])) << "a stub";
  }
  EXPECT_EQ(std::ranges::count(is_found, false), 0) << "a gap";
}

/// Edges of one name are in order, and joined where they can be.
void expect_merged(const std::vector<VisibleEdge>& edges) {
  for (std::size_t k = 1; k < edges.size(); ++k) {
    const VisibleEdge &a = edges[k - 1], &b = edges[k];
    if (a.name != b.name) continue;
    EXPECT_LE(point_of(a.to), point_of(b.from));
    const bool is_same = a.owner == b.owner && a.other == b.other && a.joined == b.joined;
    EXPECT_FALSE(is_same && point_of(a.to) == point_of(b.from)) << "cut in two";
  }
}

void expect_as_judged(const Scene& scene, const Camera& camera) {
  const std::vector<JudgedEdge> pieces = checks::judged_edges(judged_scene(scene, camera));
  const std::vector<VisibleEdge> edges = edges_of(scene, camera);
  // Only so few triangles may all be hidden, culled or seen edge on.
  EXPECT_TRUE(TriangleSource(scene).count() <= 20 || pieces.size() > 3U);
  expect_judged(edges, pieces);
  expect_merged(edges);
  std::vector<JudgedEdge> outlines;
  std::ranges::copy_if(pieces, std::back_inserter(outlines),
                       [](const JudgedEdge& piece) { return !piece.joined; });
  expect_judged(edges_of(scene, camera, {.edges = EdgeSelection::silhouettes}), outlines);
}

TEST(VisibleEdgesAdversaries, AreJudged) {
  for (const checks::Family family : checks::all_families) {
    SCOPED_TRACE(name_of(family));
    checks::for_each_adversary(12, [&](std::uint64_t seed) {
      const Case c = checks::adversarial_case(family, seed);
      expect_as_judged(c.scene, c.camera);
    });
  }
}

TEST(VisibleEdges, OfRandomScenesAreJudged) {
  for (const checks::Kind kind :
       {checks::Kind::few_bits, checks::Kind::neighbours, checks::Kind::huge, checks::Kind::tiny}) {
    checks::CaseMaker maker(54 + static_cast<std::uint64_t>(kind), kind);
    for (int i = 0; i < 60 / checks::effort && !HasFailure(); ++i) {
      SCOPED_TRACE(i);
      const Case c = maker.make();
      expect_as_judged(c.scene, c.camera);
    }
  }
}

TEST(VisibleEdges, OfCrowdsAreJudged) {
  for (const checks::Crowd& crowd : checks::crowds()) {
    SCOPED_TRACE(crowd.name);
    expect_as_judged(crowd.scene, checks::plain_camera(1, 1));
    expect_as_judged(crowd.scene, checks::plain_camera(3, 2));
  }
}

// Scenes of more triangles than a line sweep takes at once: parts, sheets and sides of parts. On an
// image of 8×8 pixels, parts end at whole numbers.

/// Adds triangles with corners at halves, in a slab of depths.
void add_triangles(checks::CrowdBuilder& crowd, std::mt19937_64& random, int count, double size) {
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  for (int i = 0; i < count; ++i) {
    const double u = below(17) / 2.0, v = below(17) / 2.0;
    const auto corner = [&] {
      return MeshPoint{u + size * (below(5) - 2) / 2, v + size * (below(5) - 2) / 2,
                       4 + below(9) / 2.0};
    };
    const MeshPoint a = corner(), b = corner(), c = corner();
    crowd.add(a, b, c);
  }
}

/// A surface over a grid of whole numbers; `scale` grid lines of 8 are left out.
void add_terrain(checks::CrowdBuilder& crowd, std::mt19937_64& random, int step, double depth) {
  std::vector<double> heights(81);
  for (double& height : heights) height = depth + static_cast<double>(random() % 3) / 2;
  const auto at = [&](int x, int y) {
    return MeshPoint{double(x), double(y), heights[static_cast<std::size_t>(9 * y + x)]};
  };
  for (int y = 0; y < 8; y += step) {
    for (int x = 0; x < 8; x += step) {
      crowd.add(at(x, y), at(x + step, y), at(x, y + step));
      crowd.add(at(x + step, y), at(x + step, y + step), at(x, y + step));
    }
  }
}

/// The same scene in front of an eye, at the same places of the image.
Scene in_perspective(Scene scene) {
  for (MeshPoint& p : scene.meshes[0].vertices) p = {p.x * p.z, p.y * p.z, p.z};
  return scene;
}

Camera eye(std::uint32_t size) {
  Camera camera = checks::camera_of(size, size, 1);
  camera.projection.cx = camera.projection.cy = 0;
  return camera;
}

void expect_as_judged_by_both(const Scene& scene) {
  expect_as_judged(scene, checks::plain_camera(8, 8));
  expect_as_judged(in_perspective(scene), eye(8));
}

TEST(VisibleEdges, OfTerrainsAreJudged) {
  std::mt19937_64 random(81);
  for (int i = 0; i < 4 / std::min(checks::effort, 4) && !HasFailure(); ++i) {
    SCOPED_TRACE(i);
    checks::CrowdBuilder crowd;
    add_terrain(crowd, random, i % 2 == 0 ? 1 : 2, 6);
    add_triangles(crowd, random, i % 2 == 0 ? 3 : 12, 3);
    expect_as_judged_by_both(crowd.scene());
  }
}

TEST(VisibleEdges, OfManyTrianglesAreJudged) {
  std::mt19937_64 random(82);
  for (int i = 0; i < 4 / std::min(checks::effort, 4) && !HasFailure(); ++i) {
    SCOPED_TRACE(i);
    checks::CrowdBuilder crowd;
    add_triangles(crowd, random, 50, 1);
    expect_as_judged_by_both(crowd.scene());
  }
}

/// Planes that cross exactly where the image is cut, behind triangles that make it be cut.
TEST(VisibleEdges, OfPlanesThatCrossAtASideOfPartsAreJudged) {
  std::mt19937_64 random(83);
  checks::CrowdBuilder crowd;
  for (const double slope : {1.0, -1.0}) {
    const auto at = [&](double x, double y) { return MeshPoint{x, y, 20 + slope * (x - 4)}; };
    crowd.add(at(-1, -1), at(19, -1), at(-1, 19));
  }
  add_triangles(crowd, random, 40, 1);
  expect_as_judged_by_both(crowd.scene());
}

/// A sheet that reaches beyond the image, with triangles in front of one corner: the image is cut,
/// and parts elsewhere show nothing but the sheet.
TEST(VisibleEdges, OfASheetInManyPartsAreJudged) {
  std::mt19937_64 random(84);
  for (const double tilt : {0.0, 0.125}) {
    SCOPED_TRACE(tilt);
    checks::CrowdBuilder crowd;
    std::vector<double> depths(64);
    for (double& depth : depths) depth = 12 + static_cast<double>(random() % 5) / 4;
    const auto at = [&](int x, int y) {
      return MeshPoint{x - 1.5 + tilt * y, y - 1.5 - tilt * x,
                       depths[static_cast<std::size_t>(8 * y + x)]};
    };
    for (int y = 0; y < 7; ++y) {
      for (int x = 0; x < 7; ++x) {
        crowd.add(at(x, y), at(x + 1, y), at(x, y + 1));
        crowd.add(at(x + 1, y), at(x + 1, y + 1), at(x, y + 1));
      }
    }
    for (int k = 0; k < 34; ++k) {
      const double u = k % 6 / 16.0, v = k / 6 / 16.0;
      crowd.add({u, v, 4}, {u + 0.0625, v, 4}, {u, v + 0.0625, 4});
    }
    expect_as_judged(crowd.scene(), checks::plain_camera(4, 4));
    expect_as_judged(in_perspective(crowd.scene()), eye(4));
  }
}

/// Closed boxes of which each face is divided into a grid: sheets, in parts that hold nothing else.
Mesh divided_box(int cells) {
  Mesh mesh;
  const auto add_face = [&](std::size_t axis, double level) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const auto columns = static_cast<std::uint32_t>(cells + 1);
    for (std::uint32_t i = 0; i < columns * columns; ++i) {
      std::array<double, 3> p{};
      p[axis] = level;
      p[(axis + 1) % 3] = 2.0 * (i % columns) / cells - 1;
      p[(axis + 2) % 3] = 2.0 * (i / columns) / cells - 1;
      mesh.vertices.push_back({p[0], p[1], p[2]});
    }
    for (std::uint32_t i = 0; i < columns * (columns - 1); ++i) {
      if (i % columns == columns - 1) continue;
      const std::uint32_t a = first + i, b = a + columns;
      mesh.triangles.push_back({a, a + 1, b + 1});
      mesh.triangles.push_back({a, b + 1, b});
    }
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double level : {-1.0, 1.0}) add_face(axis, level);
  }
  mesh.face_count = mesh.triangles.size();
  return mesh;
}

TEST(VisibleEdges, OfBoxesThatPenetrateEachOtherAreJudged) {
  Scene scene;
  scene.meshes = {divided_box(4), divided_box(1)};
  scene.objects = {{.mesh = 0, .name = "one"}, {.mesh = 1, .name = "two"}};
  scene.objects[1].placed_as_is = false;
  scene.objects[1].world_from_mesh.rows = {
      {{0.5, 0, 0.25, 0.75}, {0, 0.5, 0, -0.5}, {-0.25, 0, 0.5, -0.75}}};
  Camera camera = checks::plain_camera(8, 8);
  camera.projection.cx = camera.projection.cy = 4;
  camera.world_to_camera = {{{2, 1, 0, 0}, {-0.5, 1, 2, 0}, {1, -2, 1, 8}}};
  expect_as_judged(scene, camera);
  camera.projection.model = ProjectionModel::perspective;
  camera.projection.fx = camera.projection.fy = 8;
  expect_as_judged(scene, camera);
  camera.world_to_camera = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 4}}};
  expect_as_judged(scene, camera);
}

/// A rhombic dodecahedron: its faces meet at an angle of exactly 60 degrees between their normals.
Scene dodecahedron() {
  std::vector<MeshPoint> vertices;
  std::vector<CornerIndices> triangles;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (int signs = 0; signs < 4; ++signs) {
      const double s = signs % 2 == 0 ? 1 : -1, t = signs < 2 ? 1 : -1;
      const auto at = [&](double x, double y, double z) {
        std::array<double, 3> p{};
        p[axis] = x;
        p[(axis + 1) % 3] = y;
        p[(axis + 2) % 3] = z;
        return MeshPoint{p[0], p[1], p[2]};
      };
      const auto first = static_cast<std::uint32_t>(vertices.size());
      vertices.insert(vertices.end(),
                      {at(1, s, t), at(0, 2 * s, 0), at(-1, s, t), at(0, 0, 2 * t)});
      const bool is_outward = s * t > 0;
      triangles.push_back(is_outward ? CornerIndices{first, first + 1, first + 2}
                                     : CornerIndices{first, first + 2, first + 1});
      triangles.push_back(is_outward ? CornerIndices{first, first + 2, first + 3}
                                     : CornerIndices{first, first + 3, first + 2});
    }
  }
  return checks::scene_of(std::move(vertices), std::move(triangles));
}

TEST(VisibleEdges, CreasesAreEdgesThatTurnByTheAngle) {
  const Scene scene = dodecahedron();
  Camera camera = checks::camera_of(16, 16, 12);
  camera.world_to_camera = {{{3, 1, 0, 0}, {-1, 3, 1, 0}, {0.5, -1, 3, 16}}};
  const std::vector<oracle::Triangle> triangles = checks::triangles_of(scene);
  const auto normal_of = [&](std::uint32_t number) {
    const auto& [a, b, c] = triangles[number];
    oracle::Vector n;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
      n[k] = (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);
    }
    return n;
  };
  // cos 60° = 1/2; normals of a closed surface point outwards.
  std::vector<VisibleEdge> expected;
  for (const VisibleEdge& edge : edges_of(scene, camera)) {
    if (edge.joined) {
      const oracle::Vector m = normal_of(edge.owner), n = normal_of(edge.other);
      Q product = 0, square = 1;
      for (std::size_t k = 0; k < 3; ++k) product += m[k] * n[k];
      for (const oracle::Vector& each : {m, n})
        square *= each[0] * each[0] + each[1] * each[1] + each[2] * each[2];
      if (sgn(product) > 0 && 4 * product * product > square) continue;
    }
    expected.push_back(edge);
  }
  const auto names = [](const std::vector<VisibleEdge>& edges) {
    std::vector<EdgeName> all;
    for (const VisibleEdge& edge : edges) all.push_back(edge.name);
    return all;
  };
  const auto found = edges_of(scene, camera, {.edges = EdgeSelection::creases, .crease_angle = 60});
  EXPECT_EQ(names(found), names(expected));
  const std::size_t outlines =
      edges_of(scene, camera, {.edges = EdgeSelection::silhouettes}).size();
  EXPECT_GT(found.size(), outlines);
  // The winding of a triangle does not matter.
  Scene turned = scene;
  for (std::size_t t = 0; t < turned.meshes[0].triangles.size(); t += 3)
    std::swap(turned.meshes[0].triangles[t][0], turned.meshes[0].triangles[t][1]);
  EXPECT_EQ(edges_of(turned, camera, {.crease_angle = 60}).size(), found.size());
  const double next = std::nextafter(60, 180);
  EXPECT_EQ(edges_of(scene, camera, {.crease_angle = next}).size(), outlines);
  EXPECT_LT(found.size(), edges_of(scene, camera).size());
}

TEST(VisibleEdges, RefuseAnglesAndLenses) {
  const Scene scene = checks::box_scene(1, 1, 1);
  Camera camera = checks::camera_of(4, 4, 4);
  EXPECT_THROW(edges_of(scene, camera, {.crease_angle = 180.5}), UsageError);
  camera.projection.lens = Lens{.model = LensModel::opencv, .distortion = {0.1}};
  EXPECT_THROW(edges_of(scene, camera), UsageError);
}

}  // namespace
}  // namespace fathom
