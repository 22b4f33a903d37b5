#include "fathom/camera/camera_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "fathom/camera/rounded_poses.h"
#include "fathom/files/input_file.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/json_text.h"
#include "fathom/text/json_value.h"

namespace fathom {
using namespace camera;
using namespace files;
using namespace text;

namespace {

ProjectionModel read_model(const JsonValue& value) {
  for (const auto model : {ProjectionModel::perspective, ProjectionModel::orthographic})
    if (value.string() == name_of(model)) return model;
  value.fail("expected \"perspective\" or \"orthographic\"");
}

/// Whether a matrix of 4 rows has the bottom row of an affine one in its last column.
bool looks_transposed(const std::array<std::vector<double>, 4>& rows) {
  return rows[0][3] == 0 && rows[1][3] == 0 && rows[2][3] == 0 && rows[3][3] == 1;
}

Pose read_pose(const JsonValue& value) {
  const std::vector<JsonValue> rows = value.elements();
  if (rows.size() != 3 && rows.size() != 4)
    value.fail("expected 3 rows (or 4, the last being 0 0 0 1), found " +
               std::to_string(rows.size()));
  std::array<std::vector<double>, 4> read{{{}, {}, {}, {0, 0, 0, 1}}};
  for (std::size_t i = 0; i < rows.size(); ++i) read[i] = rows[i].numbers(4);
  if (read[3] != std::vector<double>{0, 0, 0, 1}) {
    rows[3].fail(std::string("expected the last row of a 4×4 matrix to be 0 0 0 1") +
                 (looks_transposed(read) ? "; it is the last column: the matrix looks transposed, "
                                           "expected a list of its rows"
                                         : ""));
  }
  Pose pose;
  for (std::size_t i = 0; i < 3; ++i) std::ranges::copy(read[i], pose[i].begin());
  return pose;
}

Pose read_inverse_pose(const JsonValue& value) {
  const std::optional<Pose> pose = inverse(read_pose(value));
  if (!pose) value.fail("is singular: the determinant of its first three columns is exactly 0");
  for (const auto& row : *pose) {
    if (!std::ranges::all_of(row, [](double entry) { return std::isfinite(entry); }))
      value.fail("its inverse has an entry beyond the largest binary64 number");
  }
  return *pose;
}

/// Refuses an object with both keys.
void expect_either(const JsonValue& value, const char* one, const char* other) {
  if (value.find(one) && value.find(other)) {
    value.fail("has both \"" + std::string(one) + "\" and \"" + other + "\", expected one of them");
  }
}

void read_intrinsic_matrix(const JsonValue& value, Projection& projection) {
  const std::vector<JsonValue> rows = value.elements(3);
  const std::vector<double> u = rows[0].numbers(3), v = rows[1].numbers(3), w = rows[2].numbers(3);
  if (v[0] != 0) rows[1].fail("expected 0 in the first place of K's second row");
  if (w != std::vector<double>{0, 0, 1}) rows[2].fail("expected the last row of K to be 0 0 1");
  projection.fx = u[0], projection.skew = u[1], projection.cx = u[2];
  projection.fy = v[1], projection.cy = v[2];
}

void read_number(const JsonValue& value, const char* key, double& number) {
  if (const auto member = value.find(key)) number = member->number();
}

/// fx, fy, cx, cy and skew, or all of them as the matrix K.
void read_intrinsics_or_matrix(const JsonValue& value, Projection& projection) {
  for (const char* number : {"fx", "fy", "cx", "cy", "skew"}) expect_either(value, "K", number);
  if (const auto K = value.find("K")) return read_intrinsic_matrix(*K, projection);
  projection.fx = value.at("fx").number();
  projection.fy = value.at("fy").number();
  projection.cx = value.at("cx").number();
  projection.cy = value.at("cy").number();
  read_number(value, "skew", projection.skew);
}

Projection read_projection(const JsonValue& value) {
  Projection projection;
  if (const auto model = value.find("projection")) projection.model = read_model(*model);
  read_intrinsics_or_matrix(value, projection);
  expect_either(value, "pixel_centre", "pixel_center");
  read_number(value, "pixel_centre", projection.pixel_centre);
  read_number(value, "pixel_center", projection.pixel_centre);
  return projection;
}

void read_world_to_camera(const JsonValue& value, Camera& camera) {
  expect_either(value, "world_to_camera", "camera_to_world");
  const auto inverse = value.find("camera_to_world");
  camera.world_to_camera =
      inverse ? read_inverse_pose(*inverse) : read_pose(value.at("world_to_camera"));
}

bool says_pixel_centre(const JsonValue& value) {
  return value.find("pixel_centre") || value.find("pixel_center");
}

Camera read_camera(const JsonValue& value) {
  value.expect_only({"width", "height", "projection", "fx", "fy", "cx", "cy", "skew", "K",
                     "pixel_centre", "pixel_center", "world_to_camera", "camera_to_world", "near",
                     "far", "name"});
  constexpr auto largest_size = std::numeric_limits<std::uint32_t>::max();
  Camera camera;
  camera.width = static_cast<std::uint32_t>(value.at("width").integer(1, largest_size));
  camera.height = static_cast<std::uint32_t>(value.at("height").integer(1, largest_size));
  camera.projection = read_projection(value);
  read_world_to_camera(value, camera);
  read_number(value, "near", camera.near);
  if (const auto far = value.find("far"); far && !far->is_null()) camera.far = far->number();
  if (const auto name = value.find("name")) camera.name = name->string();
  if (const auto fault = find_fault(camera)) value.fail(*fault);
  return camera;
}

/// A zero keeps its sign only if it is written as a fraction.
std::string json_number(double number, Digits digits) {
  if (std::isinf(number)) return "null";
  if (number == 0) return std::signbit(number) ? "-0.0" : "0";
  return digits == Digits::fewest ? fmt::format("{}", number) : fmt::format("{:.17g}", number);
}

}  // namespace

std::vector<Camera> read_cameras(std::string_view text, const std::string& name,
                                 Warnings& warnings) {
  const StandardArithmetic standard;
  const JsonDocument document(text, name);
  const JsonValue root = document.root();
  const std::vector<JsonValue> values = root.is_list() ? root.elements() : std::vector{root};
  if (values.empty()) root.fail("the list of cameras is empty");
  std::vector<Camera> cameras;
  cameras.reserve(values.size());
  for (const JsonValue& value : values) cameras.push_back(read_camera(value));
  if (!std::ranges::all_of(values, says_pixel_centre)) {
    warnings.push_back(name +
                       ": does not say \"pixel_centre\", so that 0.5 is taken; write 0.5 (COLMAP, "
                       "OpenGL), or 0 if cx and cy are from OpenCV");
  }
  return cameras;
}

std::vector<Camera> read_cameras(const std::filesystem::path& file, Warnings& warnings) {
  const StandardArithmetic standard;
  return read_cameras(InputFile(file).text(), file.string(), warnings);
}

std::vector<Camera> read_cameras(std::string_view text, const std::string& name) {
  const StandardArithmetic standard;
  Warnings warnings;
  return read_cameras(text, name, warnings);
}

std::vector<Camera> read_cameras(const std::filesystem::path& file) {
  const StandardArithmetic standard;
  Warnings warnings;
  return read_cameras(file, warnings);
}

std::string to_json(const Camera& camera, Digits digits) {
  const StandardArithmetic standard;
  const auto number = [digits](double value) { return json_number(value, digits); };
  std::string text;
  const auto member = [&](const char* key, const std::string& value) {
    text += (text.empty() ? "{\n" : ",\n") + ("  \"" + std::string(key) + "\": ") + value;
  };
  if (!camera.name.empty()) member("name", json_string(camera.name));
  member("width", std::to_string(camera.width));
  member("height", std::to_string(camera.height));
  const Projection& projection = camera.projection;
  member("projection", json_string(name_of(projection.model)));
  member("fx", number(projection.fx));
  member("fy", number(projection.fy));
  member("cx", number(projection.cx));
  member("cy", number(projection.cy));
  member("skew", number(projection.skew));
  member("pixel_centre", number(projection.pixel_centre));
  std::string rows;
  for (const auto& [r0, r1, r2, t] : camera.world_to_camera)
    rows += (rows.empty() ? "[" : ",\n    [") + number(r0) + ", " + number(r1) + ", " + number(r2) +
            ", " + number(t) + "]";
  member("world_to_camera", "[\n    " + rows + "\n  ]");
  member("near", number(camera.near));
  member("far", number(camera.far));
  return text + "\n}";
}

std::string to_json(const std::vector<Camera>& cameras) {
  const StandardArithmetic standard;
  if (cameras.size() == 1) return to_json(cameras.front());
  std::string text = "[";
  for (const Camera& camera : cameras) text += (text == "[" ? "\n" : ",\n") + to_json(camera);
  return text + "\n]";
}

}  // namespace fathom
