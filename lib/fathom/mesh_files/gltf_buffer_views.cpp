#include "fathom/mesh_files/gltf_buffer_views.h"

#include <string>

#include "fathom/mesh_files/gltf_references.h"

namespace fathom::mesh_files {
using namespace text;

GltfBufferView GltfBufferViews::at(const JsonValue& reference) {
  const JsonValue view = referred(root_, "bufferViews", reference);
  const JsonValue buffer_index = view.at("buffer");
  const Bytes buffer = buffers_.at(buffer_index.integer(0, largest_integer), buffer_index);
  const std::uint64_t offset = optional_integer(view, "byteOffset", 0);
  const std::uint64_t length = view.at("byteLength").integer(0, largest_integer);
  if (offset > buffer.size() || length > buffer.size() - offset)
    view.fail("reaches beyond the end of its buffer of " + std::to_string(buffer.size()) +
              " bytes");
  return {buffer.subspan(offset, length), view.find("byteStride")};
}

}  // namespace fathom::mesh_files
