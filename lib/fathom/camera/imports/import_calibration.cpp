#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include "fathom/camera/camera_import_internal.h"
#include "fathom/camera/data_set_cameras.h"
#include "fathom/camera/imports/calibrated_lens.h"
#include "fathom/camera/imports/lines_and_poses.h"
#include "fathom/camera/lens.h"
#include "fathom/failures/unknown_name.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/counted.h"
#include "fathom/text/json_value.h"
#include "fathom/text/printable.h"

namespace fathom {
using namespace camera;
using text::JsonValue;

namespace {

using Keys = std::span<const char* const>;

/// The first of the keys that the object has.
std::optional<JsonValue> find_first(const JsonValue& root, Keys keys) {
  for (const char* key : keys)
    if (auto value = root.find(key)) return value;
  return std::nullopt;
}

std::string listed(Keys keys) {
  return joined({keys.begin(), keys.end()}, " or ");
}

void append_numbers(const JsonValue& list, std::vector<double>& numbers) {
  for (const JsonValue& element : list.elements()) {
    if (element.is_list()) {
      append_numbers(element, numbers);
    } else {
      numbers.push_back(element.number());
    }
  }
}

/// The numbers of a matrix, row by row: of an object with rows, cols and data, or of a list.
std::vector<double> numbers_of_matrix(const JsonValue& matrix) {
  std::vector<double> numbers;
  if (!matrix.is_object()) {
    append_numbers(matrix, numbers);
    return numbers;
  }
  append_numbers(matrix.at("data"), numbers);
  constexpr auto most = std::numeric_limits<std::uint32_t>::max();
  const std::uint64_t rows = matrix.at("rows").integer(0, most),
                      columns = matrix.at("cols").integer(0, most);
  if (rows * columns != numbers.size())
    matrix.fail("has " + text::counted(numbers.size(), "number") + ", expected rows times cols, " +
                std::to_string(rows * columns));
  return numbers;
}

/// The width or height by one of the keys.
JsonValue size_at(const JsonValue& root, Keys keys) {
  const auto size = find_first(root, keys);
  if (!size)
    root.fail("has no image size: expected " + listed(keys) +
              ", or a size that is given (--size, in Python size=)");
  return *size;
}

IntrinsicMatrix intrinsics_of(const JsonValue& matrix) {
  const std::vector<double> numbers = numbers_of_matrix(matrix);
  IntrinsicMatrix K;
  if (numbers.size() != K.size())
    matrix.fail("expected 3 rows of 3 numbers, found " + text::counted(numbers.size(), "number"));
  std::ranges::copy(numbers, K.begin());
  return K;
}

/// The keys of a kind of files, each by the names that it may have.
struct CalibrationKeys {
  Keys matrix, width, height, distortion;
};

/// Everything but the lens.
Camera pinhole_part(const JsonValue& root, const CalibrationKeys& keys, const GivenLens& given) {
  const auto matrix = find_first(root, keys.matrix);
  if (!matrix) root.fail("has no camera matrix: expected " + listed(keys.matrix));
  Camera camera;
  set_image(camera, given, [&] {
    return std::array{size_at(root, keys.width), size_at(root, keys.height)};
  });
  set_intrinsics(camera.projection, intrinsics_of(*matrix), matrix->where());
  return camera;
}

/// OpenCV's lens or fisheye with these numbers; no lens where all are 0 and the model is one of the
/// plane.
void set_opencv_lens(const JsonValue& list, LensModel model, const std::vector<double>& numbers,
                     ImportedCamera& one) {
  const bool bends = std::ranges::any_of(numbers, [](double number) { return number != 0; });
  if (is_plane(model) && !bends) return;
  if (const auto fault = distortion_count_fault(entry_of(model), numbers.size())) list.fail(*fault);
  Lens lens{model};
  std::ranges::copy(numbers, lens.distortion.begin());
  if (const auto fault = find_fault(lens)) {
    one.distortion = list.where() + ": " + *fault;
  } else {
    one.camera.projection.lens = lens;
  }
}

constexpr std::array opencv_matrix{"camera_matrix", "Camera_Matrix", "cameraMatrix", "K"};
constexpr std::array opencv_width{"image_width", "image_Width"};
constexpr std::array opencv_height{"image_height", "image_Height"};
constexpr std::array opencv_distortion{"distortion_coefficients", "Distortion_Coefficients",
                                       "distCoeffs", "dist_coeffs", "D"};
constexpr CalibrationKeys keys_of_opencv{opencv_matrix, opencv_width, opencv_height,
                                         opencv_distortion};

void read_opencv_lens(const JsonValue& root, ImportedCamera& one) {
  const auto fisheye = root.find("fisheye_model");
  const bool is_fisheye = fisheye && fisheye->is_number() && fisheye->number() != 0;
  if (const auto list = find_first(root, keys_of_opencv.distortion)) {
    set_opencv_lens(*list, is_fisheye ? LensModel::opencv_fisheye : LensModel::opencv_14,
                    numbers_of_matrix(*list), one);
  } else {
    one.distortion = root.where() + ": has no numbers of distortion: expected " +
                     listed(keys_of_opencv.distortion);
  }
}

constexpr std::array ros_matrix{"camera_matrix", "K", "k"};
constexpr std::array ros_width{"image_width", "width"};
constexpr std::array ros_height{"image_height", "height"};
constexpr std::array ros_distortion{"distortion_coefficients", "D", "d"};
constexpr CalibrationKeys keys_of_ros{ros_matrix, ros_width, ros_height, ros_distortion};

/// A distortion_model of ROS, and how many numbers it may have.
struct RosModel {
  std::string_view name;
  LensModel model;
  std::span<const std::size_t> counts;
};

constexpr std::array<std::size_t, 2> of_plumb_bob{4, 5};
constexpr std::array<std::size_t, 3> of_rational_polynomial{8, 12, 14};
constexpr std::array<std::size_t, 1> of_equidistant{4};
constexpr std::array<RosModel, 3> ros_models{
    {{"equidistant", LensModel::opencv_fisheye, of_equidistant},
     {"plumb_bob", LensModel::opencv_14, of_plumb_bob},
     {"rational_polynomial", LensModel::opencv_14, of_rational_polynomial}}};

void read_ros_lens(const JsonValue& root, ImportedCamera& one) {
  const auto list = find_first(root, keys_of_ros.distortion);
  const std::vector<double> numbers = list ? numbers_of_matrix(*list) : std::vector<double>{};
  if (numbers.empty()) return;
  const JsonValue model = root.at("distortion_model");
  const auto* const known = std::ranges::find(ros_models, model.string(), &RosModel::name);
  if (known == ros_models.end()) {
    one.distortion = model.where() + ": " + text::printable(model.string()) +
                     " is not available yet; expected equidistant, plumb_bob or "
                     "rational_polynomial";
    return;
  }
  if (std::ranges::find(known->counts, numbers.size()) == known->counts.end()) {
    std::vector<std::string> counts;
    for (const std::size_t count : known->counts) counts.push_back(std::to_string(count));
    list->fail("found " + text::counted(numbers.size(), "number") + ", " + model.string() +
               " has " + joined(counts, " or "));
  }
  set_opencv_lens(*list, known->model, numbers, one);
}

}  // namespace

std::vector<ImportedCamera> cameras_of_opencv(std::string_view json, const std::string& file,
                                              const GivenLens& given,
                                              const CalibrationPoses& poses) {
  const StandardArithmetic standard;
  const text::JsonDocument document(json, file);
  const JsonValue root = document.root();
  const auto camera = imported_camera(stem_of(file), file, [&](ImportedCamera& one) {
    one.camera = pinhole_part(root, keys_of_opencv, given);
    read_opencv_lens(root, one);
  });
  return at_poses(camera, file, poses);
}

std::vector<ImportedCamera> cameras_of_ros(std::string_view json, const std::string& file,
                                           const GivenLens& given, const CalibrationPoses& poses) {
  const StandardArithmetic standard;
  const text::JsonDocument document(json, file);
  const JsonValue root = document.root();
  const auto found = root.find("camera_name");
  const std::string name = found && found->is_string() ? found->string() : stem_of(file);
  const auto camera = imported_camera(name, file, [&](ImportedCamera& one) {
    one.camera = pinhole_part(root, keys_of_ros, given);
    read_ros_lens(root, one);
  });
  return at_poses(camera, file, poses);
}

}  // namespace fathom
