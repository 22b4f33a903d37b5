#include "fathom/camera/camera_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "fathom/camera/lens.h"
#include "fathom/camera/pose.h"
#include "fathom/files/input_file.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/json_text.h"
#include "fathom/text/json_value.h"

// The keys that say how a camera projects.
namespace fathom::camera {
using text::JsonValue;

namespace {

/// Refuses an object with both keys.
void expect_either(const JsonValue& value, std::string_view one, std::string_view other) {
  const std::string first(one), second(other);
  if (value.find(first) && value.find(second))
    value.fail("has both \"" + first + "\" and \"" + second + "\", expected one of them");
}

/// Sets a number if its key is there.
void read_number(const JsonValue& value, std::string_view key, double& number) {
  if (const auto member = value.find(std::string(key))) number = member->number();
}

void read_intrinsic_matrix(const JsonValue& value, Projection& projection) {
  const std::vector<JsonValue> rows = value.elements(3);
  const std::vector<double> u = rows[0].numbers(3), v = rows[1].numbers(3), w = rows[2].numbers(3);
  if (v[0] != 0) rows[1].fail("expected 0 in the first place of K's second row");
  if (w != std::vector<double>{0, 0, 1}) rows[2].fail("expected the last row of K to be 0 0 1");
  projection.fx = u[0], projection.skew = u[1], projection.cx = u[2];
  projection.fy = v[1], projection.cy = v[2];
}

const LensModelEntry& model_of(const JsonValue& value) {
  const JsonValue name = value.at("model");
  if (const auto model = lens_model_named(name.string())) return entry_of(*model);
  name.fail(unknown_lens_model(name.string()));
}

/// Sets fx, fy, cx and cy from the model's own numbers in their order.
void set_intrinsics(const LensModelEntry& model, std::vector<double>::const_iterator number,
                    Projection& projection) {
  projection.fx = *number++;
  projection.fy = has_one_focal_length(model) ? projection.fx : *number++;
  projection.cx = *number++;
  projection.cy = *number;
}

/// The middle of w × h pixels, where a panorama of both has no cx and cy.
void add_default_centre(const LensModelEntry& model, std::vector<double>& numbers) {
  if (model.model == LensModel::equirectangular && numbers.size() == 2)
    numbers.insert(numbers.end(), {numbers[0] / 2, numbers[1] / 2});
}

std::vector<double> numbers_of(const JsonValue& list) {
  std::vector<double> numbers;
  for (const JsonValue& element : list.elements()) numbers.push_back(element.number());
  return numbers;
}

/// Refuses a list that has not one of the model's counts of distortion behind `before` numbers.
void require_count(const JsonValue& list, const LensModelEntry& model, std::size_t found,
                   std::size_t before) {
  if (const auto fault = distortion_count_fault(model, found, before)) list.fail(*fault);
}

void read_parameters(const JsonValue& value, const LensModelEntry& model, Projection& projection) {
  const JsonValue list = value.at("params");
  std::vector<double> numbers = numbers_of(list);
  add_default_centre(model, numbers);
  const std::size_t before = model.intrinsics.size();
  require_count(list, model, numbers.size(), before);
  set_intrinsics(model, numbers.begin(), projection);
  std::copy(numbers.begin() + static_cast<std::ptrdiff_t>(before), numbers.end(),
            projection.lens->distortion.begin());
}

/// fx, fy, cx, cy and skew, or all of them as the matrix K.
void read_intrinsics(const JsonValue& value, Projection& projection) {
  for (const char* number : {"fx", "fy", "cx", "cy", "skew"}) expect_either(value, "K", number);
  if (const auto K = value.find("K")) return read_intrinsic_matrix(*K, projection);
  projection.fx = value.at("fx").number();
  projection.fy = value.at("fy").number();
  projection.cx = value.at("cx").number();
  projection.cy = value.at("cy").number();
  read_number(value, "skew", projection.skew);
}

void read_intrinsics_of_lens(const JsonValue& value, const LensModelEntry& model,
                             Projection& projection) {
  if (has_two_focal_lengths(model)) return read_intrinsics(value, projection);
  for (const std::string_view name : model.intrinsics) expect_either(value, "K", name);
  if (const auto K = value.find("K")) {
    return read_intrinsic_matrix(*K, projection);
  }
  const bool is_centred =
      model.model == LensModel::equirectangular && !value.find("cx") && !value.find("cy");
  std::vector<double> numbers;
  for (const std::string_view name :
       model.intrinsics.first(is_centred ? 2 : model.intrinsics.size()))
    numbers.push_back(value.at(std::string(name)).number());
  add_default_centre(model, numbers);
  set_intrinsics(model, numbers.begin(), projection);
}

/// The keys that are allowed with the lens model of the key `model`, including `model`, without
/// pixel_centre.
/// Fails    InputError for an unknown model.
std::vector<std::string_view> keys_of_lens(const JsonValue& value) {
  const LensModelEntry& model = model_of(value);
  if (model.model == LensModel::table)
    return {"model", "directions", "directions_sha256", "max_radius", "origins", "row_poses"};
  std::vector<std::string_view> keys{"model", "params"};
  if (!is_panorama(model.model)) keys.insert(keys.end(), {"K", "distortion"});
  keys.emplace_back("max_radius");
  keys.insert(keys.end(), model.intrinsics.begin(), model.intrinsics.end());
  if (has_two_focal_lengths(model)) keys.emplace_back("skew");
  keys.insert(keys.end(), model.distortion.begin(), model.distortion.end());
  return keys;
}

/// Whether the key `model` is TABLE.
bool is_table(const JsonValue& value) {
  return value.find("model") && model_of(value).model == LensModel::table;
}

/// The lens of the model TABLE, for an image of this size. Without a reader the table is only
/// named.
void read_table(const JsonValue& value, std::uint32_t width, std::uint32_t height,
                const DirectionReader& directions, Projection& projection) {
  for (const char* later : {"origins", "row_poses"}) {
    if (const auto key = value.find(later))
      key->fail("not supported yet: all rays of a table begin at the eye of the camera");
  }
  Lens& lens = projection.lens.emplace(Lens{LensModel::table});
  read_number(value, "max_radius", lens.max_radius);
  const JsonValue file = value.at("directions");
  const auto expected = value.find("directions_sha256");
  if (!directions || file.is_null()) {
    lens.directions = std::make_shared<const DirectionTable>(
        DirectionTable::unread({.path = file.is_null() ? "" : file.string(),
                                .sha256 = expected ? expected->string() : "",
                                .reader = ""}));
    return;
  }
  lens.directions = directions(file.string(), width, height);
  if (expected && expected->string() != lens.directions->sha256()) {
    expected->fail("the file '" + file.string() + "' has the SHA-256 " + lens.directions->sha256() +
                   ", expected " + expected->string());
  }
}

/// Any other lens: the key `model`, and its parameters: each by its name (missing parameters of
/// distortion are 0), or all of them in the list `params`, or K with the list `distortion`.
void read_lens(const JsonValue& value, Projection& projection) {
  const LensModelEntry& model = model_of(value);
  Lens& lens = projection.lens.emplace(Lens{model.model});
  if (const auto radius = value.find("max_radius")) lens.max_radius = radius->number();
  for (const char* one : {"params", "distortion"})
    for (const std::string_view name : model.distortion) expect_either(value, one, name);
  expect_either(value, "params", "distortion");
  if (value.find("params")) {
    for (const std::string_view name : model.intrinsics) expect_either(value, "params", name);
    expect_either(value, "params", "K");
    read_parameters(value, model, projection);
    if (has_two_focal_lengths(model)) read_number(value, "skew", projection.skew);
    return;
  }
  read_intrinsics_of_lens(value, model, projection);
  if (const auto list = value.find("distortion")) {
    const std::vector<double> numbers = numbers_of(*list);
    require_count(*list, model, numbers.size(), 0);
    std::ranges::copy(numbers, lens.distortion.begin());
    return;
  }
  for (std::size_t i = 0; i < model.distortion.size(); ++i)
    read_number(value, model.distortion[i], lens.distortion[i]);
}

}  // namespace
}  // namespace fathom::camera

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

void read_pixel_centre(const JsonValue& value, Projection& projection) {
  expect_either(value, "pixel_centre", "pixel_center");
  read_number(value, "pixel_centre", projection.pixel_centre);
  read_number(value, "pixel_center", projection.pixel_centre);
}

/// Needs a camera with its size.
Projection read_projection(const JsonValue& value, const Camera& camera,
                           const DirectionReader& directions) {
  Projection projection;
  if (const auto model = value.find("projection")) projection.model = read_model(*model);
  if (value.find("model")) {
    if (is_orthographic(projection))
      value.at("projection").fail("an orthographic camera has no lens");
    if (is_table(value)) {
      read_table(value, camera.width, camera.height, directions, projection);
      return projection;
    }
    read_lens(value, projection);
  } else {
    read_intrinsics(value, projection);
  }
  read_pixel_centre(value, projection);
  return projection;
}

void read_world_to_camera(const JsonValue& value, Camera& camera) {
  expect_either(value, "world_to_camera", "camera_to_world");
  const auto inverse = value.find("camera_to_world");
  camera.world_to_camera =
      inverse ? read_inverse_pose(*inverse) : read_pose(value.at("world_to_camera"));
}

/// The keys of a pinhole or orthographic camera, or the keys of a lens.
void expect_known_keys(const JsonValue& value) {
  std::vector<std::string_view> known{"width", "height", "projection"};
  if (value.find("model")) {
    const std::vector<std::string_view> of_lens = keys_of_lens(value);
    known.insert(known.end(), of_lens.begin(), of_lens.end());
  } else {
    known.insert(known.end(), {"fx", "fy", "cx", "cy", "skew", "K", "model"});
  }
  if (!is_table(value)) known.insert(known.end(), {"pixel_centre", "pixel_center"});
  known.insert(known.end(), {"world_to_camera", "camera_to_world", "near", "far", "name"});
  value.expect_only(known);
}

bool says_pixel_centre(const JsonValue& value) {
  return value.find("pixel_centre") || value.find("pixel_center") || is_table(value);
}

bool directions_are_unread(const Camera& camera) {
  const std::optional<Lens>& lens = camera.projection.lens;
  return lens && lens->directions && !lens->directions->is_read();
}

/// The fault of a camera whose table of directions may only be named.
std::optional<std::string> fault_but_of_unread_directions(const Camera& camera) {
  if (!directions_are_unread(camera)) return find_fault(camera);
  Camera without_table = camera;
  without_table.projection.lens.reset();
  return find_fault(without_table);
}

Camera camera_of_json(const JsonValue& value, const DirectionReader& directions) {
  expect_known_keys(value);
  constexpr auto largest_size = std::numeric_limits<std::uint32_t>::max();
  Camera camera;
  camera.width = static_cast<std::uint32_t>(value.at("width").integer(1, largest_size));
  camera.height = static_cast<std::uint32_t>(value.at("height").integer(1, largest_size));
  camera.projection = read_projection(value, camera, directions);
  read_world_to_camera(value, camera);
  read_number(value, "near", camera.near);
  if (const auto far = value.find("far"); far && !far->is_null()) camera.far = far->number();
  if (const auto name = value.find("name")) camera.name = name->string();
  if (const auto fault = fault_but_of_unread_directions(camera)) value.fail(*fault);
  return camera;
}

/// A zero keeps its sign only if it is written as a fraction.
std::string json_number(double number, Digits digits) {
  if (std::isinf(number)) return "null";
  if (number == 0) return std::signbit(number) ? "-0.0" : "0";
  return digits == Digits::fewest ? fmt::format("{}", number) : fmt::format("{:.17g}", number);
}

struct Intrinsic {
  const char* key;
  double Projection::*number;
};
constexpr std::array intrinsics{Intrinsic{"fx", &Projection::fx}, Intrinsic{"fy", &Projection::fy},
                                Intrinsic{"cx", &Projection::cx}, Intrinsic{"cy", &Projection::cy},
                                Intrinsic{"skew", &Projection::skew}};

/// The file of a table, and where it ends.
template <class Member, class Number>
void write_table(const Lens& lens, const Member& member, const Number& number) {
  const std::string& file = lens.directions->source().path;
  member("model", json_string(name_of(lens.model)));
  member("directions", file.empty() ? "null" : json_string(file));
  if (const std::string hash = lens.directions->sha256(); !hash.empty())
    member("directions_sha256", json_string(hash));
  if (std::isfinite(lens.max_radius)) member("max_radius", number(lens.max_radius));
}

/// The model, its parameters by their names, and where it ends.
template <class Member, class Number>
void write_lens(const Projection& projection, const Member& member, const Number& number) {
  const Lens& lens = *projection.lens;
  const LensModelEntry& model = entry_of(lens.model);
  member("model", json_string(model.name));
  const std::size_t skipped = has_one_focal_length(model) ? 1 : 0;  // fy
  for (std::size_t i = 0; i < model.intrinsics.size(); ++i)
    member(model.intrinsics[i], number(projection.*intrinsics[i == 0 ? 0 : i + skipped].number));
  if (has_two_focal_lengths(model)) member("skew", number(projection.skew));
  for (std::size_t i = 0; i < model.distortion.size(); ++i) {
    member(model.distortion[i], number(lens.distortion[i]));
  }
  if (std::isfinite(lens.max_radius)) member("max_radius", number(lens.max_radius));
}

}  // namespace

std::vector<Camera> read_cameras(std::string_view text, const std::string& name, Warnings& warnings,
                                 const DirectionReader& directions) {
  const StandardArithmetic standard;
  const JsonDocument document(text, name);
  const JsonValue root = document.root();
  const std::vector<JsonValue> values = root.is_list() ? root.elements() : std::vector{root};
  if (values.empty()) root.fail("the list of cameras is empty");
  std::vector<Camera> cameras;
  cameras.reserve(values.size());
  for (const JsonValue& value : values) cameras.push_back(camera_of_json(value, directions));
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
  const auto member = [&](std::string_view key, const std::string& value) {
    text += (text.empty() ? "{\n" : ",\n") + ("  \"" + std::string(key) + "\": ") + value;
  };
  if (!camera.name.empty()) member("name", json_string(camera.name));
  member("width", std::to_string(camera.width));
  member("height", std::to_string(camera.height));
  const Projection& projection = camera.projection;
  const bool has_table = projection.lens && projection.lens->directions;
  if (has_table) {
    write_table(*projection.lens, member, number);
  } else if (projection.lens) {
    write_lens(projection, member, number);
  } else {
    member("projection", json_string(name_of(projection.model)));
    for (const auto& [key, value] : intrinsics) member(key, number(projection.*value));
  }
  if (!has_table) member("pixel_centre", number(projection.pixel_centre));
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
