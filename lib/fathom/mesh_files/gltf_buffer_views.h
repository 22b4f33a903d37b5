#pragma once

#include <cstdint>
#include <optional>

#include "fathom/mesh_files/gltf_buffers.h"
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
  /// `root` and `buffers` must outlive this.
  GltfBufferViews(const text::JsonValue& root, GltfBuffers& buffers)
      : root_(root), buffers_(buffers) {}

  /// The view that `reference` names by its number. Whatever an accessor reads comes from here, so
  /// this is where the bytes of a compressed view would be decoded. They stay as long as this does.
  /// Fails    InputError if there is no such view, or it reaches beyond its buffer.
  GltfBufferView at(const text::JsonValue& reference);

 private:
  text::JsonValue root_;
  GltfBuffers& buffers_;
};

}  // namespace fathom::mesh_files
