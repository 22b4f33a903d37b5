#include "fathom/mesh_files/read_gltf.h"

#include <map>
#include <set>
#include <string>
#include <string_view>

#include "fathom/mesh_files/gltf_accessor.h"
#include "fathom/mesh_files/gltf_buffers.h"
#include "fathom/mesh_files/gltf_primitives.h"
#include "fathom/mesh_files/gltf_references.h"
#include "fathom/mesh_files/named_files.h"
#include "fathom/numeric/certified.h"
#include "fathom/numeric/errors.h"
#include "fathom/text/sha256.h"

namespace fathom::mesh_files {
using namespace text;

namespace {

/// Nodes are visited recursively, and transforms grow with every level.
constexpr int deepest_node = 200;

void check_version(const JsonValue& root) {
  const JsonValue version = root.at("asset").at("version");
  if (!version.string().starts_with("2."))
    version.fail("expected glTF 2, found " + version.string());
}

/// Required extensions that change how things look, but not where they are.
void check_required_extensions(const JsonValue& root) {
  static const std::set<std::string_view> harmless{
      "KHR_texture_transform", "KHR_texture_basisu", "KHR_lights_punctual", "KHR_xmp_json_ld",
      "EXT_texture_webp",      "EXT_texture_avif",   "MSFT_texture_dds"};
  const auto required = root.find("extensionsRequired");
  if (!required) return;
  for (const JsonValue& extension : required->elements())
    if (!harmless.contains(extension.string()) && !extension.string().starts_with("KHR_materials_"))
      extension.fail("the required extension " + extension.string() + " is not supported");
}

using Transform = WorldFromMesh;

bool is_identity(const Transform& transform) {
  const Transform identity;
  return transform.rows == identity.rows;
}

/// Sixteen numbers, column by column.
Transform read_matrix(const JsonValue& value) {
  const auto m = value.numbers(16);
  if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1)
    value.fail("expected the last row of the matrix to be 0 0 0 1");
  Transform transform;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 4; ++k) transform.rows[i][k] = m[4 * k + i];
  return transform;
}

/// T·R·S, R being the polynomial matrix of the quaternion (x, y, z, w), whatever its length.
Transform read_parts(const JsonValue& node) {
  const auto numbers = [&](const char* key, const std::vector<double>& otherwise) {
    const auto value = node.find(key);
    return value ? value->numbers(otherwise.size()) : otherwise;
  };
  const auto t = numbers("translation", {0, 0, 0});
  const auto q = numbers("rotation", {0, 0, 0, 1});
  const auto s = numbers("scale", {1, 1, 1});
  const Dyadic x = q[0], y = q[1], z = q[2], w = q[3], one = 1.0;
  const auto twice = [](const Dyadic& a) { return a + a; };
  const std::array<ExactVector3, 3> R{
      {{one - twice(y * y + z * z), twice(x * y - w * z), twice(x * z + w * y)},
       {twice(x * y + w * z), one - twice(x * x + z * z), twice(y * z - w * x)},
       {twice(x * z - w * y), twice(y * z + w * x), one - twice(x * x + y * y)}}};
  Transform transform;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) transform.rows[i][k] = R[i][k] * s[k];
    transform.rows[i][3] = t[i];
  }
  return transform;
}

Transform read_transform(const JsonValue& node) {
  const auto matrix = node.find("matrix");
  if (!matrix) return read_parts(node);
  for (const char* key : {"translation", "rotation", "scale"})
    if (const auto part = node.find(key)) part->fail("stands beside a matrix, expected only one");
  return read_matrix(*matrix);
}

/// Walks the nodes of an asset and places their meshes.
class GltfReader {
 public:
  GltfReader(const JsonValue& root, GltfPrimitives primitives, std::string file, Warnings& warnings)
      : root_(root),
        primitives_(std::move(primitives)),
        file_(std::move(file)),
        warnings_(warnings) {
    if (const auto nodes = root.find("nodes")) nodes_ = nodes->elements();
    if (const auto meshes = root.find("meshes")) meshes_ = meshes->elements();
    visited_.resize(nodes_.size());
  }

  GltfAsset read() {
    for (const std::size_t node : root_nodes()) visit(node, Transform(), 0);
    warn("skin", skins_, "the vertices are taken as the mesh has them");
    warn("morph targets", morphs_, "the vertices are taken as the mesh has them");
    primitives_.report(file_, warnings_);
    return std::move(asset_);
  }

 private:
  void warn(const std::string& what, std::uint64_t count, const std::string& then) {
    if (count > 0)
      warnings_.push_back(file_ + ": " + std::to_string(count) +
                          (count == 1 ? " node has " : " nodes have ") + what + "; " + then);
  }

  std::vector<std::size_t> root_nodes() {
    const auto scenes = root_.find("scenes");
    if (!scenes || scenes->elements().empty()) return parentless_nodes();
    const auto chosen = root_.find("scene");
    const std::uint64_t index = chosen ? chosen->integer(0, largest_integer) : 0;
    if (index >= scenes->size()) chosen->fail("there is no scene " + std::to_string(index));
    const auto nodes = scenes->element(index).find("nodes");
    return nodes ? node_indices(*nodes) : std::vector<std::size_t>();
  }

  /// An asset without scenes is a library of its nodes: all are taken.
  std::vector<std::size_t> parentless_nodes() {
    std::vector<bool> has_parent(nodes_.size());
    for (const JsonValue& node : nodes_)
      if (const auto children = node.find("children"))
        for (const std::size_t child : node_indices(*children)) has_parent[child] = true;
    std::vector<std::size_t> roots;
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      if (!has_parent[i]) roots.push_back(i);
    if (!nodes_.empty())
      warnings_.push_back(file_ + ": the asset has no scene; all its nodes are taken");
    return roots;
  }

  [[nodiscard]] std::vector<std::size_t> node_indices(const JsonValue& list) const {
    std::vector<std::size_t> indices;
    for (const JsonValue& reference : list.elements()) {
      const std::uint64_t index = reference.integer(0, largest_integer);
      if (index >= nodes_.size()) reference.fail("there is no node " + std::to_string(index));
      indices.push_back(index);
    }
    return indices;
  }

  void visit(std::size_t index, const Transform& world_from_parent, int depth) {
    const JsonValue& node = nodes_[index];
    if (depth > deepest_node)
      node.fail("nodes are nested more than " + std::to_string(deepest_node) + " deep");
    if (visited_[index]) node.fail("the node is reached twice: a cycle, or two parents");
    visited_[index] = true;
    const Transform world_from_node = compose(world_from_parent, read_transform(node));
    if (const auto mesh = node.find("mesh")) place(node, index, *mesh, world_from_node);
    if (const auto children = node.find("children"))
      for (const std::size_t child : node_indices(*children))
        visit(child, world_from_node, depth + 1);
  }

  void place(const JsonValue& node, std::size_t node_index, const JsonValue& reference,
             const Transform& world_from_node) {
    const std::uint64_t index = reference.integer(0, largest_integer);
    if (index >= meshes_.size()) reference.fail("there is no mesh " + std::to_string(index));
    const JsonValue& mesh = meshes_[index];
    const auto known = read_meshes_.find(index);
    if (known == read_meshes_.end()) {
      read_meshes_.emplace(index, asset_.meshes.size());
      asset_.meshes.push_back(primitives_.read(mesh));
    }
    Object object;
    object.mesh = read_meshes_.at(index);
    object.world_from_mesh = world_from_node;
    object.placed_as_is = is_identity(world_from_node);
    object.name = name_of(node, node_index, mesh);
    object.first_face = next_face_;
    next_face_ += asset_.meshes[object.mesh].face_count;
    if (next_face_ > no_index) node.fail("the asset has more than 4294967294 triangles");
    asset_.objects.push_back(std::move(object));
    skins_ += node.find("skin") ? 1 : 0;
    morphs_ += mesh.find("weights") || node.find("weights") ? 1 : 0;
  }

  static std::string name_of(const JsonValue& node, std::size_t index, const JsonValue& mesh) {
    if (const auto name = node.find("name"); name && !name->string().empty()) return name->string();
    if (const auto name = mesh.find("name"); name && !name->string().empty()) return name->string();
    return "node " + std::to_string(index);
  }

  JsonValue root_;
  GltfPrimitives primitives_;
  std::string file_;
  Warnings& warnings_;
  GltfAsset asset_;
  std::vector<JsonValue> nodes_;
  std::vector<JsonValue> meshes_;
  std::vector<bool> visited_;
  /// For each glTF mesh that has been read, its place among the asset's.
  std::map<std::uint64_t, std::size_t> read_meshes_;
  std::uint64_t next_face_ = 0;
  std::uint64_t skins_ = 0, morphs_ = 0;
};

}  // namespace

GltfAsset read_gltf(std::span<const std::byte> bytes, const std::filesystem::path& path,
                    const ReadOptions& options, Warnings& warnings) {
  const std::string file = path.string();
  const GltfContainer container = split_gltf(bytes, file);
  const JsonDocument document(container.json, file);
  const JsonValue root = document.root();
  check_version(root);
  check_required_extensions(root);
  GltfBuffers buffers(container, root, path, boundaries_of(options));
  GltfBufferViews views(root, buffers);
  GltfAccessors accessors(root, views, bytes.size());
  GltfAsset asset =
      GltfReader(root, GltfPrimitives(accessors, options.attributes), file, warnings).read();
  for (const auto& [name, contents] : buffers.external_files())
    asset.buffers.push_back({name.string(), options.hash ? sha256(contents) : std::string()});
  return asset;
}

}  // namespace fathom::mesh_files
