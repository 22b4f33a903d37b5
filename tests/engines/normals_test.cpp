// Normals of every kind: values known by hand, what is special about them, and rays in rational
// numbers over random meshes whose normals are as odd as files have them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fathom/failures/errors.h"
#include "fathom/numeric/rounding.h"
#include "tests/effort.h"
#include "tests/engines/tested_engine.h"
#include "tests/inputs/odd_normals.h"
#include "tests/inputs/random_scenes.h"
#include "tests/oracle/against_oracle.h"

namespace fathom {
namespace {

using checks::camera_of;
using checks::scene_of;
using ::testing::ElementsAre;

using Direction = std::array<float, 3>;

Direction at(const DepthMap& map, const std::string& name, std::size_t pixel) {
  return {(*map.values<float>(name + ".X"))[pixel], (*map.values<float>(name + ".Y"))[pixel],
          (*map.values<float>(name + ".Z"))[pixel]};
}

DepthMap normals_of(const Scene& scene, const Camera& camera,
                    NormalSource source = NormalSource::file) {
  RenderOptions options;
  options.channels = {Channel::Z, Channel::N, Channel::Nc, Channel::Ns};
  options.normals = source;
  return checks::render_tested(scene, camera, options);
}

/// The root of a quotient of integers, rounded once.
float root_of(int numerator, int denominator) {
  return round_sqrt_to_binary32({Dyadic(numerator), Dyadic(denominator)});
}

/// An orthographic camera with one pixel for each unit, whose pixel (i, j) shows x = i, y = j.
Camera grid_camera(std::uint32_t width, std::uint32_t height) {
  Camera camera = camera_of(width, height, 1);
  camera.projection.model = ProjectionModel::orthographic;
  camera.projection.cx = camera.projection.cy = 0.5;
  return camera;
}

/// A wall from (0, 0) to (4, 4) at depth `z`, outwards (towards the camera) −z.
Scene lit_wall(double z = 8) {
  return scene_of({{0, 0, z}, {4, 0, z}, {4, 4, z}, {0, 4, z}}, {{0, 2, 1}, {0, 3, 2}});
}

/// Corners ±4 on the axes, seen from all sides counter-clockwise, its centre at (x, y, 8).
Scene octahedron(double x, double y) {
  std::vector<MeshPoint> v;
  for (const double side : {4.0, -4.0}) {
    v.push_back({x + side, y, 8});
    v.push_back({x, y + side, 8});
    v.push_back({x, y, 8 + side});
  }
  std::vector<CornerIndices> t;
  for (std::uint32_t octant = 0; octant < 8; ++octant) {
    CornerIndices corners{octant & 1 ? 3U : 0U, octant & 2 ? 4U : 1U, octant & 4 ? 5U : 2U};
    const bool odd = ((octant & 1) ^ (octant >> 1 & 1) ^ (octant >> 2 & 1)) != 0;
    if (odd) std::swap(corners[1], corners[2]);
    t.push_back(corners);
  }
  return scene_of(v, t);
}

// By symmetry the sum at a corner is along its axis, and as long as at every other corner: the
// normal at a point of a face is that point over its distance from the centre.
TEST(Normals, OfAnOctahedronPointAwayFromItsCentre) {
  const DepthMap map = normals_of(octahedron(4, 4), grid_camera(9, 9));
  int seen = 0;
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 9; ++x) {
      const std::size_t pixel = static_cast<std::size_t>(y * 9 + x);
      const int dx = x - 4, dy = y - 4, dz = std::abs(dx) + std::abs(dy) - 4;
      if ((*map.values<float>("Z"))[pixel] > 100) {
        EXPECT_THAT(at(map, "Ns", pixel), ElementsAre(0, 0, 0));
        continue;
      }
      ++seen;
      const int square = dx * dx + dy * dy + dz * dz;
      const auto component = [&](int d) {
        return std::copysign(root_of(d * d, square), d == 0 ? 1.0F : static_cast<float>(d));
      };
      EXPECT_THAT(at(map, "Ns", pixel), ElementsAre(component(dx), component(dy), component(dz)))
          << x << ' ' << y;
      if (dx != 0 && dy != 0 && dz != 0) {
        const float third = root_of(1, 3);
        EXPECT_THAT(at(map, "N", pixel),
                    ElementsAre(std::copysign(third, dx), std::copysign(third, dy), -third));
      }
      EXPECT_EQ(at(map, "Nc", pixel), at(map, "N", pixel));  // R is the identity
    }
  }
  EXPECT_GT(seen, 20);
}

TEST(Normals, OfTheFileAreInterpolatedAsTheyAre) {
  Scene scene = lit_wall();
  Mesh& mesh = scene.meshes[0];
  mesh.normals = {{0, 0, -1}, {1, 0, 0}, {1, 0, 0}, {0, 0, -1}};
  const DepthMap map = normals_of(scene, grid_camera(4, 4));
  // At x the weights of the sides are 1 − x/4 and x/4, whichever triangle has the pixel.
  for (int x = 1; x < 4; ++x) {
    const int left = 4 - x, square = x * x + left * left;
    EXPECT_THAT(at(map, "Ns", static_cast<std::size_t>(8 + x)),
                ElementsAre(root_of(x * x, square), 0, -root_of(left * left, square)));
  }
  // Lengths count: three times as long on the left.
  mesh.normals[0] = mesh.normals[3] = {0, 0, -3};
  const DepthMap longer = normals_of(scene, grid_camera(4, 4));
  EXPECT_THAT(at(longer, "Ns", 8 + 2), ElementsAre(root_of(1, 10), 0, -root_of(9, 10)));
  // They are not turned, unlike N: these point away from the camera.
  for (auto& n : mesh.normals) n = {0, 0, 7};
  const DepthMap away = normals_of(scene, grid_camera(4, 4));
  EXPECT_THAT(at(away, "Ns", 5), ElementsAre(0, 0, 1));
  EXPECT_THAT(at(away, "N", 5), ElementsAre(0, 0, -1));
}

TEST(Normals, OfCornersOfTheirOwnAndOfCornersThatHaveNone) {
  Scene scene = lit_wall();
  Mesh& mesh = scene.meshes[0];
  mesh.normals = {{3, 0, -4}};
  mesh.normal_triangles = {{0, 0, 0}, {no_index, no_index, no_index}};
  const DepthMap map = normals_of(scene, grid_camera(4, 4));
  EXPECT_THAT(at(map, "Ns", 4 + 3), ElementsAre(0.6F, 0, -0.8F));  // triangle 0: x > y
  EXPECT_THAT(at(map, "Ns", 12 + 1), ElementsAre(0, 0, -1));
  for (const NormalSource source : {NormalSource::vertex, NormalSource::place})
    EXPECT_THAT(at(normals_of(scene, grid_camera(4, 4), source), "Ns", 7), ElementsAre(0, 0, -1));
}

/// A roof whose ridge, at x = 2, belongs to both sides, or is there twice.
Scene roof(bool seam) {
  std::vector<MeshPoint> v{{0, 0, 10}, {0, 4, 10}, {2, 0, 8}, {2, 4, 8}, {4, 0, 12}, {4, 4, 12}};
  const std::uint32_t c = seam ? 6 : 2, d = seam ? 7 : 3;
  if (seam) v.insert(v.end(), {{2, 0, 8}, {2, 4, 8}});
  return scene_of(v, {{0, 1, 2}, {1, 3, 2}, {c, d, 4}, {d, 5, 4}});
}

// Area vectors of the sides: (−2, 0, −2)·4 and (4, 0, −2)·4. At the vertex (2, 0) meet one or two
// triangles of each side; along the ridge the sums are (−2 + 2·4, −4 − 4) and (−4 + 4, −4 − 2) = in
// x and z, so that at its middle the normal is along (6 + 0, −6 − 6).
TEST(Normals, AreSharedByVertexOrByPlace) {
  const Camera camera = grid_camera(4, 4);
  const std::size_t ridge = 8 + 2;  // belongs to the triangle on its right
  const auto joined = at(normals_of(roof(false), camera), "Ns", ridge);
  EXPECT_EQ(at(normals_of(roof(true), camera, NormalSource::place), "Ns", ridge), joined);
  EXPECT_EQ(at(normals_of(roof(false), camera, NormalSource::place), "Ns", ridge), joined);
  for (const NormalSource source : {NormalSource::file, NormalSource::vertex}) {
    EXPECT_THAT(at(normals_of(roof(true), camera, source), "Ns", ridge),
                ElementsAre(root_of(4, 5), 0, -root_of(1, 5)));
  }
  EXPECT_THAT(joined, ElementsAre(root_of(1, 5), 0, -root_of(4, 5)));
}

/// The wall stretched by 2 in x, sheared, or mirrored, before a camera that sees it all.
TEST(Normals, ArePlacedByTheInverseTranspose) {
  Scene scene = lit_wall();
  scene.meshes[0].normals.assign(4, {1, 0, -1});
  Object& object = scene.objects[0];
  object.placed_as_is = false;
  object.world_from_mesh.rows[0][0] = 2.0;
  const Camera camera = grid_camera(8, 4);
  EXPECT_THAT(at(normals_of(scene, camera), "Ns", 9),
              ElementsAre(root_of(1, 5), 0, -root_of(4, 5)));
  object.world_from_mesh.rows[0][0] = 1.0;
  object.world_from_mesh.rows[0][1] = 1.0;  // x + y: (1, −1, −1)
  EXPECT_THAT(at(normals_of(scene, camera), "Ns", 9),
              ElementsAre(root_of(1, 3), -root_of(1, 3), -root_of(1, 3)));
  // What points outwards still does behind a mirror, given or summed up.
  object.world_from_mesh.rows[0] = {-1.0, 0.0, 0.0, 4.0};
  EXPECT_THAT(at(normals_of(scene, camera), "Ns", 9),
              ElementsAre(-root_of(1, 2), 0, -root_of(1, 2)));
  EXPECT_THAT(at(normals_of(scene, camera, NormalSource::vertex), "Ns", 9), ElementsAre(0, 0, -1));
  // Flat: the cofactors, which are those of the plane that the mesh is flattened into.
  object.world_from_mesh.rows[0] = {1.0, 0.0, 0.0, 0.0};
  object.world_from_mesh.rows[2] = {0.0, 0.0, 0.0, 5.0};
  EXPECT_THAT(at(normals_of(scene, camera), "Ns", 9), ElementsAre(0, 0, -1));
}

TEST(Normals, ThatAreZeroAreWrittenAsZero) {
  Scene scene = lit_wall();
  Mesh& mesh = scene.meshes[0];
  mesh.normals.assign(4, {0, 0, 0});
  const DepthMap none = normals_of(scene, grid_camera(4, 4));
  for (const float x : at(none, "Ns", 5)) {
    EXPECT_EQ(x, 0);
    EXPECT_FALSE(std::signbit(x));
  }
  EXPECT_EQ((*none.values<float>("Z"))[5], 8);
  // Opposite ones cancel in the middle, and nowhere else.
  mesh.normals = {{-1, 0, -1}, {1, 0, 1}, {1, 0, 1}, {-1, 0, -1}};
  const DepthMap map = normals_of(scene, grid_camera(4, 4));
  EXPECT_THAT(at(map, "Ns", 9), ElementsAre(-root_of(1, 2), 0, -root_of(1, 2)));
  EXPECT_THAT(at(map, "Ns", 10), ElementsAre(0, 0, 0));
  EXPECT_THAT(at(map, "Ns", 11), ElementsAre(root_of(1, 2), 0, root_of(1, 2)));
  for (const float x : at(map, "Ns", 10)) EXPECT_FALSE(std::signbit(x));
  // One that is zero counts for nothing: beside it the others do.
  mesh.normals = {{0, 0, 0}, {0, 0, -2}, {0, 0, -2}, {0, 0, 0}};
  EXPECT_THAT(at(normals_of(scene, grid_camera(4, 4)), "Ns", 9), ElementsAre(0, 0, -1));
}

// A quarter turn about y: R takes the world's x to the camera's z.
TEST(Normals, InTheCameraFrameAreTurnedByR) {
  const Scene scene = scene_of({{5, -9, -9}, {5, 9, -9}, {8, 0, 12}}, {{0, 1, 2}});
  Camera camera = camera_of(3, 3, 1);
  camera.world_to_camera = {{{0, 0, -1, 0}, {0, 1, 0, 0}, {1, 0, 0, 0}}};
  const DepthMap map = normals_of(scene, camera);
  // (0, 18, 0) × (3, 9, 21) = 18·(21, 0, −3), turned against +x.
  EXPECT_THAT(at(map, "N", 4), ElementsAre(-root_of(49, 50), 0, root_of(1, 50)));
  EXPECT_THAT(at(map, "Nc", 4), ElementsAre(-root_of(1, 50), 0, -root_of(49, 50)));
}

// x is doubled before it is seen: normals of what is seen have half the x that R·N has.
TEST(Normals, InTheCameraFrameAreThoseOfWhatTheCameraSees) {
  const Scene scene = scene_of({{-9, -9, -1}, {-9, 9, -1}, {9, 0, 17}}, {{0, 1, 2}});
  for (const double x : {2.0, -2.0}) {
    Camera camera = camera_of(3, 3, 1);
    camera.world_to_camera[0][0] = x;
    for (const double fx : {1.0, -1.0}) {
      camera.projection.fx = fx;
      const DepthMap map = normals_of(scene, camera);
      EXPECT_THAT(at(map, "N", 4), ElementsAre(root_of(1, 2), 0, -root_of(1, 2)));
      EXPECT_THAT(at(map, "Nc", 4),
                  ElementsAre(std::copysign(root_of(1, 5), x), 0, -root_of(4, 5)));
    }
  }
}

// x/2ⁿ with x odd and n ≥ 1 is no component of a unit vector along a rational one: from
// a² + b² + c² = d² with a/d = x/2ⁿ would follow (2ⁿ − x)(2ⁿ + x)·m² = p² + q² in integers with m
// odd, whose left side is 3 modulo 4. So nothing ever lies exactly between two binary32 numbers; as
// near to that as numbers of a file come is this.
TEST(Normals, ThatAlmostLieBetweenTwoNumbersAreRoundedRight) {
  std::mt19937_64 random(17);
  int below = 0, above = 0;
  for (int i = 0; i < 200; ++i) {
    // The middle of two binary32 numbers, h = x/2²⁵, and b/a the binary64 number nearest to √(1/h²
    // − 1).
    const double h = std::ldexp(static_cast<double>((random() >> 40) | (1U << 24U) | 1U), -25);
    const double b = std::sqrt((1 - h) * (1 + h)) / h;
    Scene scene = lit_wall();
    scene.meshes[0].normals.assign(4, {1, b, 0});
    const float found = at(normals_of(scene, grid_camera(4, 4)), "Ns", 5)[0];
    const Dyadic square = Dyadic(1.0) + Dyadic(b) * Dyadic(b);
    // 1/√(1 + b²) > h where 1 > h²·(1 + b²).
    const bool is_above = Dyadic(h) * Dyadic(h) * square < Dyadic(1.0);
    const auto nearest = static_cast<float>(h);
    const float up = static_cast<double>(nearest) > h ? nearest : std::nextafter(nearest, 2.0F);
    EXPECT_EQ(found, is_above ? up : std::nextafter(up, 0.0F)) << h;
    ++(is_above ? above : below);
  }
  EXPECT_GT(below, 50);
  EXPECT_GT(above, 50);
}

TEST(Normals, TheMapSaysWhereTheyComeFrom) {
  EXPECT_EQ(normals_of(lit_wall(), grid_camera(2, 2)).texts.count("fathom.normals"), 0U);
  const DepthMap map = normals_of(lit_wall(), grid_camera(2, 2), NormalSource::place);
  EXPECT_EQ(map.texts.at("fathom.normals"), "place");
}

class RandomNormals : public ::testing::TestWithParam<checks::Kind> {};

TEST_P(RandomNormals, AreThoseOfRays) {
  const auto seed = static_cast<std::uint64_t>(4400 + static_cast<int>(GetParam()));
  checks::CaseMaker maker(seed, GetParam());
  std::mt19937_64 random(seed);
  const auto below = [&](unsigned n) { return static_cast<int>(random() % n); };
  int seen = 0;
  for (int i = 0; i < 300 / checks::effort && !HasFailure(); ++i) {
    SCOPED_TRACE(i);
    checks::Case c = maker.make();
    if (i % 4 != 0) checks::add_odd_normals(c.scene.meshes[0], random);
    if (i % 2 == 0) {
      Object& object = c.scene.objects[0];
      object.placed_as_is = false;
      for (auto& row : object.world_from_mesh.rows) {
        for (Dyadic& entry : row) {
          if (below(3) == 0) entry += Dyadic((below(9) - 4) / 4.0);
        }
      }
    }
    RenderOptions options;
    options.channels = checks::all_channels();
    options.threads = 1;
    constexpr std::array sources{NormalSource::file, NormalSource::vertex, NormalSource::place};
    options.normals = sources[static_cast<std::size_t>(below(3))];
    const DepthMap map = checks::render_tested(c.scene, c.camera, options);
    seen += checks::expect_as_rays(map, c.scene, c.camera, options.normals);
  }
  EXPECT_GT(seen, 200 / checks::effort);
}

INSTANTIATE_TEST_SUITE_P(Normals, RandomNormals,
                         ::testing::Values(checks::Kind::few_bits, checks::Kind::neighbours,
                                           checks::Kind::huge, checks::Kind::tiny));

}  // namespace
}  // namespace fathom
