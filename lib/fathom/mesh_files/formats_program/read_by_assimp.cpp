#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "fathom/failures/errors.h"
#include "fathom/mesh/mesh_faces.h"
#include "fathom/mesh_files/foreign_formats.h"
#include "fathom/mesh_files/formats_program/foreign_mesh.h"
#include "fathom/mesh_files/formats_program/process.h"
#include "fathom/numeric/certified.h"
#include "fathom/text/printable.h"

namespace fathom::mesh_files {
using namespace formats_program;

namespace {

/// Transforms grow with every level that is not the identity.
constexpr std::size_t deepest_transform = 200;

[[noreturn]] void fail_to_read(const std::string& file, const std::string& why) {
  throw InputError(file + ": assimp could not read it: " + as_reason(why));
}

/// One node of the file, depth first.
struct ForeignNode {
  std::uint32_t depth = 0;
  std::string name;
  std::array<float, 16> matrix{};  ///< row by row
  MessageList<std::uint32_t> meshes;
};

ForeignNode read_node(MessageReader& answer) {
  ForeignNode node;
  node.depth = answer.get<std::uint32_t>();
  node.name = answer.get_text();
  node.matrix = answer.get<std::array<float, 16>>();
  node.meshes = answer.get_list<std::uint32_t>();
  return node;
}

/// A place in the tree of nodes.
struct Level {
  WorldFromMesh world_from_node;
  /// How many transforms it is composed of.
  std::size_t transforms = 0;
  /// Why nothing can be placed here; empty if something can.
  std::string fault;
};

/// Makes objects of the nodes that have meshes.
class AssimpNodes {
 public:
  AssimpNodes(const std::vector<ForeignMesh>& meshes, const std::string& file, bool attributes,
              ExpansionBudget& budget)
      : file_(file), budget_(budget), builder_(meshes, file, attributes, budget) {}

  void add(const ForeignNode& node) {
    if (node.depth > path_.size()) throw BadMessage();
    path_.resize(node.depth);
    path_.push_back(placed(path_.empty() ? Level() : path_.back(), node));
    if (node.meshes.size() > 0) add_object(node);
    ++count_;
  }

  ForeignMeshes finish(Warnings& warnings) {
    builder_.report(warnings);
    if (next_face_ == 0) warnings.push_back(file_ + ": has no faces");
    return std::move(result_);
  }

 private:
  [[nodiscard]] std::string name_of(const ForeignNode& node) const {
    return node.name.empty() ? "node " + std::to_string(count_) : node.name;
  }

  [[nodiscard]] Level placed(Level parent, const ForeignNode& node) const {
    const std::array<float, 16>& m = node.matrix;
    const auto because = [&](const char* fault) {
      return Level{{}, 0, "the node '" + text::printable(name_of(node)) + "' " + fault};
    };
    if (!parent.fault.empty()) return parent;
    if (!std::ranges::all_of(m, [](float x) { return std::isfinite(x); }))
      return because("has a transform that is not finite");
    if (m[12] != 0 || m[13] != 0 || m[14] != 0 || m[15] != 1)
      return because("has a transform that is not affine");
    WorldFromMesh transform;
    for (std::size_t i = 0; i < 12; ++i) transform.rows[i / 4][i % 4] = double{m[i]};
    if (transform.rows == WorldFromMesh().rows) return parent;
    if (parent.transforms == deepest_transform) return because("lies below too many transforms");
    return {compose(parent.world_from_node, transform), parent.transforms + 1, {}};
  }

  void add_object(const ForeignNode& node) {
    if (!path_.back().fault.empty()) throw InputError(file_ + ": " + path_.back().fault);
    Object object;
    object.mesh = mesh_of(node.meshes);
    object.world_from_mesh = path_.back().world_from_node;
    object.placed_as_is = object.world_from_mesh.rows == WorldFromMesh().rows;
    object.name = name_of(node);
    object.first_face = next_face_;
    budget_.take_object(bytes_of(object), result_.meshes[object.mesh].triangles.size());
    next_face_ += result_.meshes[object.mesh].face_count;
    mesh::expect_countable(next_face_, "faces", file_);
    result_.objects.push_back(std::move(object));
  }

  /// Nodes that show the same meshes share a Mesh.
  std::size_t mesh_of(const MessageList<std::uint32_t>& numbers) {
    std::vector<std::uint32_t> key;
    for (std::size_t i = 0; i < numbers.size(); ++i) key.push_back(numbers[i]);
    const auto [known, is_new] = known_.try_emplace(std::move(key), result_.meshes.size());
    if (is_new) result_.meshes.push_back(builder_.build(numbers));
    return known->second;
  }

  const std::string& file_;
  ExpansionBudget& budget_;
  ForeignMeshBuilder builder_;
  ForeignMeshes result_;
  std::vector<Level> path_;
  std::map<std::vector<std::uint32_t>, std::size_t> known_;
  std::uint64_t next_face_ = 0, count_ = 0;
};

/// The answer of fathom-formats to this file.
std::vector<std::byte> ask_assimp(std::span<const std::byte> bytes,
                                  const std::filesystem::path& path, const ReadOptions& options,
                                  ExpansionBudget& budget) {
  MessageWriter parameters;
  parameters.put_text(path.filename().string());
  Process program(options, path.string());
  return program.ask(Task::assimp, parameters.bytes(), bytes, budget);
}

ForeignMeshes read_answer(std::span<const std::byte> bytes, const std::string& file,
                          bool attributes, ExpansionBudget& budget, Warnings& warnings) {
  MessageReader answer(bytes);
  const std::string reader = answer.get_text();
  std::vector<ForeignMesh> meshes;
  for (auto count = answer.get<std::uint64_t>(); count > 0; --count)
    meshes.push_back(read_foreign_mesh(answer));
  AssimpNodes nodes(meshes, file, attributes, budget);
  for (auto count = answer.get<std::uint64_t>(); count > 0; --count) nodes.add(read_node(answer));
  ForeignMeshes result = nodes.finish(warnings);
  result.reader = reader;
  return result;
}

}  // namespace

ForeignMeshes read_by_assimp(std::span<const std::byte> bytes, const std::filesystem::path& path,
                             const ReadOptions& options, Warnings& warnings) {
  const std::string file = path.string();
  ExpansionBudget budget(file, options.max_expansion);
  budget.add_input(bytes.size());
  try {
    return read_answer(ask_assimp(bytes, path, options, budget), file, options.attributes, budget,
                       warnings);
  } catch (const Refusal& refusal) {
    fail_to_read(file, refusal.what());
  } catch (const BadMessage& message) {
    fail_to_read(file, message.what());
  }
}

}  // namespace fathom::mesh_files
