#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "fathom/files/sha256.h"
#include "fathom/gltf/gltf_placement.h"
#include "fathom/mesh_files/gltf/gltf_accessor.h"
#include "fathom/mesh_files/gltf/gltf_asset.h"
#include "fathom/mesh_files/gltf/gltf_buffers.h"
#include "fathom/mesh_files/gltf/gltf_primitives.h"
#include "fathom/mesh_files/read_mesh.h"
#include "fathom/text/counted.h"
#include "fathom/text/printable.h"

namespace fathom::mesh_files {
using namespace files;
using namespace gltf;
using namespace text;

namespace {

/// The places where a node shows its mesh, of the extension EXT_mesh_gpu_instancing.
/// Source   [EMGI19]
class GltfInstances {
 public:
  /// Nothing if the node has no such extension. No number has been read yet.
  /// Fails    InputError: attributes of other types, or of different lengths.
  static std::optional<GltfInstances> of(const JsonValue& node, GltfAccessors& accessors);

  [[nodiscard]] std::uint64_t count() const { return count_; }
  /// Each instance's transform is NODE·transform_of(placement). The parts of a quaternion that are
  /// stored as integers are rounded once.
  /// Fails    InputError: a number that is not finite.
  [[nodiscard]] std::vector<GltfPlacement> placements() const;

 private:
  std::shared_ptr<const GltfAccessor> translation_, rotation_, scale_;
  std::uint64_t count_ = 0;
};

void expect_floats(const GltfAccessor& accessor) {
  if (accessor.width() != 3 || accessor.component() != GltfComponent::float32)
    accessor.description().fail("expected translations and scales of instances in VEC3 of floats");
}

void expect_quaternions(const GltfAccessor& accessor) {
  const bool fractions = accessor.normalized() && (accessor.component() == GltfComponent::int8 ||
                                                   accessor.component() == GltfComponent::int16);
  if (accessor.width() != 4 || !(fractions || accessor.component() == GltfComponent::float32))
    accessor.description().fail(
        "expected rotations of instances in VEC4 of floats, or of normalized bytes or shorts");
}

template <std::size_t size>
void read_parts(const GltfAccessor* accessor, std::vector<GltfPlacement>& placements,
                std::array<double, size> GltfPlacement::*part) {
  if (accessor == nullptr) return;
  accessor->for_each_finite([&](std::uint64_t i, const GltfAccessor::Element& numbers) {
    std::copy_n(numbers.begin(), size, (placements[i].*part).begin());
  });
}

std::optional<GltfInstances> GltfInstances::of(const JsonValue& node, GltfAccessors& accessors) {
  const auto extensions = node.find("extensions");
  if (!extensions) return std::nullopt;
  const auto extension = extensions->find("EXT_mesh_gpu_instancing");
  if (!extension) return std::nullopt;
  const JsonValue attributes = extension->at("attributes");
  GltfInstances result;
  const auto open = [&](const char* key, auto expect) -> std::shared_ptr<const GltfAccessor> {
    const auto reference = attributes.find(key);
    if (!reference) return nullptr;
    auto accessor = accessors.at(*reference);
    expect(*accessor);
    if ((result.translation_ || result.rotation_) && accessor->count() != result.count_)
      reference->fail("has " + text::counted(accessor->count(), "element") + ", expected " +
                      std::to_string(result.count_) + " as the others have");
    result.count_ = accessor->count();
    return accessor;
  };
  result.translation_ = open("TRANSLATION", expect_floats);
  result.rotation_ = open("ROTATION", expect_quaternions);
  result.scale_ = open("SCALE", expect_floats);
  if (!result.translation_ && !result.rotation_ && !result.scale_)
    attributes.fail("expected TRANSLATION, ROTATION or SCALE");
  return result;
}

std::vector<GltfPlacement> GltfInstances::placements() const {
  std::vector<GltfPlacement> result(count_);
  read_parts(translation_.get(), result, &GltfPlacement::translation);
  read_parts(rotation_.get(), result, &GltfPlacement::rotation);
  read_parts(scale_.get(), result, &GltfPlacement::scale);
  return result;
}

/// Nodes are visited recursively, and transforms grow with every level.
constexpr int deepest_node = 200;

void check_version(const JsonValue& root) {
  const JsonValue version = root.at("asset").at("version");
  if (!version.string().starts_with("2."))
    version.fail("expected glTF 2, found " + printable(version.string().substr(0, 20)));
}

/// Walks the nodes of an asset and places their meshes.
class GltfReader {
 public:
  GltfReader(const JsonValue& root, GltfAccessors& accessors, const ReadOptions& options,
             std::string file, Warnings& warnings)
      : root_(root),
        accessors_(accessors),
        materials_(root),
        primitives_(accessors, options.segments ? &materials_ : nullptr, options.attributes,
                    options.primitives),
        segments_(options.segments),
        file_(std::move(file)),
        warnings_(warnings),
        nodes_(root.find("nodes")),
        meshes_(root.find("meshes")),
        visited_(nodes_ ? nodes_->size() : 0) {}

  GltfAsset read() {
    for (const std::size_t node : root_nodes()) visit(node, WorldFromMesh(), 0);
    warn("skin", skins_, "the vertices are taken as the mesh has them");
    warn("morph targets", morphs_, "the vertices are taken as the mesh has them");
    primitives_.report(file_, warnings_);
    if (primitives_.has_quantized_positions() && !uses_extension(root_, "KHR_mesh_quantization"))
      warnings_.push_back(file_ +
                          ": has positions that are integers, but does not say that it uses "
                          "KHR_mesh_quantization; they are read as if it did");
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
    if (!scenes || scenes->size() == 0) return parentless_nodes();
    const auto chosen = root_.find("scene");
    const std::uint64_t index = chosen ? chosen->integer(0, largest_integer) : 0;
    if (index >= scenes->size()) chosen->fail("there is no scene " + std::to_string(index));
    const auto nodes = scenes->element(index).find("nodes");
    return nodes ? node_indices(*nodes) : std::vector<std::size_t>();
  }

  /// An asset without scenes is a library of its nodes: all are taken.
  std::vector<std::size_t> parentless_nodes() {
    std::vector<bool> has_parent(visited_.size());
    for (std::size_t i = 0; i < has_parent.size(); ++i)
      if (const auto children = nodes_->element(i).find("children"))
        for (const std::size_t child : node_indices(*children)) has_parent[child] = true;
    std::vector<std::size_t> roots;
    for (std::size_t i = 0; i < has_parent.size(); ++i)
      if (!has_parent[i]) roots.push_back(i);
    if (!has_parent.empty())
      warnings_.push_back(file_ + ": the asset has no scene; all its nodes are taken");
    return roots;
  }

  [[nodiscard]] std::vector<std::size_t> node_indices(const JsonValue& list) const {
    std::vector<std::size_t> indices;
    for_each_entry(list, [&](const JsonValue& reference) {
      const std::uint64_t index = reference.integer(0, largest_integer);
      if (index >= visited_.size()) reference.fail("there is no node " + std::to_string(index));
      indices.push_back(index);
    });
    return indices;
  }

  void visit(std::size_t index, const WorldFromMesh& world_from_parent, int depth) {
    const JsonValue node = nodes_->element(index);
    if (depth > deepest_node)
      node.fail("nodes are nested more than " + std::to_string(deepest_node) + " deep");
    if (visited_[index]) node.fail("the node is reached twice: a cycle, or two parents");
    visited_[index] = true;
    const WorldFromMesh world_from_node = compose(world_from_parent, read_transform_of_node(node));
    // Transforms grow with every level, and there may be many nodes at the deepest.
    accessors_.budget().take(1, bytes_of(world_from_node));
    if (const auto mesh = node.find("mesh")) place(node, index, *mesh, world_from_node);
    if (const auto children = node.find("children"))
      for (const std::size_t child : node_indices(*children))
        visit(child, world_from_node, depth + 1);
  }

  void place(const JsonValue& node, std::size_t node_index, const JsonValue& reference,
             const WorldFromMesh& world_from_node) {
    const std::uint64_t index = reference.integer(0, largest_integer);
    if (!meshes_ || index >= meshes_->size())
      reference.fail("there is no mesh " + std::to_string(index));
    const JsonValue mesh = meshes_->element(index);
    const auto [known, is_new] = read_meshes_.try_emplace(index, asset_.meshes.size());
    if (is_new) {
      asset_.meshes.push_back(primitives_.read(mesh));
      if (segments_) name_group(mesh, index, asset_.meshes.back());
    }
    const std::string name = name_of(node, node_index, mesh);
    const auto part = segments_ ? part_named(name) : nullptr;
    if (const auto instances = GltfInstances::of(node, accessors_))
      place_instances(node, known->second, *instances, world_from_node, name, part);
    else
      add_object(node, known->second, world_from_node, name, part);
    skins_ += node.find("skin") ? 1 : 0;
    morphs_ += mesh.find("weights") || node.find("weights") ? 1 : 0;
  }

  /// All triangles of a mesh are one group, which has its name.
  void name_group(const JsonValue& description, std::uint64_t index, Mesh& mesh) {
    std::string name = name_or_number(description, "mesh", index);
    accessors_.budget().take(2, sizeof(std::string) + name.size());
    mesh.segments.push_back({Segmentation::group, {0}, {std::move(name)}});
  }

  /// All triangles of a node are one part, its instances included.
  std::shared_ptr<const ObjectSegments> part_named(const std::string& name) {
    accessors_.budget().take(2, sizeof(ObjectSegments) + name.size());
    return std::make_shared<const ObjectSegments>(
        ObjectSegments{{{Segmentation::part, name}}, std::nullopt});
  }

  void place_instances(const JsonValue& node, std::size_t mesh, const GltfInstances& instances,
                       const WorldFromMesh& world_from_node, const std::string& name,
                       const std::shared_ptr<const ObjectSegments>& part) {
    accessors_.budget().take(instances.count(), sizeof(GltfPlacement));
    std::uint64_t number = 0;
    for (const GltfPlacement& placement : instances.placements()) {
      add_object(node, mesh, compose(world_from_node, transform_of(placement)),
                 name + "[" + std::to_string(number++) + "]", part);
    }
  }

  void add_object(const JsonValue& node, std::size_t mesh, const WorldFromMesh& world_from_mesh,
                  const std::string& name, const std::shared_ptr<const ObjectSegments>& part) {
    Object object;
    object.mesh = mesh;
    object.world_from_mesh = world_from_mesh;
    object.placed_as_is = world_from_mesh.rows == WorldFromMesh().rows;
    object.name = name;
    object.segments = part;
    object.first_face = next_face_;
    // Many nodes may have the name of one mesh, and its triangles.
    accessors_.budget().take_object(bytes_of(object), asset_.meshes[mesh].triangles.size());
    next_face_ += asset_.meshes[mesh].face_count;
    if (next_face_ > no_index) node.fail("the asset has more than 4294967294 triangles");
    asset_.objects.push_back(std::move(object));
  }

  static std::string name_of(const JsonValue& node, std::size_t index, const JsonValue& mesh) {
    if (const auto name = node.find("name"); name && !name->string().empty()) return name->string();
    if (const auto name = mesh.find("name"); name && !name->string().empty()) return name->string();
    return "node " + std::to_string(index);
  }

  JsonValue root_;
  GltfAccessors& accessors_;
  GltfMaterials materials_;
  GltfPrimitives primitives_;
  /// Whether names of nodes and meshes are requested.
  bool segments_;
  std::string file_;
  Warnings& warnings_;
  GltfAsset asset_;
  std::optional<JsonValue> nodes_, meshes_;
  std::vector<bool> visited_;
  /// For each glTF mesh that has been read, its place among the asset's.
  std::unordered_map<std::uint64_t, std::size_t> read_meshes_;
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
  check_required_extensions(root, options.attributes, file, warnings);
  ExpansionBudget budget(file, options.max_expansion);
  budget.add_input(bytes.size());
  GltfBuffers buffers(container, root, path, options, budget);
  GltfDecoders decoders(options, file, budget);
  GltfBufferViews views(root, buffers, decoders);
  GltfAccessors accessors(root, views, budget);
  GltfAsset asset = GltfReader(root, accessors, options, file, warnings).read();
  asset.reader = decoders.readers();
  for (const auto& [name, contents] : buffers.external_files())
    asset.buffers.push_back({name.string(), options.hash ? sha256(contents) : std::string()});
  buffers.expect_unchanged();
  return asset;
}

}  // namespace fathom::mesh_files
