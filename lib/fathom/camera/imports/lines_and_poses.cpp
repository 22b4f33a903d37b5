#include "fathom/camera/imports/lines_and_poses.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <system_error>
#include <unordered_set>

#include "fathom/failures/errors.h"
#include "fathom/text/counted.h"
#include "fathom/text/decimal.h"
#include "fathom/text/json_value.h"
#include "fathom/text/printable.h"

namespace fathom::camera {
namespace fs = std::filesystem;
using text::DecimalFault;
using text::parse_decimal;
using text::printable;

bool next_line(NamedStream& file, std::size_t& number, Line& line) {
  for (std::string text; std::getline(file.stream, text);) {
    ++number;
    if (!text.empty() && text.back() == '\r') text.pop_back();
    const auto first = text.find_first_not_of(" \t");
    if (first == std::string::npos || text[first] == '#') continue;
    line = {std::istringstream(text), file.name + ": line " + std::to_string(number)};
    return true;
  }
  return false;
}

std::vector<Line> lines_of(std::string_view text, const std::string& name) {
  std::istringstream stream{std::string(text)};
  NamedStream file{stream, name};
  std::vector<Line> lines;
  Line line;
  for (std::size_t number = 0; next_line(file, number, line);) lines.push_back(std::move(line));
  return lines;
}

std::string read_word(Line& line, const char* what) {
  std::string word;
  if (!(line.words >> word)) throw InputError(line.where + ": " + what + " is missing");
  return word;
}

void refuse(const Line& line, const char* what, const std::string& word) {
  throw InputError(line.where + ": expected " + what + ", found '" + printable(word) + "'");
}

double read_number(Line& line, const char* what) {
  const std::string word = read_word(line, what);
  const auto result = parse_decimal<double>(word.data(), word.data() + word.size());
  if (result.fault != DecimalFault::none || result.end != word.data() + word.size())
    refuse(line, what, word);
  return result.value;
}

double number_of(const std::string& word, const std::string& where) {
  const auto result = parse_decimal<double>(word.data(), word.data() + word.size());
  if (result.end == word.data() + word.size()) {
    if (result.fault == DecimalFault::none) return result.value;
    if (result.fault == DecimalFault::not_finite) return std::numeric_limits<double>::quiet_NaN();
  }
  throw InputError(where + ": expected a number, found '" + printable(word) + "'");
}

std::vector<double> rest_of(Line& line) {
  std::vector<double> numbers;
  for (std::string word; line.words >> word;) numbers.push_back(number_of(word, line.where));
  return numbers;
}

double read_time(Line& line, std::string& text) {
  text = read_word(line, "a time in seconds");
  const double time = number_of(text, line.where);
  if (!std::isfinite(time)) refuse(line, "a time in seconds", text);
  return time;
}

TumPose read_tum_pose(Line& line) {
  TumPose pose;
  pose.time = read_time(line, pose.time_text);
  const std::vector<double> n = rest_of(line);
  if (n.size() != 7)
    throw InputError(line.where + ": expected time tx ty tz qx qy qz qw, 8 numbers, found " +
                     std::to_string(n.size() + 1));
  pose.position = {n[0], n[1], n[2]};
  pose.quaternion = {n[6], n[3], n[4], n[5]};
  if (!std::ranges::all_of(n, [](double x) { return std::isfinite(x); }))
    pose.fault = line.where + ": the pose has a number that is not finite";
  else if (std::all_of(n.begin() + 3, n.end(), [](double x) { return x == 0; }))
    pose.fault = line.where + ": the quaternion is zero";
  return pose;
}

void set_intrinsics(Projection& projection, const IntrinsicMatrix& K, const std::string& where) {
  if (K[3] != 0 || K[6] != 0 || K[7] != 0 || K[8] != 1)
    throw InputError(where + ": expected fx s cx, 0 fy cy, 0 0 1");
  projection.fx = K[0];
  projection.skew = K[1];
  projection.cx = K[2];
  projection.fy = K[4];
  projection.cy = K[5];
}

void set_intrinsics(Projection& projection, std::span<const double, 4> numbers) {
  projection.fx = numbers[0];
  projection.fy = numbers[1];
  projection.cx = numbers[2];
  projection.cy = numbers[3];
}

IntrinsicMatrix intrinsic_matrix(double fx, double fy, double cx, double cy) {
  return {fx, 0, cx, 0, fy, cy, 0, 0, 1};
}

Camera lens_of(const GivenLens& given, const GivenLens& data_set, const std::string& where) {
  Camera camera;
  camera.width = given.width != 0 ? given.width : data_set.width;
  camera.height = given.height != 0 ? given.height : data_set.height;
  camera.projection.pixel_centre = given.pixel_centre.value_or(data_set.pixel_centre.value_or(0));
  if (const auto& K = given.K ? given.K : data_set.K) set_intrinsics(camera.projection, *K, where);
  return camera;
}

namespace {

/// y and z of the camera turned round. A difference, so that no zero becomes negative.
void turn_column(Pose& world_from_camera, std::size_t k) {
  for (auto& row : world_from_camera) row[k] = 0.0 - row[k];
}

void turn_row(Pose& camera_from_world, std::size_t i) {
  for (double& entry : camera_from_world[i]) entry = 0.0 - entry;
}

void require_finite(const Pose& pose, const std::string& where) {
  for (const auto& row : pose)
    for (const double entry : row)
      if (!std::isfinite(entry))
        throw InputError(where + ": the pose has a number that is not finite");
}

}  // namespace

ExactPose exact_pose(const Pose& pose, const std::string& where) {
  require_finite(pose, where);
  return exact_pose(pose);
}

ExactPose exact_inverse(const Pose& pose, const std::string& where) {
  require_finite(pose, where);
  const auto inverted = exact_inverse(pose);
  if (!inverted) throw InputError(where + ": the matrix is singular");
  return *inverted;
}

Pose camera_from_world(const Pose& pose, PoseDirection direction, CameraAxes axes,
                       const std::string& where) {
  require_finite(pose, where);
  Pose turned = pose;
  if (direction == PoseDirection::world_to_camera) {
    if (axes == CameraAxes::opengl)
      for (const std::size_t i : {1, 2}) turn_row(turned, i);
    return turned;
  }
  if (axes == CameraAxes::opengl)
    for (const std::size_t k : {1, 2}) turn_column(turned, k);
  return rounded_pose(exact_inverse(turned, where));
}

ImportedCamera placed(const ImportedCamera& lens, const NamedPose& pose, PoseDirection direction,
                      CameraAxes axes, const std::string& where) {
  ImportedCamera result = lens;
  result.camera.name = pose.name;
  if (!lens.fault.empty()) return result;
  try {
    result.camera.world_to_camera = camera_from_world(pose.pose, direction, axes, where);
    if (const auto fault = find_fault(result.camera)) result.fault = where + ": " + *fault;
  } catch (const InputError& error) {
    result.fault = error.what();
  }
  return result;
}

void require_different_names(const std::vector<ImportedCamera>& cameras, const std::string& input) {
  std::unordered_set<std::string_view> names;
  for (const ImportedCamera& one : cameras)
    if (!names.insert(one.camera.name).second)
      throw InputError(input + ": two images have the name '" + text::printable(one.camera.name) +
                       "'");
}

Pose pose_of_numbers(const std::vector<double>& numbers, const std::string& where) {
  if (numbers.size() != 12 && numbers.size() != 16)
    throw InputError(where + ": expected a matrix of 3 or 4 rows of 4 numbers, found " +
                     std::to_string(numbers.size()) + " numbers");
  if (numbers.size() == 16 &&
      !std::equal(numbers.begin() + 12, numbers.end(), std::array<double, 4>{0, 0, 0, 1}.begin()) &&
      std::all_of(numbers.begin() + 12, numbers.end(), [](double x) { return std::isfinite(x); }))
    throw InputError(where + ": expected the last row to be 0 0 0 1");
  Pose pose;
  for (std::size_t i = 0; i < 12; ++i) pose[i / 4][i % 4] = numbers[i];
  return pose;
}

Pose parse_matrix(const text::JsonValue& matrix) {
  const auto rows = matrix.elements();
  if (rows.size() != 3 && rows.size() != 4)
    matrix.fail("expected a 4×4 matrix, found " + text::counted(rows.size(), "row"));
  std::vector<double> numbers;
  for (const text::JsonValue& each : rows) {
    const auto row = each.numbers(4);
    numbers.insert(numbers.end(), row.begin(), row.end());
  }
  return pose_of_numbers(numbers, matrix.where());
}

Pose parse_pose(std::string_view text, const std::string& name) {
  std::vector<double> numbers;
  for (Line& line : lines_of(text, name)) {
    const std::vector<double> row = rest_of(line);
    if (row.size() != 4)
      throw InputError(line.where + ": expected a row of 4 numbers, found " +
                       std::to_string(row.size()));
    numbers.insert(numbers.end(), row.begin(), row.end());
  }
  return pose_of_numbers(numbers, name);
}

std::vector<fs::path> files_of(const fs::path& folder, const std::string& suffix) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (at->path().filename().string().ends_with(suffix)) files.push_back(at->path());
  if (error) throw InputError(folder.string() + ": " + error.message());
  if (files.empty())
    throw InputError(folder.string() + ": has no file whose name ends with " + suffix);
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace fathom::camera
