#pragma once

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "fathom/mesh_files/expansion_budget.h"
#include "fathom/mesh_files/gltf/gltf_buffers.h"
#include "fathom/mesh_files/read_options.h"
#include "fathom/text/json_value.h"

/// The compressed parts of a glTF asset, which the program fathom-formats decodes by others'
/// libraries. Only for .cpp files of this module.
/// Source   [KDMC18], [EMC20]
namespace fathom::mesh_files {

namespace formats_program {
class Process;
enum class Task : std::uint32_t;
}  // namespace formats_program

/// Starts the program at the first request. Decoded bytes are kept as long as this object, and are
/// taken from the budget.
class GltfDecoders {
 public:
  /// `options` and `budget` must outlive this; `file` is the name for messages.
  GltfDecoders(const ReadOptions& options, std::string file, ExpansionBudget& budget);
  GltfDecoders(const GltfDecoders&) = delete;
  GltfDecoders& operator=(const GltfDecoders&) = delete;
  ~GltfDecoders();

  /// The `length` bytes of a buffer view, decoded from `compressed`; `extension` is its
  /// EXT_meshopt_compression or KHR_meshopt_compression.
  /// Fails    InputError: they cannot be decoded.
  Bytes decode_view(const text::JsonValue& extension, std::uint64_t length, Bytes compressed);

  /// The requested parts of a primitive: an attribute by Draco's number, as an accessor describes
  /// it.
  struct Wanted {
    std::uint32_t number = 0;
    text::JsonValue accessor;
  };
  struct Primitive {
    /// Of the type `indices`, three for each triangle.
    Bytes corners;
    /// The elements of each attribute, one for each vertex, in the order in which they were wanted.
    std::vector<Bytes> attributes;
  };
  /// The triangles that `compressed` holds; `extension` is a primitive's
  /// KHR_draco_mesh_compression, `indices` the accessor of its indices.
  /// Fails    InputError: they cannot be decoded, or are more or fewer than the accessors say.
  Primitive decode_primitive(const text::JsonValue& extension, const text::JsonValue& indices,
                             const std::vector<Wanted>& attributes, Bytes compressed);

  /// The libraries that have decoded something: "Draco 1.5.5, meshoptimizer 0.18".
  [[nodiscard]] const std::string& readers() const { return readers_; }

 private:
  Bytes ask(formats_program::Task task, const char* library, const text::JsonValue& extension,
            const std::vector<std::byte>& parameters, Bytes compressed);
  void note_reader(const std::string& reader);

  const ReadOptions& options_;
  std::string file_;
  ExpansionBudget& budget_;
  std::unique_ptr<formats_program::Process> process_;
  std::deque<std::vector<std::byte>> answers_;
  std::string readers_;
};

}  // namespace fathom::mesh_files
