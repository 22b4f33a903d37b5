#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "fathom/camera/posed_cameras.h"
#include "fathom/numeric/errors.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/byte_order.h"
#include "fathom/text/input_file.h"
#include "fathom/text/json_value.h"
#include "fathom/text/text_ends.h"

namespace fathom {
using namespace camera;
using text::JsonValue;

namespace {

/// Nodes above a camera are multiplied exactly, so that each makes the numbers longer.
constexpr std::size_t deepest_node = 64;

/// An exact affine map, all of it over one denominator.
struct ExactTransform {
  /// Columns of the linear part, then the translation.
  std::array<ExactVector3, 4> columns{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}, {}}};
  Dyadic denominator = 1.0;
};

/// outer · inner.
ExactTransform product(const ExactTransform& outer, const ExactTransform& inner) {
  ExactTransform result;
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t i = 0; i < 3; ++i) {
      Dyadic sum;
      for (std::size_t j = 0; j < 3; ++j) sum = sum + outer.columns[j][i] * inner.columns[k][j];
      if (k == 3) sum = sum + outer.columns[3][i] * inner.denominator;
      result.columns[k][i] = sum;
    }
  result.denominator = outer.denominator * inner.denominator;
  return result;
}

/// 16 numbers, column by column.
ExactTransform of_matrix(const JsonValue& matrix) {
  const auto m = matrix.numbers(16);
  if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1)
    matrix.fail("expected the last row to be 0 0 0 1");
  ExactTransform result;
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t i = 0; i < 3; ++i) result.columns[k][i] = m[4 * k + i];
  return result;
}

/// T·R·S; R of a quaternion x, y, z, w of any length but 0, over the square of its length.
ExactTransform of_parts(const JsonValue& node) {
  const auto numbers = [&](const char* key, const std::vector<double>& otherwise) {
    const auto value = node.find(key);
    return value ? value->numbers(otherwise.size()) : otherwise;
  };
  const auto t = numbers("translation", {0, 0, 0}), q = numbers("rotation", {0, 0, 0, 1}),
             s = numbers("scale", {1, 1, 1});
  const Dyadic x = q[0], y = q[1], z = q[2], w = q[3];
  const Dyadic n = w * w + x * x + y * y + z * z;
  if (n.is_zero()) node.fail("the rotation is zero");
  const auto twice = [](const Dyadic& a) { return a + a; };
  ExactTransform result;
  result.columns = {{{w * w + x * x - y * y - z * z, twice(x * y + w * z), twice(x * z - w * y)},
                     {twice(x * y - w * z), w * w - x * x + y * y - z * z, twice(y * z + w * x)},
                     {twice(x * z + w * y), twice(y * z - w * x), w * w - x * x - y * y + z * z},
                     {n * t[0], n * t[1], n * t[2]}}};
  for (std::size_t k = 0; k < 3; ++k)
    for (Dyadic& entry : result.columns[k]) entry = entry * s[k];
  result.denominator = n;
  return result;
}

ExactTransform transform_of(const JsonValue& node) {
  const auto matrix = node.find("matrix");
  return matrix ? of_matrix(*matrix) : of_parts(node);
}

/// The nodes of a file and which is above which.
class Nodes {
 public:
  explicit Nodes(const JsonValue& root) {
    if (const auto list = root.find("nodes")) nodes_ = list->elements();
    parents_.resize(nodes_.size());
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const auto children = nodes_[i].find("children");
      if (!children) continue;
      for (const JsonValue& child : children->elements()) {
        auto& parent = parents_[child.integer(0, nodes_.size() - 1)];
        if (parent) child.fail("the node is a child of two nodes");
        parent = i;
      }
    }
  }

  [[nodiscard]] const std::vector<JsonValue>& all() const { return nodes_; }

  /// World from node.
  [[nodiscard]] ExactTransform world_from(std::size_t node) const {
    ExactTransform result = transform_of(nodes_[node]);
    std::size_t depth = 0;
    for (auto parent = parents_[node]; parent; parent = parents_[*parent]) {
      if (++depth == deepest_node)
        nodes_[node].fail("has more than " + std::to_string(deepest_node) + " nodes above it");
      result = product(transform_of(nodes_[*parent]), result);
    }
    return result;
  }

 private:
  std::vector<JsonValue> nodes_;
  std::vector<std::optional<std::size_t>> parents_;
};

/// The view of a node: its scale is ignored, as glTF says, so that the axes are the unit vectors of
/// its columns, of OpenGL's directions, each rounded once; the eye is rounded once, too.
Matrix34 view_of(const ExactTransform& world_from_node, const JsonValue& node) {
  const auto& [right, up, back, eye] = world_from_node.columns;
  for (const ExactVector3& axis : {right, up, back})
    if (dot(axis, axis).is_zero()) node.fail("its transform is singular");
  const auto turned = [](const ExactVector3& v) { return ExactVector3{-v[0], -v[1], -v[2]}; };
  const Matrix3 R{unit_vector(right), unit_vector(turned(up)), unit_vector(turned(back))};
  ExactVector3 rounded_eye;
  for (std::size_t i = 0; i < 3; ++i)
    rounded_eye[i] = round_to_binary64(Ratio(eye[i], world_from_node.denominator));
  return pose_that_takes(R, rounded_eye, {});
}

void read_perspective(const JsonValue& lens, Camera& camera) {
  const JsonValue yfov = lens.at("yfov");
  if (!(yfov.number() > 0 && yfov.number() < std::numbers::pi))
    yfov.fail("expected an angle in radians between 0 and π");
  camera.fx = camera.fy = focal_of_angle(camera.height, yfov.number());
  const auto aspect = lens.find("aspectRatio");
  if (!aspect) return;
  const double ratio = aspect->number();
  if (!(std::abs(ratio * camera.height - camera.width) <= 1))
    aspect->fail("the aspect ratio " + std::to_string(ratio) + " is not that of an image of " +
                 std::to_string(camera.width) + "x" + std::to_string(camera.height) +
                 "; give a size that has it");
}

/// fx = ½·width / xmag, and so on.
void read_orthographic(const JsonValue& lens, Camera& camera) {
  camera.projection = Projection::orthographic;
  const auto pixels_per_unit = [&](const char* key, std::uint32_t size) {
    const JsonValue half = lens.at(key);
    if (half.number() == 0) half.fail("is 0, expected any other number");
    return round_to_binary64(Ratio(Dyadic(size / 2.0), Dyadic(half.number())));
  };
  camera.fx = pixels_per_unit("xmag", camera.width);
  camera.fy = pixels_per_unit("ymag", camera.height);
}

void read_lens(const JsonValue& definition, Camera& camera) {
  const JsonValue type = definition.at("type");
  const std::string& name = type.string();
  if (name != "perspective" && name != "orthographic")
    type.fail("expected \"perspective\" or \"orthographic\"");
  const JsonValue lens = definition.at(name);
  camera.cx = camera.width / 2.0;
  camera.cy = camera.height / 2.0;
  if (name == "perspective")
    read_perspective(lens, camera);
  else
    read_orthographic(lens, camera);
  camera.near = lens.at("znear").number();
  if (const auto far = lens.find("zfar")) camera.far = far->number();
}

/// The node's name, else its camera's, else "node N".
std::string name_of(const JsonValue& node, const JsonValue& definition, std::size_t number) {
  for (const JsonValue& named : {node, definition})
    if (const auto name = named.find("name"); name && !name->string().empty())
      return name->string();
  return "node " + std::to_string(number);
}

/// The JSON of a .gltf, or that in a .glb.
std::string_view json_of(std::string_view bytes, const std::string& name) {
  if (!bytes.starts_with("glTF")) return bytes;
  const auto number_at = [&](std::size_t at) {
    return load<std::uint32_t>(reinterpret_cast<const std::byte*>(bytes.data()) + at,
                               std::endian::little);
  };
  constexpr std::size_t before_json = 20;
  if (bytes.size() < before_json || number_at(4) != 2 ||
      number_at(12) > bytes.size() - before_json || bytes.substr(16, 4) != "JSON")
    throw InputError(name + ": not a GLB file of glTF 2.0, or truncated");
  return text::without_zeros(bytes.substr(before_json, number_at(12)));
}

}  // namespace

std::vector<ImportedCamera> camera::parse_gltf_cameras(std::string_view bytes,
                                                       const std::string& name, std::uint32_t width,
                                                       std::uint32_t height) {
  const text::JsonDocument document(json_of(bytes, name), name);
  const JsonValue root = document.root();
  const Nodes nodes(root);
  const auto list = root.find("cameras");
  const std::vector<JsonValue> definitions = list ? list->elements() : std::vector<JsonValue>{};
  std::vector<ImportedCamera> cameras;
  for (std::size_t i = 0; i < nodes.all().size(); ++i) {
    const JsonValue& node = nodes.all()[i];
    const auto index = node.find("camera");
    if (!index) continue;
    if (definitions.empty()) index->fail("the file has no cameras");
    const JsonValue& definition = definitions[index->integer(0, definitions.size() - 1)];
    cameras.push_back(
        imported_camera(name_of(node, definition, i), node.where(), [&](ImportedCamera& one) {
          one.camera.width = width;
          one.camera.height = height;
          read_lens(definition, one.camera);
          one.camera.world_to_camera = view_of(nodes.world_from(i), node);
        }));
  }
  if (cameras.empty()) root.fail("no node has a camera");
  require_different_names(cameras, name);
  return cameras;
}

std::vector<ImportedCamera> import_gltf(const std::filesystem::path& file, std::uint32_t width,
                                        std::uint32_t height) {
  const StandardArithmetic standard;
  return parse_gltf_cameras(text::InputFile(file).text(), file.string(), width, height);
}

}  // namespace fathom
