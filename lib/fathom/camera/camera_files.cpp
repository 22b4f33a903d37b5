#include "fathom/camera/camera_files.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>

#include "fathom/numeric/errors.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/input_file.h"
#include "fathom/text/json_value.h"

namespace fathom {
using namespace text;

namespace {

Projection read_projection(const JsonValue& value) {
  if (value.string() == "perspective") return Projection::perspective;
  if (value.string() == "orthographic") return Projection::orthographic;
  value.fail("expected \"perspective\" or \"orthographic\"");
}

void read_matrix(const JsonValue& value, Camera& camera) {
  const std::vector<JsonValue> rows = value.elements();
  if (rows.size() != 3 && rows.size() != 4)
    value.fail("expected 3 rows (or 4, the last being 0 0 0 1), found " +
               std::to_string(rows.size()));
  for (std::size_t i = 0; i < 3; ++i) {
    const std::vector<double> row = rows[i].numbers(4);
    std::copy(row.begin(), row.end(), camera.world_to_camera[i].begin());
  }
  if (rows.size() == 4 && rows[3].numbers(4) != std::vector<double>{0, 0, 0, 1})
    rows[3].fail("expected the last row of a 4×4 matrix to be 0 0 0 1");
}

Camera read_camera(const JsonValue& value) {
  value.expect_only({"width", "height", "projection", "fx", "fy", "cx", "cy", "skew",
                     "pixel_centre", "world_to_camera", "near", "far"});
  constexpr auto largest_size = std::numeric_limits<std::uint32_t>::max();
  const auto optional_number = [&](const char* key, double& number) {
    if (const auto member = value.find(key)) number = member->number();
  };
  Camera camera;
  camera.width = static_cast<std::uint32_t>(value.at("width").integer(1, largest_size));
  camera.height = static_cast<std::uint32_t>(value.at("height").integer(1, largest_size));
  if (const auto projection = value.find("projection"))
    camera.projection = read_projection(*projection);
  camera.fx = value.at("fx").number();
  camera.fy = value.at("fy").number();
  camera.cx = value.at("cx").number();
  camera.cy = value.at("cy").number();
  optional_number("skew", camera.skew);
  optional_number("pixel_centre", camera.pixel_centre);
  read_matrix(value.at("world_to_camera"), camera);
  optional_number("near", camera.near);
  if (const auto far = value.find("far"); far && !far->is_null()) camera.far = far->number();
  if (const auto fault = find_fault(camera)) value.fail(*fault);
  return camera;
}

/// 17 significant digits: reading them back gives the same number bit for bit. A zero keeps its
/// sign only if it is written as a fraction.
std::string to_json(double number) {
  if (std::isinf(number)) return "null";
  if (number == 0) return std::signbit(number) ? "-0.0" : "0";
  char text[40];
  const auto end = std::to_chars(text, text + sizeof text, number, std::chars_format::general, 17);
  return {text, end.ptr};
}

}  // namespace

std::vector<Camera> read_cameras(std::string_view text, const std::string& name) {
  const StandardArithmetic standard;
  const JsonDocument document(text, name);
  const JsonValue root = document.root();
  if (!root.is_list()) return {read_camera(root)};
  std::vector<Camera> cameras;
  for (const JsonValue& element : root.elements()) cameras.push_back(read_camera(element));
  if (cameras.empty()) root.fail("the list of cameras is empty");
  return cameras;
}

std::vector<Camera> read_cameras(const std::filesystem::path& file) {
  return read_cameras(InputFile(file).text(), file.string());
}

std::string to_json(const Camera& camera) {
  std::string text;
  const auto member = [&](const char* key, const std::string& value) {
    text += (text.empty() ? "{\n" : ",\n") + ("  \"" + std::string(key) + "\": ") + value;
  };
  const bool perspective = camera.projection == Projection::perspective;
  member("width", std::to_string(camera.width));
  member("height", std::to_string(camera.height));
  member("projection", perspective ? "\"perspective\"" : "\"orthographic\"");
  member("fx", to_json(camera.fx));
  member("fy", to_json(camera.fy));
  member("cx", to_json(camera.cx));
  member("cy", to_json(camera.cy));
  member("skew", to_json(camera.skew));
  member("pixel_centre", to_json(camera.pixel_centre));
  std::string rows;
  for (const auto& [r0, r1, r2, t] : camera.world_to_camera)
    rows += (rows.empty() ? "[" : ",\n    [") + to_json(r0) + ", " + to_json(r1) + ", " +
            to_json(r2) + ", " + to_json(t) + "]";
  member("world_to_camera", "[\n    " + rows + "\n  ]");
  member("near", to_json(camera.near));
  member("far", to_json(camera.far));
  return text + "\n}";
}

std::string to_json(const std::vector<Camera>& cameras) {
  if (cameras.size() == 1) return to_json(cameras.front());
  std::string text = "[";
  for (const Camera& camera : cameras) text += (text == "[" ? "\n" : ",\n") + to_json(camera);
  return text + "\n]";
}

}  // namespace fathom
