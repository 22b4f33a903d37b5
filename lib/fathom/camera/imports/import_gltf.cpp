#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "fathom/camera/imports/lines_and_poses.h"
#include "fathom/camera/rounded_angles.h"
#include "fathom/failures/errors.h"
#include "fathom/files/byte_order.h"
#include "fathom/files/input_file.h"
#include "fathom/gltf/gltf_placement.h"
#include "fathom/numeric/certified.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/json_value.h"
#include "fathom/text/text_ends.h"

namespace fathom {
using namespace camera;
using namespace gltf;
using text::JsonValue;

namespace {

/// Nodes above a camera are multiplied exactly, so that each makes the numbers longer.
constexpr std::size_t deepest_node = 64;

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
  [[nodiscard]] WorldFromMesh world_from(std::size_t node) const {
    WorldFromMesh result = read_transform_of_node(nodes_[node]);
    std::size_t depth = 0;
    for (auto parent = parents_[node]; parent; parent = parents_[*parent]) {
      if (++depth == deepest_node)
        nodes_[node].fail("has more than " + std::to_string(deepest_node) + " nodes above it");
      result = compose(read_transform_of_node(nodes_[*parent]), result);
    }
    return result;
  }

 private:
  std::vector<JsonValue> nodes_;
  std::vector<std::optional<std::size_t>> parents_;
};

/// The view of a node. As glTF requires, the scale is ignored.
Pose view_of(const WorldFromMesh& world_from_node, const JsonValue& node) {
  const auto column = [&](std::size_t k) {
    const auto& rows = world_from_node.rows;
    return ExactVector3{rows[0][k], rows[1][k], rows[2][k]};
  };
  const auto view = view_along({column(0), column(1), column(2)}, column(3));
  if (!view) node.fail("its transform is singular");
  return *view;
}

void read_perspective(const JsonValue& lens, Camera& camera) {
  const JsonValue yfov = lens.at("yfov");
  if (!(yfov.number() > 0 && yfov.number() < std::numbers::pi))
    yfov.fail("expected an angle in radians between 0 and π");
  camera.projection.fx = camera.projection.fy = focal_of_radians(camera.height, yfov.number());
  const auto aspect = lens.find("aspectRatio");
  if (!aspect) return;
  const double ratio = aspect->number();
  if (!(std::abs(ratio * camera.height - camera.width) <= 1))
    aspect->fail("the aspect ratio " + std::to_string(ratio) + " does not match an image of " +
                 std::to_string(camera.width) + "x" + std::to_string(camera.height) +
                 "; give a size with this ratio");
}

/// fx = ½·width / xmag, and so on.
void read_orthographic(const JsonValue& lens, Camera& camera) {
  camera.projection.model = ProjectionModel::orthographic;
  const auto pixels_per_unit = [&](const char* key, std::uint32_t size) {
    const JsonValue half = lens.at(key);
    if (half.number() == 0) half.fail("is 0, expected any other number");
    return round_to_binary64(Ratio(Dyadic(size / 2.0), Dyadic(half.number())));
  };
  camera.projection.fx = pixels_per_unit("xmag", camera.width);
  camera.projection.fy = pixels_per_unit("ymag", camera.height);
}

void read_lens(const JsonValue& definition, Camera& camera) {
  const JsonValue type = definition.at("type");
  const std::string& name = type.string();
  if (name != "perspective" && name != "orthographic")
    type.fail("expected \"perspective\" or \"orthographic\"");
  const JsonValue lens = definition.at(name);
  camera.projection.cx = camera.width / 2.0;
  camera.projection.cy = camera.height / 2.0;
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
  return parse_gltf_cameras(files::InputFile(file).text(), file.string(), width, height);
}

}  // namespace fathom
