// Blender's cameras see what Cycles has them see (`blender/blender`: intern/cycles): the functions
// …_to_direction() of kernel/camera, blender_camera_matrix(), blender_camera_viewplane() and
// blender_camera_sync(), and, for the ranges of panoramas, Camera::update().
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "fathom/camera/camera_import_internal.h"
#include "fathom/failures/errors.h"
#include "tests/camera/imported_rays.h"
#include "tests/camera/judged.h"
#include "tests/camera/seen_points.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using namespace camera;
using namespace test;
using nlohmann::json;
using std::numbers::pi;
using ::testing::HasSubstr;

/// A camera as the script writes it, with some keys changed.
json entry_of(const json& changes) {
  json entry = json::parse(R"({"name": "Camera", "type": "PERSP", "width": 12, "height": 8,
    "pixel_aspect": [1, 1],
    "matrix_world": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]],
    "sensor_fit": "AUTO", "sensor_width": 36, "sensor_height": 24, "shift_x": 0, "shift_y": 0,
    "clip_start": 0.125, "clip_end": 100, "lens": 50, "ortho_scale": 6,
    "panorama_type": "EQUIRECTANGULAR", "fisheye_lens": 10.5, "fisheye_fov": 180,
    "longitude_min": -180, "longitude_max": 180, "latitude_min": -90, "latitude_max": 90,
    "fisheye_polynomial_k0": 0, "fisheye_polynomial_k1": -0.0625, "fisheye_polynomial_k2": 0.001,
    "fisheye_polynomial_k3": -0.0002, "fisheye_polynomial_k4": 0.000003,
    "central_cylindrical_range_u_min": -180, "central_cylindrical_range_u_max": 180,
    "central_cylindrical_range_v_min": -1, "central_cylindrical_range_v_max": 1,
    "central_cylindrical_radius": 1})");
  entry.update(changes);
  return entry;
}

std::vector<ImportedCamera> import(const json& entry) {
  return parse_blender(json{{"blender", "3.4.1"}, {"cameras", json::array({entry})}}.dump(),
                       "cameras.json");
}

Camera imported(const json& changes) {
  return judged(import(entry_of(changes))).at(0).camera;
}

json panorama(const char* type, const json& changes = json::object()) {
  json all{{"type", "PANO"}, {"panorama_type", type}};
  all.update(changes);
  return all;
}

/// A direction of Cycles' panoramas, x forward, y left and z up, in ours; blender_camera_matrix().
Direction from_panorama(double forward, double left, double up) {
  return {-left, -up, forward};
}

/// The place of a pixel's centre, from 0 to 1: to the right and upwards.
struct Place {
  double u, v;
};

Place place_of(const Camera& camera, double column, double row, double shift_x = 0,
               double shift_y = 0) {
  return {(column + 0.5) / camera.width + shift_x, 1 - (row + 0.5) / camera.height + shift_y};
}

double radians(double degrees) {
  return degrees * pi / 180;
}

/// equirectangular_range_to_direction(), with the range of Camera::update().
Direction equirectangular(Place p, double longitude_min, double longitude_max, double latitude_min,
                          double latitude_max) {
  const double phi = (longitude_min - longitude_max) * p.u - longitude_min;
  const double theta = (latitude_min - latitude_max) * p.v - latitude_min + pi / 2;
  return from_panorama(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                       std::cos(theta));
}

TEST(ImportBlender, FullPanoramas) {
  const Camera all = imported(panorama("EQUIRECTANGULAR"));
  EXPECT_EQ(all.projection.lens, Lens{LensModel::equirectangular});
  EXPECT_EQ(all.projection.fx, 12);
  EXPECT_EQ(all.projection.fy, 8);
  EXPECT_EQ(all.projection.cx, 6);
  EXPECT_EQ(all.projection.cy, 4);
  EXPECT_EQ(all.projection.pixel_centre, 0.5);
  EXPECT_EQ(all.near, 0.125);
  EXPECT_EQ(all.far, 100);
  expect_directions(all, [&](double column, double row) -> std::optional<Direction> {
    return equirectangular(place_of(all, column, row), -pi, pi, -pi / 2, pi / 2);
  });
}

TEST(ImportBlender, PartsOfPanoramasAreShifted) {
  const Camera part = imported(panorama("EQUIRECTANGULAR", {{"longitude_min", -30},
                                                            {"longitude_max", 75},
                                                            {"latitude_min", -20},
                                                            {"latitude_max", 60},
                                                            {"shift_x", 0.125},
                                                            {"shift_y", -0.25}}));
  expect_directions(part, [&](double column, double row) -> std::optional<Direction> {
    return equirectangular(place_of(part, column, row, 0.125, -0.25), radians(-30), radians(75),
                           radians(-20), radians(60));
  });
}

// central_cylindrical_to_direction(), with the range of Camera::update(): −u_min, −u_max, and v
// over the radius.
TEST(ImportBlender, CentralCylinders) {
  const Camera part =
      imported(panorama("CENTRAL_CYLINDRICAL", {{"central_cylindrical_range_u_min", -45},
                                                {"central_cylindrical_range_u_max", 135},
                                                {"central_cylindrical_range_v_min", -1},
                                                {"central_cylindrical_range_v_max", 2},
                                                {"central_cylindrical_radius", 1.5},
                                                {"shift_x", 0.0625},
                                                {"shift_y", 0.125}}));
  EXPECT_EQ(part.projection.lens, Lens{LensModel::cylindrical});
  expect_directions(part, [&](double column, double row) -> std::optional<Direction> {
    const auto [u, v] = place_of(part, column, row, 0.0625, 0.125);
    const double theta = radians(45) + (radians(-135) - radians(45)) * u;
    const double z = -1 / 1.5 + (2 / 1.5 + 1 / 1.5) * v;
    return from_panorama(std::cos(theta), std::sin(theta), z);
  });
}

/// What the fisheyes have in common: the angle to the axis, and the direction of (u, v).
Direction fisheye(double theta, double u, double v) {
  const double r = std::hypot(u, v);
  const double cos_phi = r == 0 ? 1 : u / r, sin_phi = r == 0 ? 0 : v / r;
  return from_panorama(std::cos(theta), -cos_phi * std::sin(theta), sin_phi * std::sin(theta));
}

// fisheye_to_direction(): the circle touches all sides of the image.
TEST(ImportBlender, EquidistantFisheyesFillTheImage) {
  const Camera one =
      imported(panorama("FISHEYE_EQUIDISTANT", {{"fisheye_fov", 200}, {"shift_x", 0.0625}}));
  EXPECT_EQ(one.projection.lens->model, LensModel::fisheye);
  EXPECT_NEAR(one.projection.lens->max_radius, radians(100), 1e-15);
  expect_directions(one, [&](double column, double row) -> std::optional<Direction> {
    const auto [u, v] = place_of(one, column, row, 0.0625);
    const double x = 2 * u - 1, y = 2 * v - 1, r = std::hypot(x, y);
    if (r > 1) return std::nullopt;
    return fisheye(r * radians(200) / 2, x, y);
  });
}

/// The sensor of fisheyes in blender_camera_sync().
struct Sensor {
  double width, height;
};

// fisheye_equisolid_to_direction()
std::optional<Direction> equisolid(Place p, double lens, double fov, Sensor sensor) {
  const double x = (p.u - 0.5) * sensor.width, y = (p.v - 0.5) * sensor.height;
  const double r = std::hypot(x, y);
  if (r > 2 * lens * std::sin(fov / 4)) return std::nullopt;
  return fisheye(2 * std::asin(r / (2 * lens)), x, y);
}

TEST(ImportBlender, EquisolidFisheyesHaveASensor) {
  const Camera wide = imported(panorama("FISHEYE_EQUISOLID", {{"fisheye_fov", 170}}));
  expect_directions(wide, [&](double column, double row) {
    return equisolid(place_of(wide, column, row), 10.5, radians(170), {36, 24});
  });
  const Camera high = imported(
      panorama("FISHEYE_EQUISOLID", {{"width", 8}, {"height", 12}, {"pixel_aspect", {1, 1.25}}}));
  expect_directions(high, [&](double column, double row) {
    return equisolid(place_of(high, column, row), 10.5, pi, {36 * 8 / 15.0, 36});
  });
  const Camera fitted =
      imported(panorama("FISHEYE_EQUISOLID", {{"sensor_fit", "VERTICAL"}, {"fisheye_fov", 170}}));
  expect_directions(fitted, [&](double column, double row) {
    return equisolid(place_of(fitted, column, row), 10.5, radians(170), {36, 24});
  });
}

// fisheye_lens_polynomial_to_direction()
TEST(ImportBlender, LensPolynomialsHaveTheOppositeSign) {
  const ImportedCamera one = import(entry_of(panorama("FISHEYE_LENS_POLYNOMIAL"))).at(0);
  EXPECT_EQ(one.fault, "");
  if (!lens_model_named("FTHETA")) {
    EXPECT_EQ(one.absence, "cameras.json: cameras[0]: the lens model FTHETA is not available");
    return;
  }
  ASSERT_EQ(one.absence, "");
  expect_directions(one.camera, [&](double column, double row) -> std::optional<Direction> {
    const auto [u, v] = place_of(one.camera, column, row);
    const double x = (u - 0.5) * 36, y = (v - 0.5) * 24, r = std::hypot(x, y);
    const double theta =
        -(-0.0625 * r + 0.001 * r * r - 0.0002 * r * r * r + 0.000003 * r * r * r * r);
    if (std::abs(theta) > pi / 2) return std::nullopt;
    return fisheye(theta, x, y);
  });
}

// mirrorball_to_direction(), in the axes of blender_camera_matrix(): x right, −y forward, z up.
TEST(ImportBlender, MirrorBallsAreEquisolid) {
  const Camera one = imported(panorama("MIRRORBALL", {{"shift_y", 0.0625}}));
  expect_directions(one, [&](double column, double row) -> std::optional<Direction> {
    const auto [u, v] = place_of(one, column, row, 0, 0.0625);
    const double x = 2 * u - 1, z = 2 * v - 1;
    if (x * x + z * z > 1) return std::nullopt;
    const double y = -std::sqrt(1 - x * x - z * z);
    // The reflection 2·(n·I)·n − I of I = (0, −1, 0).
    const double w = 2 * -y;
    return Direction{w * x, -(w * z), -(w * y + 1)};
  });
}

// docs/conventions.md: view = W or a·H.
TEST(ImportBlender, PinholesFitTheirSensor) {
  const Camera wide = imported({{"shift_x", 0.25}, {"shift_y", 0.125}});
  EXPECT_EQ(wide.projection.lens, std::nullopt);
  EXPECT_NEAR(wide.projection.fx, 50.0 / 36 * 12, 1e-14);
  EXPECT_EQ(wide.projection.fy, wide.projection.fx);
  EXPECT_EQ(wide.projection.cx, 6 - 0.25 * 12);
  EXPECT_EQ(wide.projection.cy, 4 + 0.125 * 12);
  const Camera high = imported({{"width", 8},
                                {"height", 12},
                                {"pixel_aspect", {2, 3}},
                                {"shift_x", 0.25},
                                {"shift_y", 0.125}});
  // a = 1.5, so that the image is 8 by 18 of its pixels' widths, and the height is fitted.
  EXPECT_EQ(high.projection.fx, 25);
  EXPECT_NEAR(high.projection.fy, 50.0 / 36 * 12, 1e-14);
  EXPECT_EQ(high.projection.cx, 4 - 0.25 * 18);
  EXPECT_EQ(high.projection.cy, 6 + 0.125 * 12);
  EXPECT_NEAR(imported({{"sensor_fit", "VERTICAL"}}).projection.fx, 50.0 / 24 * 8, 1e-14);
  EXPECT_NEAR(imported({{"sensor_fit", "HORIZONTAL"}, {"width", 4}}).projection.fx, 50.0 / 36 * 4,
              1e-14);
  const Camera flat = imported({{"type", "ORTHO"}, {"shift_x", 0.25}});
  EXPECT_EQ(flat.projection.model, ProjectionModel::orthographic);
  EXPECT_EQ(flat.projection.fx, 2);
  EXPECT_EQ(flat.projection.cx, 6 - 0.25 * 12);
}

TEST(ImportBlender, TheScaleOfAnObjectIsIgnored) {
  const json pose{{0, 0, -3, 1}, {2, 0, 0, 2}, {0, 5, 0, 3}, {0, 0, 0, 1}};
  // The camera's x is the world's y, its y the world's z, its z the world's −x.
  const Pose expected{{{0, 1, 0, -2}, {0, 0, -1, 3}, {1, 0, 0, -1}}};
  const Pose found = imported({{"matrix_world", pose}}).world_to_camera;
  EXPECT_EQ(found, expected);
}

TEST(ImportBlender, FaultsAreNamed) {
  const auto fault = [](const json& changes) { return import(entry_of(changes)).at(0).fault; };
  EXPECT_EQ(fault({{"lens", 0}}),
            "cameras.json: cameras[0].lens: expected a number greater than 0");
  EXPECT_THAT(fault({{"sensor_fit", "BOTH"}}),
              HasSubstr("sensor_fit: found BOTH, expected AUTO, HORIZONTAL or VERTICAL"));
  EXPECT_THAT(fault({{"matrix_world", {{1, 0, 0, 0}, {2, 0, 0, 0}, {0, 0, 1, 0}}}}),
              HasSubstr("matrix_world: the matrix is singular"));
  EXPECT_THAT(fault({{"matrix_world", json::array({json::array({1, 0, 0, 0})})}}),
              HasSubstr("matrix_world: expected a 4×4 matrix, found 1 row"));
  EXPECT_THAT(fault({{"clip_start", "nan"}}),
              HasSubstr("clip_start: is a string, expected a number"));
  EXPECT_THAT(fault(panorama("FISHEYE_EQUIDISTANT", {{"fisheye_fov", 400}})),
              HasSubstr("fisheye_fov: expected an angle of at most 360 degrees"));
  EXPECT_THAT(fault(panorama("EQUIRECTANGULAR", {{"longitude_min", 180}})),
              HasSubstr("longitude_max: expected more than longitude_min"));
  EXPECT_EQ(import(entry_of(panorama("EQUIANGULAR_CUBEMAP_FACE"))).at(0).absence,
            "cameras.json: cameras[0].panorama_type: no lens model shows what a camera "
            "EQUIANGULAR_CUBEMAP_FACE shows");
  const auto file_fault = [](const char* text) {
    return message_of<InputError>([&] { parse_blender(text, "cameras.json"); });
  };
  EXPECT_THAT(file_fault("{}"), HasSubstr("cameras.json: the key \"cameras\" is missing"));
  EXPECT_THAT(file_fault(R"({"cameras": []})"), HasSubstr("cameras: there is no camera"));
  EXPECT_THAT(file_fault(R"({"cameras": [{}]})"), HasSubstr("the key \"name\" is missing"));
  EXPECT_THAT(file_fault(R"({"cameras": [)"), HasSubstr("cameras.json: line 1: not JSON"));
  json sizeless = entry_of(json::object());
  sizeless.erase("width");
  EXPECT_THAT(import(sizeless).at(0).fault, HasSubstr("the key \"width\" is missing"));
}

}  // namespace
}  // namespace fathom
