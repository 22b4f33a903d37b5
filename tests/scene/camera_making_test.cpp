#include "fathom/camera/camera_making.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fathom/numeric/errors.h"
#include "fathom/numeric/rounding.h"
#include "fathom/scene/framing.h"
#include "tests/scene/scratch_folder.h"

namespace fathom {
namespace {

using testing::HasSubstr;
constexpr double infinity = std::numeric_limits<double>::infinity();

double rounded(const Dyadic& x) {
  return round_to_binary64(Ratio(x));
}

Vector3 camera_point(const Camera& camera, const Vector3& X) {
  const CameraPoint p = to_camera(camera, WorldPoint{X[0], X[1], X[2]});
  return {rounded(p.x), rounded(p.y), rounded(p.z)};
}

std::array<double, 2> pixel(const Camera& camera, const Vector3& X) {
  const auto [U, V, W] = to_image(camera, to_camera(camera, WorldPoint{X[0], X[1], X[2]}));
  return {round_to_binary64(Ratio(U, W)), round_to_binary64(Ratio(V, W))};
}

Scene scene_of(const std::vector<MeshPoint>& vertices) {
  Mesh mesh;
  mesh.vertices = vertices;
  for (std::uint32_t i = 0; i < vertices.size(); ++i) mesh.triangles.push_back({0, i, i});
  mesh.face_count = mesh.triangles.size();
  Scene scene;
  scene.meshes.push_back(mesh);
  scene.objects.emplace_back();
  return scene;
}

/// Whether a point projects into the part of the image that a margin of a twentieth leaves. Exact.
bool inside_margin(const Camera& camera, const MeshPoint& p) {
  const auto [U, V, W] = to_image(camera, to_camera(camera, WorldPoint{p.x, p.y, p.z}));
  const Dyadic w = camera.width, h = camera.height, twenty = 20.0;
  return W.sign() == Sign::positive && twenty * U >= w * W && twenty * U <= Dyadic(19.0) * w * W &&
         twenty * V >= h * W && twenty * V <= Dyadic(19.0) * h * W;
}

void expect_sees_all(const Camera& camera, const std::vector<MeshPoint>& vertices) {
  ASSERT_EQ(find_fault(camera), std::nullopt);
  for (const MeshPoint& p : vertices)
    ASSERT_TRUE(inside_margin(camera, p)) << p.x << " " << p.y << " " << p.z;
}

TEST(LookAt, AlongTheAxesIsExact) {
  // From z = 5 towards the origin: right is +x, down is −y, forward is −z.
  const Camera camera = look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0});
  const std::array<std::array<double, 4>, 3> expected{{{1, 0, 0, 0}, {0, -1, 0, 0}, {0, 0, -1, 5}}};
  EXPECT_EQ(camera.world_to_camera, expected);
  EXPECT_EQ(camera.width, 1280U);
  EXPECT_EQ(camera.height, 720U);
  EXPECT_EQ(camera.cx, 640);
  EXPECT_EQ(camera.cy, 360);
  EXPECT_EQ(camera.fx, camera.fy);
  // 360 / tan 20°.
  EXPECT_NEAR(camera.fx, 989.0918710036640, 1e-12);
}

TEST(LookAt, TargetLandsInTheMiddleAndUpIsUp) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-10, 10);
  for (int i = 0; i < 500; ++i) {
    const Vector3 eye{any(random), any(random), any(random)};
    const Vector3 target{any(random), any(random), any(random)};
    const Vector3 up{any(random), any(random), any(random)};
    const Camera camera = look_at(eye, target, up);
    // R and t have entries within 2⁻⁵³ relative of the exact ones, of at most 1 and 18: a point
    // within 18 of the origin errs by less than 1e-14 in the camera frame.
    const Vector3 origin = camera_point(camera, eye);
    for (const double x : origin) ASSERT_NEAR(x, 0, 1e-14);
    const Vector3 p = camera_point(camera, target);
    const double distance = std::hypot(target[0] - eye[0], target[1] - eye[1], target[2] - eye[2]);
    ASSERT_NEAR(p[0], 0, 2e-14);
    ASSERT_NEAR(p[1], 0, 2e-14);
    ASSERT_NEAR(p[2], distance, 1e-13);
    const Vector3 above =
        camera_point(camera, {target[0] + up[0], target[1] + up[1], target[2] + up[2]});
    ASSERT_NEAR(above[0], 0, 3e-14);
    ASSERT_LT(above[1], 0);
    // A proper rotation: its determinant is 1 but for the rounding of nine entries.
    ASSERT_NEAR(rounded(determinant_of_rotation(camera)), 1, 1e-15 * 4);
  }
}

TEST(LookAt, WorksAtAnyScale) {
  for (const double s : {1e150, 1e-150, 1e300, 0x1p-1060}) {
    const Camera camera = look_at({0, 0, 5 * s}, {0, 0, 0}, {0, s, 0});
    EXPECT_EQ(camera.world_to_camera[1], (std::array<double, 4>{0, -1, 0, 0}));
    EXPECT_EQ(camera.world_to_camera[2], (std::array<double, 4>{0, 0, -1, 5 * s}));
  }
  // 1 ulp beside the line of sight is not along it.
  EXPECT_NO_THROW(look_at({0, 0, 0}, {1, 1, 1}, {1, 1, std::nextafter(1.0, 2.0)}));
}

TEST(LookAt, LensesAreAsDescribed) {
  Lens lens;
  lens.width = 300, lens.height = 200;
  lens.focal = 123.5;
  lens.near = 0.5, lens.far = 9;
  Camera camera = look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, lens);
  EXPECT_EQ(camera.fx, 123.5);
  EXPECT_EQ(camera.cx, 150);
  EXPECT_EQ(camera.near, 0.5);
  EXPECT_EQ(camera.far, 9);
  lens.projection = Projection::orthographic;
  lens.vertical_extent = 4;
  camera = look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, lens);
  EXPECT_EQ(camera.projection, Projection::orthographic);
  // 4 units span the height: y = 2 is the upper edge, x = 3 the right one.
  EXPECT_EQ(pixel(camera, {3, 2, 1}), (std::array<double, 2>{300, 0}));
}

TEST(LookAt, RefusesWhatCannotBe) {
  const auto refused = [](const Vector3& eye, const Vector3& target, const Vector3& up,
                          const Lens& lens = {}) {
    return message_of<UsageError>([&] { look_at(eye, target, up, lens); });
  };
  EXPECT_THAT(refused({1, 2, 3}, {1, 2, 3}, {0, 1, 0}), HasSubstr("same point"));
  EXPECT_THAT(refused({0, 0, 0}, {0.1, 0.2, 0.3}, {0.2, 0.4, 0.6}), HasSubstr("line of sight"));
  EXPECT_THAT(refused({0, 0, 0}, {0, 0, 1}, {0, 0, 0}), HasSubstr("zero"));
  EXPECT_THAT(refused({0, 0, infinity}, {0, 0, 1}, {0, 1, 0}), HasSubstr("eye is not finite"));
  EXPECT_THAT(refused({0, 0, 0}, {NAN, 0, 1}, {0, 1, 0}), HasSubstr("target is not finite"));
  const auto with_lens = [&](void (*change)(Lens&)) {
    Lens lens;
    change(lens);
    return refused({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, lens);
  };
  EXPECT_THAT(with_lens([](Lens& l) { l.vertical_fov = 180; }), HasSubstr("field of view"));
  EXPECT_THAT(with_lens([](Lens& l) { l.vertical_fov = 0; }), HasSubstr("field of view"));
  EXPECT_THAT(with_lens([](Lens& l) { l.vertical_fov = NAN; }), HasSubstr("field of view"));
  EXPECT_THAT(with_lens([](Lens& l) { l.focal = -1; }), HasSubstr("focal"));
  EXPECT_THAT(with_lens([](Lens& l) { l.focal = infinity; }), HasSubstr("fx"));
  EXPECT_THAT(with_lens([](Lens& l) { l.width = 0; }), HasSubstr("width"));
  EXPECT_THAT(with_lens([](Lens& l) { l.near = 2, l.far = 1; }), HasSubstr("far"));
  EXPECT_THAT(with_lens([](Lens& l) { l.projection = Projection::orthographic; }),
              HasSubstr("vertical extent"));
}

/// Where the camera is: the world point that it takes to its origin, for an orthonormal R.
Vector3 eye_of(const Camera& camera) {
  Vector3 eye{};
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i)
      eye[k] -= camera.world_to_camera[i][k] * camera.world_to_camera[i][3];
  return eye;
}

void expect_near(const Vector3& a, const Vector3& b) {
  // Sines and cosines within an ulp of numbers below 10.
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], 1e-14);
}

TEST(LookFrom, AzimuthAndElevationAreAsDocumented) {
  const double h = std::sqrt(0.5);
  expect_near(eye_of(look_from({0, 0, UpAxis::y}, {0, 0, 0}, 2)), {0, 0, 2});
  expect_near(eye_of(look_from({90, 0, UpAxis::y}, {0, 0, 0}, 2)), {2, 0, 0});
  expect_near(eye_of(look_from({180, 0, UpAxis::y}, {1, 2, 3}, 2)), {1, 2, 1});
  expect_near(eye_of(look_from({0, 45, UpAxis::y}, {0, 0, 0}, 2)), {0, 2 * h, 2 * h});
  expect_near(eye_of(look_from({45, 0, UpAxis::y}, {0, 0, 0}, 2)), {2 * h, 0, 2 * h});
  expect_near(eye_of(look_from({0, 0, UpAxis::z}, {0, 0, 0}, 2)), {0, -2, 0});
  expect_near(eye_of(look_from({90, 0, UpAxis::z}, {0, 0, 0}, 2)), {2, 0, 0});
  expect_near(eye_of(look_from({0, 45, UpAxis::z}, {0, 0, 0}, 2)), {0, -2 * h, 2 * h});
  expect_near(eye_of(look_from({0, 90, UpAxis::y}, {0, 0, 0}, 2)), {0, 2, 0});
  expect_near(eye_of(look_from({0, -90, UpAxis::z}, {0, 0, 0}, 2)), {0, 0, -2});
}

TEST(LookFrom, RightAngledViewsAreExact) {
  for (const auto up : {UpAxis::y, UpAxis::z})
    for (int azimuth = -720; azimuth <= 720; azimuth += 90)
      for (const double elevation : {-90.0, 0.0, 90.0}) {
        const Camera camera = look_from({static_cast<double>(azimuth), elevation, up}, {}, 1);
        for (const auto& row : camera.world_to_camera)
          for (int k = 0; k < 3; ++k)
            EXPECT_TRUE(row[k] == 0 || std::abs(row[k]) == 1) << azimuth << " " << elevation;
        EXPECT_EQ(determinant_of_rotation(camera), Dyadic(1.0));
      }
}

TEST(LookFrom, AgreesWithLookAt) {
  for (const auto up : {UpAxis::y, UpAxis::z})
    for (double azimuth = -170; azimuth < 190; azimuth += 17)
      for (double elevation = -85; elevation < 90; elevation += 17) {
        const Camera camera = look_from({azimuth, elevation, up}, {1, 2, 3}, 4);
        const Vector3 axis = up == UpAxis::y ? Vector3{0, 1, 0} : Vector3{0, 0, 1};
        const Camera other = look_at(eye_of(camera), {1, 2, 3}, axis);
        for (int i = 0; i < 3; ++i)
          for (int k = 0; k < 4; ++k)
            // The eye above is known to 1e-15·10; the direction to it divides that by 4, and by
            // cos 85° for the horizontal part.
            EXPECT_NEAR(camera.world_to_camera[i][k], other.world_to_camera[i][k], 1e-12);
      }
}

TEST(Orbit, StepsAroundTheCentre) {
  const auto path = orbit({10, 20, UpAxis::z}, 4, Vector3{1, 2, 3}, 5);
  ASSERT_EQ(path.size(), 4U);
  for (int i = 0; i < 4; ++i) {
    const Camera expected = look_from({10 + 90.0 * i, 20, UpAxis::z}, {1, 2, 3}, 5);
    EXPECT_EQ(path[i].world_to_camera, expected.world_to_camera);
  }
  EXPECT_THAT(message_of<UsageError>([] { orbit({}, 0, Vector3{}, 1); }), HasSubstr("from 1 to"));
  EXPECT_THAT(message_of<UsageError>([] { orbit({}, 4000000000U, Vector3{}, 1); }),
              HasSubstr("from 1 to"));
  EXPECT_THAT(message_of<UsageError>([] { orbit({}, 3, Vector3{}, 0); }), HasSubstr("distance"));
}

struct NamedVertices {
  const char* name;
  std::vector<MeshPoint> vertices;
};

std::vector<MeshPoint> cloud(const Vector3& centre, const Vector3& size) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> any(-1, 1);
  std::vector<MeshPoint> points;
  for (int i = 0; i < 50; ++i)
    points.push_back({centre[0] + size[0] * any(random), centre[1] + size[1] * any(random),
                      centre[2] + size[2] * any(random)});
  return points;
}

std::vector<NamedVertices> trouble() {
  const double tiny = 0x1p-1074;
  return {{"a cloud", cloud({}, {1, 2, 3})},
          {"1e150", cloud({1e150, 0, 0}, {1e150, 1e149, 1e150})},
          {"1e300", cloud({}, {1e300, 1e300, 1e300})},
          {"1e-150", cloud({}, {1e-150, 1e-150, 1e-150})},
          {"subnormal", {{0, 0, 0}, {tiny, 3 * tiny, -tiny}}},
          {"subnormal point", {{tiny, -tiny, tiny}}},
          {"flat in x", cloud({}, {0, 1, 1})},
          {"flat in y", cloud({}, {1, 0, 1})},
          {"flat in z", cloud({}, {1, 1, 0})},
          {"a line", cloud({}, {0, 0, 1})},
          {"a point", {{3, -4, 5}}},
          {"the origin", {{0, 0, 0}}},
          {"UTM", cloud({500000, 5400000, 300}, {20, 30, 5})},
          {"a millimetre at UTM", cloud({500000, 5400000, 300}, {1e-3, 1e-3, 1e-3})},
          {"an ulp far away", {{1e20, -1e20, 1e20}, {1e20, -1e20, 1e20 + 16384}}},
          {"a point far away", {{1e200, 1e100, 1}}},
          {"a needle", cloud({}, {1e100, 1, 1e-100})}};
}

TEST(Frame, SeesAllOfEveryScene) {
  for (const auto& [name, vertices] : trouble()) {
    SCOPED_TRACE(name);
    const Scene scene = scene_of(vertices);
    for (const auto projection : {Projection::perspective, Projection::orthographic})
      for (const auto up : {UpAxis::y, UpAxis::z})
        for (const double azimuth : {0.0, 35.0, 90.0, 250.0})
          for (const double elevation : {-90.0, -30.0, 0.0, 25.0, 90.0})
            for (const double fov : {1.0, 40.0, 150.0}) {
              Lens lens;
              lens.projection = projection;
              lens.vertical_fov = fov;
              expect_sees_all(frame_scene(scene, {azimuth, elevation, up}, lens), vertices);
            }
  }
}

TEST(Frame, FillsTheImageButForItsMargin) {
  for (const auto projection : {Projection::perspective, Projection::orthographic}) {
    Lens lens;
    lens.projection = projection;
    lens.width = 300, lens.height = 400;
    const WorldBounds bounds{{-1, -2, -3}, {3, 2, 1}};
    const Camera camera = frame(bounds, {}, lens);
    double reach = 0;
    for (int i = 0; i < 8; ++i) {
      const auto [u, v] = pixel(camera, {(i & 1) != 0 ? 3.0 : -1.0, (i & 2) != 0 ? 2.0 : -2.0,
                                         (i & 4) != 0 ? 1.0 : -3.0});
      reach = std::max({reach, std::abs(u - 150) / 150, std::abs(v - 200) / 200});
    }
    EXPECT_LE(reach, 0.9);
    EXPECT_GT(reach, 0.9 - 1e-9);  // the estimate is 2⁻⁴⁰ too large on purpose
  }
}

TEST(Frame, AnOrbitSeesAllFromEverywhere) {
  for (const auto& [name, vertices] : trouble()) {
    SCOPED_TRACE(name);
    const auto bounds = world_bounds(scene_of(vertices));
    ASSERT_TRUE(bounds);
    const auto path = orbit({0, 20, UpAxis::z}, 7, *bounds);
    ASSERT_EQ(path.size(), 7U);
    for (const Camera& camera : path) expect_sees_all(camera, vertices);
  }
}

TEST(Frame, KeepsAGivenExtent) {
  Lens lens;
  lens.projection = Projection::orthographic;
  lens.vertical_extent = 1;  // less than the scene
  const Camera camera = frame({{-1, -1, -1}, {1, 1, 1}}, {}, lens);
  EXPECT_EQ(camera.fx, 720);
  for (int i = 0; i < 8; ++i)
    EXPECT_GT(camera_point(camera, {(i & 1) != 0 ? 1. : -1., (i & 2) != 0 ? 1. : -1.,
                                    (i & 4) != 0 ? 1. : -1.})[2],
              0);
}

TEST(Frame, RefusesWhatCannotBe) {
  EXPECT_THAT(message_of<InputError>([] { frame_scene(Scene()); }), HasSubstr("no triangle"));
  const double most = std::numeric_limits<double>::max();
  EXPECT_THAT(message_of<InputError>([&] {
                frame({{-most, -most, -most}, {most, most, most}});
              }),
              HasSubstr("no camera with finite numbers"));
  EXPECT_THAT(message_of<UsageError>([&] {
                frame({{0, 0, 0}, {infinity, 1, 1}});
              }),
              HasSubstr("not finite"));
  EXPECT_THAT(message_of<UsageError>([&] {
                frame({{}, {1, 1, 1}}, {0, 91, UpAxis::y});
              }),
              HasSubstr("elevation"));
  EXPECT_THAT(message_of<UsageError>([&] {
                frame({{}, {1, 1, 1}}, {infinity, 1, UpAxis::y});
              }),
              HasSubstr("azimuth"));
}

TEST(WorldBounds, OfMeshesAsTheyAre) {
  Scene scene = scene_of({{1, 2, 3}, {-1, 5, 2}});
  // A vertex that no triangle uses does not count.
  scene.meshes[0].vertices.push_back({100, 100, 100});
  const auto bounds = world_bounds(scene);
  ASSERT_TRUE(bounds);
  EXPECT_EQ(bounds->lower, (Vector3{-1, 2, 2}));
  EXPECT_EQ(bounds->upper, (Vector3{1, 5, 3}));
  EXPECT_EQ(world_bounds(Scene()), std::nullopt);
}

TEST(WorldBounds, OfPlacedMeshesAreTheExactOnesRoundedOutwards) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int round = 0; round < 300; ++round) {
    const double scale = std::pow(10.0, 40 * any(random));
    std::vector<MeshPoint> vertices;
    for (int i = 0; i < 30; ++i)
      vertices.push_back({scale * any(random), scale * std::round(2 * any(random)), any(random)});
    // Neighbours that differ by ulps: floating point takes the wrong one for the extreme.
    if (round % 2 == 0)
      for (MeshPoint& p : vertices)
        p = {vertices[0].x * (1 + 0x1p-52 * std::round(3 * any(random))), vertices[0].y,
             vertices[0].z * (1 + 0x1p-52 * std::round(3 * any(random)))};
    Scene scene = scene_of(vertices);
    Object& object = scene.objects[0];
    object.placed_as_is = false;
    for (auto& row : object.world_from_mesh.rows)
      for (Dyadic& x : row) x = Dyadic(any(random)) * Dyadic(any(random));
    // Near the origin of the world, where what floating point loses is all that is left.
    if (round % 2 == 0)
      for (auto& row : object.world_from_mesh.rows) {
        const MeshPoint& p = vertices[0];
        row[3] = Dyadic(-rounded(row[0] * p.x + row[1] * p.y + row[2] * p.z));
      }
    if (round % 3 == 0) object.world_from_mesh.rows[1] = {0.0, 1e-310, 0.0, 0x1p-1074};
    if (round % 3 == 1) object.world_from_mesh.rows[2][0] = Dyadic(1e300) * Dyadic(1e300);
    Vector3 lower{infinity, infinity, infinity}, upper{-infinity, -infinity, -infinity};
    for (const MeshPoint& p : vertices) {
      const WorldPoint q = object.world_from_mesh(p);
      const Dyadic* X[3] = {&q.x, &q.y, &q.z};
      for (int k = 0; k < 3; ++k) {
        lower[k] = std::min(lower[k], enclose(*X[k]).lower);
        upper[k] = std::max(upper[k], enclose(*X[k]).upper);
      }
    }
    const auto bounds = world_bounds(scene);
    ASSERT_TRUE(bounds);
    ASSERT_EQ(bounds->lower, lower);
    ASSERT_EQ(bounds->upper, upper);
  }
}

}  // namespace
}  // namespace fathom
