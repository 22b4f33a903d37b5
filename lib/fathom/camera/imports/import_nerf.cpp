#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "fathom/camera/camera_import_internal.h"
#include "fathom/camera/imports/lines_and_poses.h"
#include "fathom/camera/rounded_angles.h"
#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/json_value.h"

namespace fathom {
using namespace camera;
using namespace files;
using namespace text;

namespace {

/// The keys of one frame; missing keys are taken from the whole file.
struct Frame {
  JsonValue own;
  JsonValue file;

  [[nodiscard]] std::optional<JsonValue> find(const char* key) const {
    if (auto value = own.find(key)) return value;
    return file.find(key);
  }
  [[nodiscard]] std::optional<double> number(const char* key) const {
    const auto value = find(key);
    return value ? std::optional(value->number()) : std::nullopt;
  }
};

/// Nerfstudio's models that are pinhole cameras if k1, k2, … are 0.
constexpr std::array<std::string_view, 5> pinhole_models{"OPENCV", "PINHOLE", "RADIAL",
                                                         "SIMPLE_PINHOLE", "SIMPLE_RADIAL"};

/// Nerfstudio names its fisheye; instant-ngp has a key for it.
bool is_fisheye(const Frame& frame) {
  const auto model = frame.find("camera_model"), flag = frame.find("is_fisheye");
  return (model && model->string() == "OPENCV_FISHEYE") || (flag && flag->boolean());
}

/// Refuses a lens of another model.
void expect_known_lens(const Frame& frame) {
  if (const auto model = frame.find("camera_model"))
    if (const std::string& name = model->string();
        name != "OPENCV_FISHEYE" && std::ranges::find(pinhole_models, name) == pinhole_models.end())
      model->fail("the camera model " + name +
                  " is not supported; undistort the images, or expected OPENCV, OPENCV_FISHEYE, "
                  "PINHOLE, RADIAL, SIMPLE_PINHOLE or SIMPLE_RADIAL");
  // instant-ngp names its other lenses by keys of their own.
  for (const char* key : {"ftheta_p0", "latlong", "equirectangular"})
    if (const auto other = frame.find(key)) other->fail("the lens is no pinhole camera");
}

/// OpenCV's lens or fisheye, or Brown's lens where k3 or k4, which are of r⁶ and r⁸ above the
/// fraction bar, are not 0. Nothing where all numbers of a lens that is no fisheye are 0.
std::optional<Lens> lens_of(const Frame& frame) {
  expect_known_lens(frame);
  const auto number = [&](const char* key) { return frame.number(key).value_or(0); };
  const double k1 = number("k1"), k2 = number("k2"), k3 = number("k3"), k4 = number("k4"),
               p1 = number("p1"), p2 = number("p2");
  if (is_fisheye(frame)) return Lens{LensModel::opencv_fisheye, {k1, k2, k3, k4}};
  std::optional<Lens> lens;
  if (k3 != 0 || k4 != 0) {
    lens = Lens{LensModel::brown, {k1, k2, k3, k4, p1, p2}};
  } else if (k1 != 0 || k2 != 0 || p1 != 0 || p2 != 0) {
    lens = Lens{LensModel::opencv, {k1, k2, p1, p2}};
  }
  return lens;
}

/// Which number of the lens has no meaning in Nerfstudio's models, or nothing.
std::string unknown_distortion(const Frame& frame) {
  for (const char* key : {"k5", "k6"})
    if (const auto k = frame.find(key); k && k->number() != 0)
      return k->where() + ": lens distortion";
  return {};
}

std::uint32_t image_size(const Frame& frame, const char* key, std::uint32_t given) {
  constexpr auto largest = std::numeric_limits<std::uint32_t>::max();
  if (const auto size = frame.find(key))
    return static_cast<std::uint32_t>(size->integer(1, largest));
  if (given == 0)
    frame.own.fail(std::string("the key \"") + key +
                   "\" is missing here and for the whole file, and no image size was given");
  return given;
}

/// The angle in radians that the image spans.
std::optional<double> angle_of(const Frame& frame, const char* key) {
  const auto angle = frame.number(key);
  if (angle && !(*angle > 0 && *angle < std::numbers::pi))
    frame.find(key)->fail("expected an angle in radians between 0 and π");
  return angle;
}

/// The focal length by the angle in degrees that the image spans, which instant-ngp asks for first.
std::optional<double> focal_in_degrees(const Frame& frame, const char* key, std::uint32_t size) {
  const auto angle = frame.number(key);
  if (!angle) return std::nullopt;
  if (!(*angle > 0 && *angle < 180))
    frame.find(key)->fail("expected an angle in degrees between 0 and 180");
  return focal_of_degrees(size, *angle);
}

void read_intrinsics(const Frame& frame, Camera& camera) {
  const auto fov_x = focal_in_degrees(frame, "x_fov", camera.width),
             fov_y = focal_in_degrees(frame, "y_fov", camera.height);
  const auto angle_x = angle_of(frame, "camera_angle_x"),
             angle_y = angle_of(frame, "camera_angle_y");
  const auto fl_x = frame.number("fl_x"), fl_y = frame.number("fl_y");
  if (!fov_x && !fl_x && !angle_x && !fov_y)
    frame.own.fail("the focal length is missing: expected fl_x, camera_angle_x or x_fov");
  camera.projection.fx = fov_x     ? *fov_x
                         : fl_x    ? *fl_x
                         : angle_x ? focal_of_radians(camera.width, *angle_x)
                                   : *fov_y;
  camera.projection.fy = fov_y              ? *fov_y
                         : fl_y             ? *fl_y
                         : angle_y && !fl_x ? focal_of_radians(camera.height, *angle_y)
                                            : camera.projection.fx;
  camera.projection.cx = frame.number("cx").value_or(camera.width / 2.0);
  camera.projection.cy = frame.number("cy").value_or(camera.height / 2.0);
}

/// World to camera, in our axes, of a camera-to-world matrix in OpenGL's.
Pose world_to_camera(const JsonValue& matrix) {
  const auto rows = matrix.elements();
  if (rows.size() != 3 && rows.size() != 4)
    matrix.fail("expected a 4×4 matrix, found " + std::to_string(rows.size()) + " rows");
  std::vector<double> numbers;
  for (const JsonValue& each : rows) {
    const auto row = each.numbers(4);
    numbers.insert(numbers.end(), row.begin(), row.end());
  }
  return camera_from_world(pose_of_numbers(numbers, matrix.where()), PoseDirection::camera_to_world,
                           CameraAxes::opengl, matrix.where());
}

void warn_of_geometry(const JsonValue& root, const std::string& file, Warnings& warnings) {
  for (const char* key : {"scale", "offset", "applied_transform", "applied_scale"})
    if (root.find(key))
      warnings.push_back(file + ": the key \"" + key +
                         "\" is not applied: cameras are taken over as transform_matrix has them");
}

}  // namespace

std::vector<ImportedCamera> camera::parse_nerf(std::string_view text, const std::string& name,
                                               std::uint32_t width, std::uint32_t height,
                                               Warnings& warnings) {
  const JsonDocument document(text, name);
  const JsonValue root = document.root();
  warn_of_geometry(root, name, warnings);
  std::vector<ImportedCamera> cameras;
  for (const JsonValue& own : root.at("frames").elements()) {
    const auto file_path = own.find("file_path");
    const std::string image = file_path ? file_path->string() : std::to_string(cameras.size());
    cameras.push_back(imported_camera(image, own.where(), [&](ImportedCamera& one) {
      const Frame frame{own, root};
      one.camera.projection.lens = lens_of(frame);
      one.distortion = unknown_distortion(frame);
      one.camera.width = image_size(frame, "w", width);
      one.camera.height = image_size(frame, "h", height);
      read_intrinsics(frame, one.camera);
      one.camera.world_to_camera = world_to_camera(own.at("transform_matrix"));
    }));
  }
  if (cameras.empty()) root.at("frames").fail("there is no frame");
  return cameras;
}

std::vector<ImportedCamera> import_nerf(const std::filesystem::path& file, std::uint32_t width,
                                        std::uint32_t height, Warnings& warnings) {
  const StandardArithmetic standard;
  return parse_nerf(InputFile(file).text(), file.string(), width, height, warnings);
}

}  // namespace fathom
