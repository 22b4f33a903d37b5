#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "fathom/mesh_files/gltf/gltf_buffers.h"
#include "fathom/mesh_files/gltf/gltf_decoders.h"
#include "fathom/text/json_value.h"

/// The parts of buffers that accessors look at. For this room's .cpp files only.
/// Source   [GLTF20] 3.6.1.2 (buffer views)
namespace fathom::mesh_files {

/// A part of a buffer, and how far apart its elements are.
struct GltfBufferView {
  Bytes bytes;
  /// The key "byteStride" if it is there; the elements follow each other closely if not.
  std::optional<text::JsonValue> stride;
};

class GltfBufferViews {
 public:
  /// `root`, `buffers` and `decoders` must outlive this.
  GltfBufferViews(const text::JsonValue& root, GltfBuffers& buffers, GltfDecoders& decoders)
      : root_(root), buffers_(buffers), decoders_(decoders) {}

  /// The view that `reference` names by its number. Whatever an accessor reads comes from here. A
  /// compressed view is decoded, once, where the asset does not also have its bytes as they are.
  /// Fails    InputError if there is no such view, it reaches beyond its buffer, or it cannot be
  ///          decoded.
  GltfBufferView at(const text::JsonValue& reference);
  [[nodiscard]] GltfDecoders& decoders() const { return decoders_; }

 private:
  Bytes bytes_in_buffer(const text::JsonValue& place);
  Bytes decoded(const text::JsonValue& view, const text::JsonValue& extension);
  [[nodiscard]] bool has_plain_bytes(const text::JsonValue& view, const char* compression) const;

  text::JsonValue root_;
  GltfBuffers& buffers_;
  GltfDecoders& decoders_;
  std::map<std::uint64_t, Bytes> decoded_;
};

}  // namespace fathom::mesh_files
