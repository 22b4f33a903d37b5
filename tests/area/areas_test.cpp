// Areas that lights see, against slabs in rational numbers, areas by pairs, and closed forms.
#include "fathom/area/areas.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fathom/area/seen_scene.h"
#include "fathom/failures/errors.h"
#include "tests/adversaries.h"
#include "tests/area/pairwise_areas.h"
#include "tests/area/slab_areas.h"
#include "tests/inputs/adversarial_scenes.h"
#include "tests/inputs/random_scenes.h"
#include "tests/inputs/spheres.h"
#include "tests/oracle/against_oracle.h"
#include "tests/oracle/mpfr_rounding.h"

namespace fathom {
namespace {

using checks::Case;
using checks::rational;
using oracle::Q;

double nearest(const Q& q) {
  return oracle::quotient(oracle::binary64, q.get_mpq_t());
}
/// √q rounded once: the nearest of three neighbours, by comparing squares of midpoints.
double nearest_root(const Q& q) {
  if (sgn(q) == 0) return 0;
  double root = std::sqrt(nearest(q));
  const auto is_below_middle = [&](double low) {
    const Q middle = (Q(low) + Q(std::nextafter(low, INFINITY))) / 2;
    return q < middle * middle;
  };
  while (!is_below_middle(root)) root = std::nextafter(root, INFINITY);
  while (is_below_middle(std::nextafter(root, 0))) root = std::nextafter(root, 0);
  return root;
}

oracle::Vector vector_of(const std::array<double, 3>& v) {
  return {Q(v[0]), Q(v[1]), Q(v[2])};
}
Q product(const oracle::Vector& a, const oracle::Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
oracle::Vector normal_of(const oracle::Triangle& t) {
  oracle::Vector e, f;
  for (std::size_t k = 0; k < 3; ++k) {
    e[k] = t[1][k] - t[0][k];
    f[k] = t[2][k] - t[0][k];
  }
  return {e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]};
}

std::vector<oracle::Triangle> triangles_of(const Scene& scene) {
  std::vector<oracle::Triangle> triangles;
  const TriangleSource source(scene);
  for (std::uint32_t number = 0; number < source.count(); ++number) {
    oracle::Triangle& t = triangles.emplace_back();
    const auto corners = source.world_corners(number);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& [x, y, z] = corners[k];
      t[k] = {checks::rational(x), checks::rational(y), checks::rational(z)};
    }
  }
  return triangles;
}

void expect_in_direction(const Scene& scene, const AreaDirection& direction) {
  const std::vector<oracle::Triangle> triangles = triangles_of(scene);
  const oracle::Vector d = vector_of(direction);
  const std::vector<checks::SlabArea> expected = checks::slab_areas(triangles, d);
  const std::vector<LitArea> found = areas_in_direction(scene, direction, {.threads = 1});
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t t = 0; t < found.size(); ++t) {
    SCOPED_TRACE("triangle " + std::to_string(t));
    const oracle::Vector n = normal_of(triangles[t]);
    const Q facing = product(n, d), share = expected[t].share;
    const LitSide side = sgn(facing) > 0   ? LitSide::front
                         : sgn(facing) < 0 ? LitSide::back
                                           : LitSide::edge;
    EXPECT_EQ(found[t].side, side);
    const Q across = facing * facing / (4 * product(d, d));
    EXPECT_EQ(found[t].projected, nearest_root(across));
    EXPECT_EQ(found[t].visible, nearest_root(share * share * across));
    EXPECT_EQ(found[t].lit, nearest_root(share * share * product(n, n) / 4));
    ASSERT_EQ(found[t].fraction.has_value(), side != LitSide::edge);
    if (found[t].fraction) {
      EXPECT_EQ(*found[t].fraction, nearest(share));
    }
    ASSERT_EQ(found[t].centroid.has_value(), sgn(share) != 0);
    for (std::size_t axis = 0; axis < 3 && found[t].centroid; ++axis) {
      EXPECT_EQ((*found[t].centroid)[axis], nearest(expected[t].moment[axis] / share));
    }
  }
}

/// Directions along axes and edges, and others.
AreaDirection direction_of(std::mt19937_64& random) {
  AreaDirection d{};
  do {
    for (double& x : d) {
      x = static_cast<double>(random() % 9) - 4;
      if (random() % 4 == 0) x = std::nextafter(x, random() % 2 ? 9 : -9);
    }
  } while (d == AreaDirection{0, 0, 0});
  return d;
}

TEST(AreasAdversaries, InADirectionAreThoseOfSlabs) {
  for (const checks::Kind kind : {checks::Kind::few_bits, checks::Kind::neighbours}) {
    std::mt19937_64 random(6);
    checks::CaseMaker maker(99, kind);
    for (std::uint64_t i = 0; i < checks::number_of_adversaries(60) && !HasFailure(); ++i) {
      SCOPED_TRACE(i);
      const Case c = maker.make();
      const AreaDirection d = direction_of(random);
      expect_in_direction(c.scene, d);
    }
  }
}

/// A box in units of 0.1 m and two panels that stand off it (sksat/orts, issue 407).
Scene satellite() {
  std::vector<MeshPoint> v;
  std::vector<CornerIndices> t;
  const auto add = [&](const MeshPoint& a, const MeshPoint& b, const MeshPoint& c,
                       const MeshPoint& d) {
    const auto n = static_cast<std::uint32_t>(v.size());
    v.insert(v.end(), {a, b, c, d});
    t.push_back({n, n + 1, n + 2});
    t.push_back({n, n + 2, n + 3});
  };
  add({5, -5, -5}, {5, 5, -5}, {5, 5, 5}, {5, -5, 5});
  add({-5, -5, -5}, {-5, -5, 5}, {-5, 5, 5}, {-5, 5, -5});
  add({-5, 5, -5}, {-5, 5, 5}, {5, 5, 5}, {5, 5, -5});
  add({-5, -5, -5}, {5, -5, -5}, {5, -5, 5}, {-5, -5, 5});
  add({-5, -5, 5}, {5, -5, 5}, {5, 5, 5}, {-5, 5, 5});
  add({-5, -5, -5}, {-5, 5, -5}, {5, 5, -5}, {5, -5, -5});
  add({0, 6, -5}, {0, 26, -5}, {0, 26, 5}, {0, 6, 5});
  add({0, -26, -5}, {0, -6, -5}, {0, -6, 5}, {0, -26, 5});
  return checks::scene_of(v, t);
}

/// Every two triangles a face.
AreaOptions by_faces(const Scene& scene) {
  AreaOptions options;
  const auto count = static_cast<std::uint32_t>(scene.meshes[0].triangles.size());
  for (std::uint32_t t = 0; t < count; ++t) options.groups.push_back(t / 2);
  options.group_count = count / 2;
  return options;
}

// With τ = tan θ: of the panel on +y 21/20 − τ/4, with its centre at 31/20 + τ/4 m; of the face −y
// 1/2 + 1/(10τ), with its centre at 1/4 − 1/(20τ) m.
TEST(Areas, OfASatelliteAreRational) {
  const Scene scene = satellite();
  constexpr std::size_t panel = 6, face = 3;
  const struct {
    AreaDirection sun;
    Q panel_share, panel_y, face_share, face_x;
  } cases[] = {{{1, -1, 0}, Q(4, 5), Q(18), Q(3, 5), Q(2)},
               {{15, -26, 0}, Q(37, 60), Q(119, 6), Q(29, 52), Q(115, 52)},
               {{4, -11, 0}, Q(29, 80), Q(179, 8), Q(59, 110), Q(51, 22)}};
  for (const auto& c : cases) {
    for (const AreaCentroid centroid : {AreaCentroid::across, AreaCentroid::lit}) {
      AreaOptions options = by_faces(scene);
      options.centroid = centroid;
      const auto areas = areas_in_direction(scene, c.sun, options);
      EXPECT_EQ(areas[panel].lit, nearest(200 * c.panel_share));
      EXPECT_EQ(areas[face].lit, nearest(100 * c.face_share));
      ASSERT_TRUE(areas[panel].centroid && areas[face].centroid);
      EXPECT_EQ(*areas[panel].centroid, (std::array{0.0, nearest(c.panel_y), 0.0}));
      EXPECT_EQ(*areas[face].centroid, (std::array{nearest(c.face_x), -5.0, 0.0}));
    }
  }
}

/// A body shows to each direction what its six faces show, all of it.
TEST(Areas, OfAConvexBodyAreItsFrontFaces) {
  Scene box = satellite();
  box.meshes[0].triangles = std::vector<CornerIndices>(box.meshes[0].triangles.begin(),
                                                       box.meshes[0].triangles.begin() + 12);
  AreaOptions all;
  all.groups.assign(12, 0);
  all.group_count = 1;
  for (const AreaDirection& d : {AreaDirection{2, -1, 2}, AreaDirection{1, 4, 8},
                                 AreaDirection{-6, 2, 3}, AreaDirection{0, 0, 7}}) {
    const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);  // whole
    const double sum = std::abs(d[0]) + std::abs(d[1]) + std::abs(d[2]);
    EXPECT_EQ(areas_in_direction(box, d, all)[0].visible, 100 * sum / length);
    // Backs are all that is left if fronts are culled.
    AreaOptions backs = all;
    backs.cull = Cull::front;
    const LitArea of_backs = areas_in_direction(box, d, backs)[0];
    EXPECT_EQ(of_backs.visible, 100 * sum / length);
    const auto by_triangle = areas_in_direction(box, d, {.cull = Cull::back});
    for (const LitArea& area : by_triangle) {
      EXPECT_EQ(area.lit, area.side == LitSide::front ? 50 : 0);
    }
  }
}

// Exact areas are those of the closed forms; the panel's own area is 200, the face's 100.
TEST(Areas, OfASatelliteBeforeRounding) {
  const Scene scene = satellite();
  AreaOptions options = by_faces(scene);
  options.alone = options.exact = true;
  const auto areas = areas_in_direction(scene, {15, -26, 0}, options);
  const LitArea &panel = areas[6], &face = areas[3], &hidden = areas[2];
  EXPECT_EQ(rational(*panel.exact->visible), Q(37, 60) * 200 * 15);
  EXPECT_EQ(rational(*panel.exact->projected), Q(200 * 15));
  EXPECT_EQ(rational(*face.exact->visible), Q(29, 52) * 100 * 26);
  EXPECT_EQ(panel.fraction, nearest(Q(37, 60)));
  EXPECT_EQ(face.fraction, nearest(Q(29, 52)));
  EXPECT_EQ(panel.projected, nearest_root(Q(200 * 15) * Q(200 * 15) / (15 * 15 + 26 * 26)));
  EXPECT_EQ(hidden.fraction, 0);
  EXPECT_FALSE(areas[4].fraction);  // its top is seen edge on
  EXPECT_EQ(areas[4].projected, 0);
  EXPECT_FALSE(areas_in_direction(scene, {15, -26, 0}, by_faces(scene))[6].projected);
}

/// A group's projected area is what is visible of it in a scene without the other triangles.
TEST(Areas, AloneAreThoseOfASceneWithoutTheRest) {
  std::mt19937_64 random(12);
  checks::CaseMaker maker(31, checks::Kind::few_bits);
  for (int i = 0; i < 40 && !HasFailure(); ++i) {
    SCOPED_TRACE(i);
    const Case c = maker.make();
    const TriangleSource source(c.scene);
    const auto count = static_cast<std::uint32_t>(source.count());
    std::vector<MeshPoint> v;
    std::vector<CornerIndices> t;
    AreaOptions two, one;
    two.group_count = 2;
    two.alone = two.exact = true;
    one.group_count = 1;
    one.exact = true;
    for (std::uint32_t number = 0; number < count; ++number) {
      two.groups.push_back(number % 2);
      if (number % 2 != 0) continue;
      const auto n = static_cast<std::uint32_t>(v.size());
      const auto corners = source.triangle(number);
      v.insert(v.end(), corners.corners.begin(), corners.corners.end());
      t.push_back({n, n + 1, n + 2});
      one.groups.push_back(0);
    }
    if (c.scene.objects.size() != 1 || !c.scene.objects[0].placed_as_is) continue;
    const Scene half = checks::scene_of(v, t);
    const AreaDirection d = direction_of(random);
    for (const Cull cull : {Cull::none, Cull::back}) {
      two.cull = one.cull = cull;
      const LitArea found = areas_in_direction(c.scene, d, two)[0];
      const LitArea expected = areas_in_direction(half, d, one)[0];
      EXPECT_EQ(found.projected, expected.visible);
      EXPECT_EQ(*found.exact->projected, *expected.exact->visible);
      const bool is_none = expected.exact->visible->sign() == Sign::zero;
      ASSERT_EQ(found.fraction.has_value(), !is_none);
      if (is_none) continue;
      EXPECT_EQ(*found.fraction,
                nearest(rational(*found.exact->visible) / rational(*found.exact->projected)));
      const LitArea in_image = areas_from_camera(c.scene, c.camera, two)[0];
      EXPECT_EQ(in_image.projected, areas_from_camera(half, c.camera, one)[0].visible);
    }
  }
}

TEST(Areas, FromAPointAreSharesBeforeRounding) {
  const Scene scene = satellite();
  const auto areas = areas_from_point(scene, {40, 0, 0}, {.exact = true});
  EXPECT_EQ(rational(*areas[0].exact->visible), 1);
  EXPECT_EQ(rational(*areas[0].exact->projected), 1);
  EXPECT_EQ(rational(*areas[2].exact->visible), 0);
  AreaOptions groups = by_faces(scene);
  groups.alone = groups.exact = true;
  const LitArea group = areas_from_point(scene, {40, 0, 0}, groups)[0];
  EXPECT_FALSE(group.exact->visible || group.exact->projected || group.projected);
}

/// A ring of many triangles around the axes: all coordinates of its centre are exactly 0, and many
/// normals have different lengths. So no enclosure decides how they round.
TEST(Areas, OfSymmetricGroupsHaveCentresOfZero) {
  std::vector<MeshPoint> v;
  std::vector<CornerIndices> t;
  constexpr int count = 1000;
  for (int k = 0; k < count; ++k) {
    const double x = k + 1, height = 1 + k % 7;
    for (const double sign : {1.0, -1.0}) {
      const auto n = static_cast<std::uint32_t>(v.size());
      v.insert(v.end(),
               {{sign * x, sign, height}, {sign * (x + 0.5), 0, 0}, {sign * x, -sign, -height}});
      t.push_back({n, n + 1, n + 2});
    }
  }
  const Scene ring = checks::scene_of(v, t);
  AreaOptions all;
  all.groups.assign(t.size(), 0);
  all.group_count = 1;
  for (const AreaCentroid centroid : {AreaCentroid::across, AreaCentroid::lit}) {
    all.centroid = centroid;
    const LitArea area = areas_in_direction(ring, {0, 0, 1}, all)[0];
    ASSERT_TRUE(area.centroid);
    EXPECT_EQ((*area.centroid)[0], 0);
    EXPECT_EQ((*area.centroid)[1], 0);
  }
}

/// Whatever the length of the direction.
TEST(Areas, DependOnTheDirectionOnly) {
  std::mt19937_64 random(3);
  checks::CaseMaker maker(5, checks::Kind::few_bits);
  for (int i = 0; i < 20; ++i) {
    const Case c = maker.make();
    const AreaDirection d = direction_of(random);
    const auto once = areas_in_direction(c.scene, d);
    const auto thrice = areas_in_direction(c.scene, {3 * d[0], 3 * d[1], 3 * d[2]});
    const auto scaled =
        areas_in_direction(c.scene, {0x1p600 * d[0], 0x1p600 * d[1], 0x1p600 * d[2]});
    for (std::size_t t = 0; t < once.size(); ++t) {
      if (std::abs(d[0]) == std::floor(std::abs(d[0])) && d[1] == std::floor(d[1]) &&
          d[2] == std::floor(d[2])) {
        EXPECT_EQ(once[t].visible, thrice[t].visible);
        EXPECT_EQ(once[t].centroid, thrice[t].centroid);
      }
      EXPECT_EQ(once[t].visible, scaled[t].visible);
      EXPECT_EQ(once[t].lit, scaled[t].lit);
    }
  }
}

/// The shares that six cameras see are those that pairs of triangles leave.
TEST(Areas, FromACameraAreThoseOfPairs) {
  for (const checks::Family family :
       {checks::Family::slivers, checks::Family::ties, checks::Family::around_the_eye,
        checks::Family::range_ends, checks::Family::placements}) {
    SCOPED_TRACE(name_of(family));
    checks::for_each_adversary(30, [&](std::uint64_t seed) {
      const Case c = checks::adversarial_case(family, seed);
      const VisibleAreas expected = checks::rounded_pairwise_areas(c.scene, c.camera);
      const auto found = areas_from_camera(c.scene, c.camera, {.threads = 1});
      AreaOptions by_object;
      const TriangleSource source(c.scene);
      for (std::uint32_t t = 0; t < found.size(); ++t) {
        by_object.groups.push_back(source.origin(t).object);
      }
      by_object.group_count = static_cast<std::uint32_t>(c.scene.objects.size());
      for (std::size_t t = 0; t < found.size(); ++t) {
        EXPECT_EQ(found[t].visible, expected.triangles[t].visible);
        EXPECT_EQ(found[t].projected, expected.triangles[t].unoccluded);
        EXPECT_EQ(found[t].fraction, expected.triangles[t].ratio);
      }
      Q background = Q(c.camera.width) * c.camera.height;
      for (const LitArea& area : areas_from_camera(c.scene, c.camera, {.exact = true})) {
        background -= rational(*area.exact->visible);
      }
      EXPECT_EQ(background_from_camera(c.scene, c.camera), nearest(background));
      by_object.alone = true;
      const auto objects = areas_from_camera(c.scene, c.camera, by_object);
      for (std::size_t object = 0; object < objects.size(); ++object) {
        EXPECT_EQ(objects[object].visible, expected.objects[object].visible);
        EXPECT_EQ(objects[object].projected, expected.objects[object].unoccluded);
        EXPECT_EQ(objects[object].fraction, expected.objects[object].ratio);
      }
    });
  }
}

/// Also where the pose or the projection mirrors the image: the side is one of the surface.
TEST(Areas, FromAMirroringCameraAreOnTheSameSide) {
  const Scene scene =
      checks::scene_of({{-1, -1, 2}, {1, -1, 2}, {1, 1, 2}, {-1, 1, 2}}, {{0, 2, 1}, {0, 2, 3}});
  for (const ProjectionModel model :
       {ProjectionModel::perspective, ProjectionModel::orthographic}) {
    for (const bool projection_mirrors : {false, true}) {
      for (const bool pose_mirrors : {false, true}) {
        SCOPED_TRACE(::testing::Message() << projection_mirrors << pose_mirrors);
        Camera camera;
        camera.width = camera.height = 8;
        camera.projection.model = model;
        camera.projection.fx = 2;
        camera.projection.fy = projection_mirrors ? -2 : 2;
        camera.projection.cx = camera.projection.cy = 4;
        camera.world_to_camera = {
            {{pose_mirrors ? -1.0 : 1.0, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
        const auto areas = areas_from_camera(scene, camera);
        EXPECT_EQ(areas[0].side, LitSide::front);
        EXPECT_EQ(areas[1].side, LitSide::back);
        EXPECT_EQ(areas[0].fraction, 1);
        EXPECT_EQ(areas[1].fraction, 1);
      }
    }
  }
}

// A wall z = 2 with |x|, |y| ≤ 4 behind a square z = 1 with |x|, |y| ≤ ½, seen from the origin: the
// square hides |x|, |y| ≤ 1 of it.
TEST(Areas, FromAPointAreOnTheSurface) {
  const Scene scene = checks::scene_of({{-4, -4, 2},
                                        {4, -4, 2},
                                        {4, 4, 2},
                                        {-4, 4, 2},
                                        {-0.5, -0.5, 1},
                                        {0.5, -0.5, 1},
                                        {0.5, 0.5, 1},
                                        {-0.5, 0.5, 1}},
                                       {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}});
  const auto areas = areas_from_point(scene, {0, 0, 0});
  for (const std::size_t t : {0, 1}) {
    EXPECT_EQ(areas[t].side, LitSide::back);
    EXPECT_EQ(areas[t].fraction, 60 / 64.0);
    EXPECT_EQ(areas[t].lit, 30);
    EXPECT_FALSE(areas[t].visible);
    EXPECT_FALSE(areas[t].projected);
    // ∫x over half the square: ±32/3·4/… less that of the hidden triangle, which is 1/64 as large.
    const double sign = t == 0 ? 1 : -1;
    const double centre = (32 * (4 / 3.0) - 2 * (1 / 3.0)) / 30;
    EXPECT_NEAR((*areas[t].centroid)[0], sign * centre, 1e-15);
    EXPECT_NEAR((*areas[t].centroid)[1], -sign * centre, 1e-15);
    EXPECT_EQ((*areas[t].centroid)[2], 2);
  }
  EXPECT_EQ(areas[2].fraction, 1);
  EXPECT_EQ(areas[3].lit, 0.5);
  AreaOptions by_two = by_faces(scene);
  const auto groups = areas_from_point(scene, {0, 0, 0}, by_two);
  EXPECT_EQ(groups[0].lit, 60);
  EXPECT_EQ(*groups[0].centroid, (std::array{0.0, 0.0, 2.0}));
}

/// Whichever way the axes go: seen from inside, a cube shows all of its inner side.
TEST(Areas, FromInsideAllIsSeen) {
  Scene box = satellite();
  box.meshes[0].triangles = std::vector<CornerIndices>(box.meshes[0].triangles.begin(),
                                                       box.meshes[0].triangles.begin() + 12);
  for (const LitArea& area : areas_from_point(box, {1, -2, 0.3})) {
    EXPECT_EQ(area.side, LitSide::back);
    EXPECT_EQ(area.fraction, 1);
    EXPECT_EQ(area.lit, 50);
  }
  for (const LitArea& area : areas_from_point(box, {1, -2, 0.3}, {.cull = Cull::back})) {
    EXPECT_EQ(area.lit, 0);
  }
}

/// Of triangles that reach behind the cameras of a point, seen from either side.
TEST(Areas, FromAPointAreTheSameFromBothSides) {
  const std::vector<MeshPoint> wall{{-4, -4, 2}, {4, -4, 2}, {4, 4, 2}, {-4, 4, 2}};
  const Scene backs = checks::scene_of(wall, {{0, 1, 2}, {0, 2, 3}}),
              fronts = checks::scene_of(wall, {{0, 2, 1}, {0, 3, 2}});
  AreaOptions all;
  all.groups = {0, 0};
  all.group_count = 1;
  for (const AreaPoint& point : {AreaPoint{0, 0, 0}, AreaPoint{3, -1, 1.75}}) {
    EXPECT_EQ(areas_from_point(fronts, point, all)[0].lit, 64);
    EXPECT_EQ(areas_from_point(backs, point, all)[0].lit, 64);
    const auto seen = areas_from_point(fronts, point), turned = areas_from_point(backs, point);
    for (const std::size_t t : {0, 1}) {
      EXPECT_EQ(seen[t].side, LitSide::front);
      EXPECT_EQ(turned[t].side, LitSide::back);
      EXPECT_EQ(seen[t].fraction, 1);
      EXPECT_EQ(turned[t].fraction, 1);
      EXPECT_EQ(seen[t].centroid, turned[t].centroid);
    }
  }
}

TEST(Areas, RefuseWhatIsNoLight) {
  const Scene scene = satellite();
  EXPECT_THROW(areas_in_direction(scene, {0, 0, 0}), UsageError);
  EXPECT_THROW(areas_in_direction(scene, {1, NAN, 0}), UsageError);
  EXPECT_THROW(areas_in_direction(scene, {INFINITY, 0, 0}), UsageError);
  Scene large = scene;
  for (MeshPoint& p : large.meshes[0].vertices) p.x *= 0x1p200;
  EXPECT_NO_THROW(areas_in_direction(scene, {1, 0x1p1000, 0x1p-1000}));
  EXPECT_THROW(areas_in_direction(large, {1, 0x1p1000, 0x1p-1000}), UsageError);
  EXPECT_THROW(areas_from_point(scene, {0, 0, -INFINITY}), UsageError);
  AreaOptions wrong;
  wrong.groups = {0, 0};
  EXPECT_THROW(areas_in_direction(scene, {1, 0, 0}, wrong), UsageError);
}

TEST(Areas, OfAnEmptySceneAreNone) {
  EXPECT_TRUE(areas_in_direction(Scene(), {1, 0, 0}).empty());
  AreaOptions of_object;
  of_object.group_count = 1;
  of_object.alone = true;
  const auto areas = areas_in_direction(Scene(), {1, 0, 0}, of_object);
  ASSERT_EQ(areas.size(), 1U);
  EXPECT_EQ(areas[0].visible, 0);
  EXPECT_FALSE(areas[0].fraction);
  EXPECT_TRUE(areas_from_point(Scene(), {1, 0, 0}).empty());
}

}  // namespace
}  // namespace fathom
