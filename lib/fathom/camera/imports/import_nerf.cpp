#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "fathom/camera/camera_import_internal.h"
#include "fathom/camera/imports/calibrated_lens.h"
#include "fathom/camera/imports/lines_and_poses.h"
#include "fathom/camera/rounded_angles.h"
#include "fathom/failures/errors.h"
#include "fathom/failures/unknown_name.h"
#include "fathom/files/input_file.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/json_value.h"
#include "fathom/text/printable.h"

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

/// The camera_model of Nerfstudio; empty where the file has none.
std::string model_of(const Frame& frame) {
  const auto model = frame.find("camera_model");
  return model ? model->string() : "";
}

/// The models of Nerfstudio that have a lens model here.
constexpr std::array<std::string_view, 8> known_models{"EQUIRECTANGULAR", "FISHEYE624",   "OPENCV",
                                                       "OPENCV_FISHEYE",  "PINHOLE",      "RADIAL",
                                                       "SIMPLE_PINHOLE",  "SIMPLE_RADIAL"};

/// Nerfstudio names its fisheye; instant-ngp has a key for it.
bool is_fisheye(const Frame& frame) {
  const auto flag = frame.find("is_fisheye");
  return model_of(frame) == "OPENCV_FISHEYE" || (flag && flag->boolean());
}

/// Refuses a lens of another model.
void expect_known_lens(const Frame& frame) {
  if (const auto model = frame.find("camera_model"))
    if (const std::string& name = model->string();
        std::ranges::find(known_models, name) == known_models.end())
      model->fail("the camera model " + printable(name) +
                  " is not supported; undistort the images, or expected " +
                  joined({known_models.begin(), known_models.end()}, " or "));
}

/// Nerfstudio bends the rays of a fisheye by p1 and p2, too, as COLMAP's thin prism fisheye does.
/// instant-ngp takes them for k3 and k4.
Lens fisheye_of(const Frame& frame, const std::array<double, 4>& k, double p1, double p2) {
  if (p1 == 0 && p2 == 0) return Lens{LensModel::opencv_fisheye, {k[0], k[1], k[2], k[3]}};
  if (model_of(frame).empty())
    frame.find(p1 != 0 ? "p1" : "p2")
        ->fail(
            "Nerfstudio and instant-ngp read p1 and p2 of a fisheye in different ways; expected 0, "
            "or \"camera_model\": \"OPENCV_FISHEYE\" for Nerfstudio's");
  return Lens{LensModel::thin_prism_fisheye, {k[0], k[1], p1, p2, k[2], k[3]}};
}

/// OpenCV's lens or a fisheye, or Brown's lens where k3 or k4, which are of r⁶ and r⁸ above the
/// fraction bar, are not 0. Nothing where all numbers of a lens that is no fisheye are 0.
std::optional<Lens> lens_of_opencv(const Frame& frame) {
  const auto number = [&](const char* key) { return frame.number(key).value_or(0); };
  const double k1 = number("k1"), k2 = number("k2"), k3 = number("k3"), k4 = number("k4"),
               p1 = number("p1"), p2 = number("p2");
  if (is_fisheye(frame)) return fisheye_of(frame, {k1, k2, k3, k4}, p1, p2);
  std::optional<Lens> lens;
  if (k3 != 0 || k4 != 0) {
    lens = Lens{LensModel::brown, {k1, k2, k3, k4, p1, p2}};
  } else if (k1 != 0 || k2 != 0 || p1 != 0 || p2 != 0) {
    lens = Lens{LensModel::opencv, {k1, k2, p1, p2}};
  }
  return lens;
}

/// Nerfstudio's angles are π·(u − cx)/fl_x and π·(v − cy)/fl_y: a turn is 2·fl_x pixels wide.
void make_panorama(Projection& projection) {
  projection.lens = Lens{LensModel::equirectangular};
  projection.fx *= 2;
}

/// Project Aria's lens, from a list of its 12 numbers.
void read_fisheye624(const Frame& frame, ImportedCamera& one) {
  const auto list = frame.find("distortion_params");
  if (!list) frame.own.fail("the numbers of FISHEYE624 are missing: expected distortion_params");
  set_fisheye624(one, list->numbers(fisheye624_numbers), list->where());
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

void read_nerf_focal_lengths(const Frame& frame, Camera& camera) {
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
}

void read_principal_point(const Frame& frame, Camera& camera) {
  camera.projection.cx = frame.number("cx").value_or(camera.width / 2.0);
  camera.projection.cy = frame.number("cy").value_or(camera.height / 2.0);
}

/// Nerfstudio's lens, or instant-ngp's lens of OpenCV.
void read_nerfstudio_lens(const Frame& frame, ImportedCamera& one) {
  read_nerf_focal_lengths(frame, one.camera);
  read_principal_point(frame, one.camera);
  const std::string model = model_of(frame);
  if (model == "EQUIRECTANGULAR") {
    make_panorama(one.camera.projection);
  } else if (model == "FISHEYE624") {
    read_fisheye624(frame, one);
  } else {
    one.camera.projection.lens = lens_of_opencv(frame);
  }
}

/// instant-ngp's f-theta lens: the angle to the axis is a polynomial of the distance from the
/// principal point in pixels. Rays end before 90°. The focal length has no meaning.
void read_ftheta(const Frame& frame, ImportedCamera& one) {
  constexpr std::array<std::string_view, 5> parameters{"p0", "p1", "p2", "p3", "p4"};
  std::vector<LensNumber> numbers;
  for (const std::string_view parameter : parameters) {
    const std::string key = "ftheta_" + std::string(parameter);
    const auto number = frame.number(key.c_str());
    if (!number) frame.own.fail("the f-theta lens has no " + key + ": expected ftheta_p0 to p4");
    numbers.push_back({parameter, *number});
  }
  read_principal_point(frame, one.camera);
  one.camera.projection.fx = one.camera.projection.fy = 1;
  set_lens(one, "FTHETA", numbers, frame.own.where());
  constexpr double greatest_below_90_degrees = std::numbers::pi / 2;
  if (auto& lens = one.camera.projection.lens) lens->max_radius = greatest_below_90_degrees;
}

/// instant-ngp's panorama of all directions, which has neither focal length nor principal point.
void read_latlong(ImportedCamera& one) {
  const double width = one.camera.width, height = one.camera.height;
  set_intrinsics(one.camera.projection, std::array{width, height, width / 2, height / 2});
  one.camera.projection.lens = Lens{LensModel::equirectangular};
}

/// As in instant-ngp, equirectangular overrides latlong, which overrides ftheta_p0, and the values
/// of the first two are not read.
void read_lens(const Frame& frame, ImportedCamera& one) {
  if (const auto equal_area = frame.find("equirectangular"))
    equal_area->fail("instant-ngp's panorama with rows of equal area is not available");
  if (frame.find("latlong")) {
    read_latlong(one);
  } else if (frame.find("ftheta_p0")) {
    read_ftheta(frame, one);
  } else {
    read_nerfstudio_lens(frame, one);
  }
}

/// World to camera, in our axes, of a camera-to-world matrix in OpenGL's.
Pose world_to_camera(const JsonValue& matrix) {
  return camera_from_world(parse_matrix(matrix), PoseDirection::camera_to_world, CameraAxes::opengl,
                           matrix.where());
}

void warn_of_geometry(const JsonValue& root, const std::string& file, Warnings& warnings) {
  for (const char* key : {"scale", "offset", "applied_transform", "applied_scale"})
    if (root.find(key))
      warnings.push_back(file + ": the key \"" + key +
                         "\" is not applied: cameras are taken over as transform_matrix has them");
}

/// The frames, and those that ScanNet++ sets apart for tests.
std::vector<JsonValue> frames_of(const JsonValue& root) {
  std::vector<JsonValue> frames = root.at("frames").elements();
  if (const auto more = root.find("test_frames")) {
    const std::vector<JsonValue> apart = more->elements();
    frames.insert(frames.end(), apart.begin(), apart.end());
  }
  return frames;
}

}  // namespace

std::vector<ImportedCamera> camera::parse_nerf(std::string_view text, const std::string& name,
                                               std::uint32_t width, std::uint32_t height,
                                               Warnings& warnings) {
  const JsonDocument document(text, name);
  const JsonValue root = document.root();
  warn_of_geometry(root, name, warnings);
  std::vector<ImportedCamera> cameras;
  for (const JsonValue& own : frames_of(root)) {
    const auto file_path = own.find("file_path");
    const std::string image = file_path ? file_path->string() : std::to_string(cameras.size());
    cameras.push_back(imported_camera(image, own.where(), [&](ImportedCamera& one) {
      const Frame frame{own, root};
      expect_known_lens(frame);
      one.distortion = unknown_distortion(frame);
      one.camera.width = image_size(frame, "w", width);
      one.camera.height = image_size(frame, "h", height);
      read_lens(frame, one);
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
