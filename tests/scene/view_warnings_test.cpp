#include "fathom/scene/view_warnings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include "fathom/camera/camera_making.h"
#include "fathom/camera/direction_table.h"
#include "fathom/failures/errors.h"
#include "fathom/scene/sight.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using Kind = ViewWarning::Kind;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

/// A box, its triangles counter-clockwise seen from outside.
Mesh box(const Vector3& lower, const Vector3& upper) {
  Mesh mesh;
  for (unsigned i = 0; i < 8; ++i) {
    const auto end = [&](unsigned k) { return ((i >> k) & 1U) != 0 ? upper[k] : lower[k]; };
    mesh.vertices.push_back({end(0), end(1), end(2)});
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  mesh.face_count = mesh.triangles.size();
  return mesh;
}

Mesh cube(double half, const Vector3& c = {}) {
  return box({c[0] - half, c[1] - half, c[2] - half}, {c[0] + half, c[1] + half, c[2] + half});
}

Mesh turned_inside_out(Mesh mesh) {
  for (auto& [a, b, c] : mesh.triangles) std::swap(b, c);
  return mesh;
}

Scene scene_of(Mesh mesh) {
  Scene scene;
  scene.meshes.push_back(std::move(mesh));
  scene.objects.emplace_back();
  scene.objects.back().name = "cube";
  return scene;
}

const LensChoice lens{.width = 640, .height = 480};

Camera looking(const Vector3& eye, const Vector3& target = {}) {
  return look_at(eye, target, {0, 1, 0}, lens);
}

std::uint64_t all_of(const Camera& camera) {
  return std::uint64_t{camera.width} * camera.height;
}

std::vector<Kind> kinds(const std::vector<ViewWarning>& warnings) {
  std::vector<Kind> list;
  for (const ViewWarning& warning : warnings) list.push_back(warning.kind);
  return list;
}

/// The only warning of that kind.
std::string text_of(const std::vector<ViewWarning>& warnings, Kind kind) {
  EXPECT_EQ(kinds(warnings), std::vector{kind});
  const std::string text = warnings.empty() ? "" : warnings[0].text;
  EXPECT_EQ(text.find('\n'), std::string::npos);
  return text;
}

/// R with every entry changed by `change`.
template <class Change>
Camera changed(Camera camera, const Change& change) {
  for (auto& row : camera.world_to_camera)
    for (double& entry : row) entry = change(entry);
  return camera;
}

Camera multiplied(const Camera& camera, double factor) {
  return changed(camera, [&](double x) { return factor * x; });
}

Camera with_pose(Camera camera, const std::array<std::array<double, 4>, 3>& pose) {
  camera.world_to_camera = pose;
  return camera;
}

Camera with_opengl_axes(Camera camera) {
  for (std::size_t i : {1, 2})
    for (double& entry : camera.world_to_camera[i]) entry = -entry;
  return camera;
}

TEST(CameraWarnings, ARotationGetsNone) {
  for (const Camera& camera : orbit({.azimuth = 3, .elevation = 17}, 200, {0.1, 2, 3}, 7.3, lens)) {
    EXPECT_THAT(warnings_of_camera(camera), IsEmpty());
    const Camera in_binary32 =
        changed(camera, [](double x) { return double{static_cast<float>(x)}; });
    EXPECT_THAT(warnings_of_camera(in_binary32), IsEmpty());
    const Camera six_decimals = changed(camera, [](double x) { return std::round(x * 1e6) / 1e6; });
    EXPECT_THAT(warnings_of_camera(six_decimals), IsEmpty());
  }
}

TEST(CameraWarnings, NameAScaleAMirrorAndWhatIsNeither) {
  const Camera camera = looking({1, 2, 3});
  EXPECT_THAT(text_of(warnings_of_camera(multiplied(camera, 2.5)), Kind::scaled),
              AllOf(HasSubstr("scales by 2.5"), HasSubstr("divide")));
  EXPECT_THAT(text_of(warnings_of_camera(multiplied(camera, 1.001)), Kind::scaled),
              HasSubstr("by 1.001"));
  Camera orthographic = multiplied(camera, 2);
  orthographic.projection.model = ProjectionModel::orthographic;
  EXPECT_THAT(text_of(warnings_of_camera(orthographic), Kind::scaled),
              HasSubstr("multiply fx, fy and skew"));

  Camera mirrored = camera;
  for (double& entry : mirrored.world_to_camera[0]) entry = -entry;
  EXPECT_THAT(text_of(warnings_of_camera(mirrored), Kind::mirrored), HasSubstr("negative"));
  mirrored.projection.fx = -mirrored.projection.fx;  // mirrors it back
  EXPECT_THAT(warnings_of_camera(mirrored), IsEmpty());

  const Camera one_decimal = changed(camera, [](double x) { return std::round(x * 10) / 10; });
  EXPECT_THAT(text_of(warnings_of_camera(one_decimal), Kind::not_a_rotation),
              HasSubstr("no rotation"));
  Camera sheared = camera;
  sheared.world_to_camera[0][1] += 3e-5;
  EXPECT_THAT(text_of(warnings_of_camera(sheared), Kind::not_a_rotation), HasSubstr("e-05"));

  EXPECT_EQ(kinds(warnings_of_camera(multiplied(camera, -2))),
            (std::vector{Kind::mirrored, Kind::scaled}));
}

TEST(CameraWarnings, NumbersOfAnySizeAreJudged) {
  const Camera camera = looking({1, 2, 3});
  for (const char* factor : {"1e+100", "1e+300", "1e-200", "1e-300"}) {
    EXPECT_THAT(text_of(warnings_of_camera(multiplied(camera, std::stod(factor))), Kind::scaled),
                HasSubstr(std::string("scales by ") + factor));
  }
}

TEST(CameraWarnings, NothingIsSaidOfACameraWithAFault) {
  const Camera camera = looking({1, 2, 3});
  for (const double entry :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 0.0})
    EXPECT_THAT(warnings_of_camera(changed(camera, [&](double) { return entry; })), IsEmpty());
}

TEST(CameraWarnings, APrincipalPointFarFromTheMiddle) {
  Camera camera = looking({1, 2, 3});
  for (const double cx : {160.0, 320.0, 480.0}) {
    camera.projection.cx = cx;
    EXPECT_THAT(warnings_of_camera(camera), IsEmpty()) << cx;
  }
  camera.projection.cx = 159;
  EXPECT_THAT(text_of(warnings_of_camera(camera), Kind::principal_point),
              AllOf(HasSubstr("(159, 240)"), HasSubstr("640x480"), HasSubstr("cut out")));
  camera.projection.cx = camera.projection.cy = 0.5;
  EXPECT_THAT(text_of(warnings_of_camera(camera), Kind::principal_point), HasSubstr("fractions"));
  camera.width = 480, camera.height = 1920, camera.projection.cx = 960, camera.projection.cy = 240;
  EXPECT_THAT(text_of(warnings_of_camera(camera), Kind::principal_point), HasSubstr("swapped"));
  camera.width = 480, camera.height = 640, camera.projection.cx = 322, camera.projection.cy = 237;
  EXPECT_THAT(text_of(warnings_of_camera(camera), Kind::principal_point),
              AllOf(HasSubstr("(322, 237)"), HasSubstr("480x640"), HasSubstr("swapped")));
  camera.projection.cx = 300;  // some part of a larger image
  EXPECT_THAT(warnings_of_camera(camera), IsEmpty());
  camera.width = 639, camera.height = 640, camera.projection.cx = 320, camera.projection.cy = 319.5;
  EXPECT_THAT(warnings_of_camera(camera), IsEmpty());
  camera.projection.model = ProjectionModel::orthographic;
  camera.projection.cx = 1000;
  EXPECT_THAT(warnings_of_camera(camera), IsEmpty());
}

TEST(CameraWarnings, PixelsWithoutARayAndWhy) {
  Camera camera = looking({1, 2, 3});
  const auto told = [&] { return text_of(warnings_of_camera(camera), Kind::without_ray); };
  Lens& bent = camera.projection.lens.emplace(Lens{LensModel::simple_radial, {-0.25}});
  camera.projection.fx = camera.projection.fy = 500;
  // The fold shows at 500·√(4/3)·2/3 = 384.9 pixels: the corners are 400 away.
  EXPECT_THAT(told(), AllOf(StartsWith("0.3 % of the pixels have no ray"),
                            HasSubstr("where the lens SIMPLE_RADIAL folds back")));
  bent.max_radius = 0.5;
  EXPECT_THAT(told(), HasSubstr("they lie beyond max_radius 0.5"));
  bent = {LensModel::division, {3}};
  EXPECT_THAT(told(), HasSubstr("they lie beyond the end of the lens DIVISION"));
  bent = {LensModel::simple_radial, {0.25}};
  EXPECT_THAT(warnings_of_camera(camera), IsEmpty());
  camera = {};
  camera.width = 2;
  camera.height = 1;
  camera.projection.lens.emplace(Lens{LensModel::table}).directions =
      std::make_shared<const DirectionTable>(2, 1, std::vector<double>{0, 0, 0, 0, 0, 1});
  EXPECT_THAT(told(), AllOf(StartsWith("50.0 % of the pixels"),
                            HasSubstr("the table has no direction for them")));
}

TEST(ViewWarnings, AMapThatShowsAPartOfTheSceneIsNotLookedInto) {
  // Not even a scene with a fault is.
  Scene scene = scene_of(cube(1));
  scene.meshes[0].triangles[0] = {0, 1, 99};
  const Camera camera = looking({0, 0, 10});
  EXPECT_THAT(warnings_of_view(scene, camera, most_pixels_of_a_speck + 1), IsEmpty());
  EXPECT_THAT(warnings_of_view(scene, camera, all_of(camera) - 1), IsEmpty());
  for (const std::uint64_t shown : {std::uint64_t{0}, std::uint64_t{1}, all_of(camera)}) {
    EXPECT_THAT(message_of<InputError>([&] { (void)warnings_of_view(scene, camera, shown); }),
                HasSubstr("triangle 0: a corner is beyond"));
  }
  scene.meshes[0].triangles.clear();
  Camera faulty = camera;
  faulty.projection.fx = 0;
  EXPECT_THROW((void)warnings_of_view(scene, faulty, 0), InputError);
}

TEST(ViewWarnings, BehindTheCameraSaysWhereTheSceneLies) {
  // The eye at (0, 0, 10) looks along +z: the cube lies 10 behind, and 1 to the left of it (its
  // right is −x), and so does nothing that another reading of the matrix would show.
  Camera camera = looking({0, 0, 10}, {0, 0, 11});
  camera.projection.fx = camera.projection.fy = 60;
  const std::string text =
      text_of(warnings_of_view(scene_of(cube(0.5, {1, 0, 0})), camera, 0), Kind::behind);
  EXPECT_THAT(text, AllOf(HasSubstr("(-1, 0, -10)"), HasSubstr("x right, y down, z forward")));
}

TEST(ViewWarnings, TellWhichReadingOfTheMatrixWouldShowTheScene) {
  const Scene scene = scene_of(cube(0.5, {0.2, 0.1, 0}));
  int told = 0;
  std::vector<Camera> cameras;
  for (const double elevation : {5.0, 30.0})
    for (const Camera& camera :
         orbit({.azimuth = 15, .elevation = elevation}, 24, {0.2, 0.1, 0}, 6, lens))
      cameras.push_back(camera);
  for (const Camera& camera : cameras) {
    EXPECT_THAT(text_of(warnings_of_view(scene, with_opengl_axes(camera), 0), Kind::behind),
                AllOf(HasSubstr("OpenGL's axes"), HasSubstr("second and third rows"),
                      Not(HasSubstr("camera-to-world"))));
    for (const bool opengl : {false, true}) {
      const Camera meant = opengl ? with_opengl_axes(camera) : camera;
      const auto warnings =
          warnings_of_view(scene, with_pose(camera, camera_to_world(meant.world_to_camera)), 0);
      ASSERT_LE(warnings.size(), 1U);
      // From some sides even the wrong matrix shows the scene, and no map is empty.
      if (warnings.empty()) continue;
      // From some it would be seen with OpenGL's axes, too, but not in the middle.
      ++told;
      EXPECT_THAT(warnings[0].text, HasSubstr(opengl ? "looks like OpenGL's camera-to-world matrix"
                                                     : "looks like a camera-to-world matrix"));
    }
  }
  EXPECT_GE(told, 80);
}

TEST(ViewWarnings, LookingPastTheSceneSaysWhereItLies) {
  const Scene scene = scene_of(cube(0.5));
  const std::pair<Vector3, const char*> sides[] = {{{9, 0, 0}, "to the left of the image"},
                                                   {{-9, 0, 0}, "to the right of the image"},
                                                   {{0, -9, 0}, "above the image"},
                                                   {{0, 9, 0}, "below the image"}};
  for (const auto& [target, side] : sides) {
    Camera camera = looking({0.2, 0.3, 10}, target);
    camera.projection.fx = camera.projection.fy =
        5000;  // too narrow for any other reading of the matrix
    EXPECT_THAT(text_of(warnings_of_view(scene, camera, 0), Kind::outside),
                AllOf(HasSubstr(side), HasSubstr("check world_to_camera")));
  }
}

TEST(ViewWarnings, OutOfRangeSaysBothRanges) {
  Camera camera = looking({0, 0, 10});
  camera.near = 20, camera.far = 30;
  EXPECT_THAT(text_of(warnings_of_view(scene_of(cube(1)), camera, 0), Kind::out_of_range),
              AllOf(HasSubstr("from 9 to 11"), HasSubstr("near 20 and far 30")));
}

TEST(ViewWarnings, AnEmptyMapOfASceneInViewIsNobodysFault) {
  const Camera camera = looking({0, 0, 10});
  // Culled, or seen edge on.
  EXPECT_THAT(warnings_of_view(scene_of(cube(1)), camera, 0), IsEmpty());
  EXPECT_THAT(warnings_of_view(scene_of(cube(1)), looking({1e-9, 0, 10}), 0), IsEmpty());
  // The eye at the world's origin: the scene looks the same in every unit.
  EXPECT_THAT(warnings_of_view(scene_of(cube(1, {0, 0, 5})), looking({}, {0, 0, 1}), 0), IsEmpty());
  EXPECT_THAT(text_of(warnings_of_view(scene_of(cube(1e-4)), camera, 0), Kind::too_small),
              HasSubstr("pixels"));
  EXPECT_THAT(warnings_of_view(scene_of({}), camera, 0), IsEmpty());
  EXPECT_THAT(warnings_of_view({}, camera, 0), IsEmpty());
}

TEST(ViewWarnings, APartInFrontAndNothingShown) {
  // Corners on all sides, in front and behind.
  EXPECT_THAT(
      text_of(warnings_of_view(scene_of(cube(3)), looking({0, 0, 0.5}), 0), Kind::nothing_shown),
      HasSubstr("(0, 0, 0.5)"));
}

TEST(ViewWarnings, AnEyeInsideAClosedObject) {
  const Camera camera = looking({0.1, 0.2, 0.3}, {1, 1, 5});
  const auto of = [&](Mesh mesh) {
    return warnings_of_view(scene_of(std::move(mesh)), camera, all_of(camera));
  };
  EXPECT_THAT(text_of(of(cube(1)), Kind::inside_solid), HasSubstr("inside object cube"));
  // A room.
  EXPECT_THAT(of(turned_inside_out(cube(1))), IsEmpty());
  // Outside, in front of a wall that fills the image.
  EXPECT_THAT(of(cube(1, {0, 0, 3})), IsEmpty());
  // A house: its walls are a solid with a hollow.
  Mesh house = cube(2);
  const Mesh hollow = turned_inside_out(cube(1));
  for (const MeshPoint& p : hollow.vertices) house.vertices.push_back(p);
  for (const auto& [a, b, c] : hollow.triangles) house.triangles.push_back({a + 8, b + 8, c + 8});
  EXPECT_THAT(of(house), IsEmpty());
  // Open: a wall is missing.
  Mesh open = cube(1);
  std::vector<CornerIndices>& kept = open.triangles.own();
  kept.erase(kept.begin(), kept.begin() + 2);
  EXPECT_THAT(of(open), IsEmpty());
  // Rays of an orthographic camera start nowhere.
  Camera orthographic = camera;
  orthographic.projection.model = ProjectionModel::orthographic;
  EXPECT_THAT(warnings_of_view(scene_of(cube(1)), orthographic, all_of(camera)), IsEmpty());
}

TEST(ViewWarnings, APlacedObjectAroundTheEye) {
  Scene scene = scene_of(cube(1));
  Object& object = scene.objects[0];
  object.placed_as_is = false;
  object.world_from_mesh.rows = {
      {{0.0, -3.0, 0.0, 10.0}, {3.0, 0.0, 0.0, 20.0}, {0.0, 0.0, 3.0, 30.0}}};
  const auto from = [&](const Vector3& eye) {
    const Camera camera = looking(eye, {0, 0, 100});
    return kinds(warnings_of_view(scene, camera, all_of(camera)));
  };
  EXPECT_THAT(from({8, 21, 32}), ElementsAre(Kind::inside_solid));
  EXPECT_THAT(from({6.9, 21, 32}), IsEmpty());
  object.world_from_mesh.rows[2][2] = 0.0;  // flat
  EXPECT_THAT(from({8, 21, 30}), IsEmpty());
}

TEST(ViewWarnings, MillimetresBesideMetres) {
  // A mesh in millimetres, 200 of them wide, seen by a camera that is half a metre away.
  const Camera metres = looking({0.1, 0.2, 0.4});
  EXPECT_THAT(text_of(warnings_of_view(scene_of(cube(100)), metres, all_of(metres)), Kind::units),
              AllOf(HasSubstr("as if in millimetres"), HasSubstr("multiply the translation")));
  // A mesh in metres, and a camera that is half a metre away in millimetres.
  const Camera millimetres = looking({100, 200, 400});
  for (std::uint64_t shown = 0; shown <= most_pixels_of_a_speck; ++shown) {
    EXPECT_THAT(text_of(warnings_of_view(scene_of(cube(0.1)), millimetres, shown), Kind::units),
                AllOf(HasSubstr("as if in metres"), HasSubstr("divide the translation")));
  }
  // A town that a camera stands in: open below, and no solid around the eye.
  Mesh ground = cube(500);
  ground.triangles = {{2, 6, 3}, {3, 6, 7}};
  EXPECT_THAT(warnings_of_view(scene_of(ground), metres, all_of(metres)), IsEmpty());
  // A far thing that is a speck, but no thousandth of a picture.
  EXPECT_THAT(warnings_of_view(scene_of(cube(0.5)), looking({0, 0, 2000}), 2),
              ElementsAre(::testing::Field(&ViewWarning::kind, Kind::units)));
  EXPECT_THAT(
      warnings_of_view(scene_of(cube(0.5, {90, 0, 0})), looking({90, 0, 2000}, {90, 0, 0}), 2),
      IsEmpty());
}

TEST(ViewWarnings, NumbersNearTheLargestAreNoTrouble) {
  for (const double half : {1e300, 1e154, 1e-300}) {
    const Scene scene = scene_of(cube(half));
    const Camera camera = looking({0.1, 0.2, 0.3});
    for (const std::uint64_t shown : {std::uint64_t{0}, std::uint64_t{1}, all_of(camera)})
      EXPECT_LE(warnings_of_view(scene, camera, shown).size(), 1U) << half;
  }
  Scene scene = scene_of(cube(1));
  scene.objects[0].placed_as_is = false;
  scene.objects[0].world_from_mesh.rows[0][0] = Dyadic(1.0).scaled(2000);
  const Camera camera = looking({0.1, 0.2, 0.3});
  EXPECT_LE(warnings_of_view(scene, camera, all_of(camera)).size(), 1U);
}

TEST(ViewWarnings, APathIsToldOfOnce) {
  const ViewWarning behind{Kind::behind, "it is behind"}, scaled{Kind::scaled, "scales by 2"};
  const std::vector<std::vector<ViewWarning>> one{{scaled, behind}};
  EXPECT_THAT(told_once(one), ElementsAre("scales by 2", "it is behind"));
  const std::vector<std::vector<ViewWarning>> path{
      {}, {behind}, {scaled, {Kind::behind, "elsewhere"}}, {}};
  EXPECT_THAT(told_once(path), ElementsAre("camera 1: it is behind (likewise 2 of 4 cameras)",
                                           "camera 2: scales by 2"));
  EXPECT_THAT(told_once({}), IsEmpty());
}

TEST(WindingNumber, OfABoxAsSeenFromAnywhere) {
  const Mesh mesh = cube(1);
  // Inside; outside; rays along x through edges and corners.
  const std::array<double, 3> inside[] = {{0, 0, 0}, {0.5, 0.25, -0.75}, {-0.9, 0.9, 0.9}};
  for (const auto& eye : inside) {
    EXPECT_NEAR(scene::winding_number(mesh, eye), 1, 1e-12);
    EXPECT_NEAR(scene::winding_number(turned_inside_out(mesh), eye), -1, 1e-12);
    EXPECT_EQ(scene::crossings_along_x(mesh, eye), 1);
    EXPECT_EQ(scene::crossings_along_x(turned_inside_out(mesh), eye), -1);
  }
  const std::array<double, 3> outside[] = {{-2, 0, 0},   {2, 0, 0}, {-2, 1, 1},
                                           {-2, -1, -1}, {0, 3, 0}, {-2, 1, 0}};
  for (const auto& eye : outside) {
    EXPECT_NEAR(scene::winding_number(mesh, eye), 0, 1e-12);
    EXPECT_EQ(scene::crossings_along_x(mesh, eye), 0);
  }
  // Half of a closed surface around the eye.
  Mesh half = mesh;
  half.triangles.resize(6);
  EXPECT_NEAR(scene::winding_number(half, {0, 0, 0}), 0.5, 1e-12);
}

/// A closed surface of slanted triangles, from points in and around it.
TEST(WindingNumber, IsThatOfOneRayWhereTheSurfaceIsClosed) {
  Mesh mesh;
  mesh.vertices = {{1.1, 0.3, -0.2}, {-0.9, 0.2, 0.4}, {0.2, 1.3, 0.1},
                   {-0.3, -1, 0.2},  {0.1, -0.2, 1.2}, {-0.2, 0.1, -0.8}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                    {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> coordinate(-1.2, 1.2);
  int inside = 0;
  for (int i = 0; i < 2000; ++i) {
    const std::array<double, 3> eye{coordinate(random), coordinate(random), coordinate(random)};
    const double winding = scene::winding_number(mesh, eye);
    EXPECT_NEAR(winding, std::round(winding), 1e-9);
    EXPECT_EQ(scene::crossings_along_x(mesh, eye), std::lround(winding));
    inside += winding > 0.5;
  }
  EXPECT_GT(inside, 100);
}

}  // namespace
}  // namespace fathom
