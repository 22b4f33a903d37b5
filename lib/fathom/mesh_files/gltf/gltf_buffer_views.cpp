#include "fathom/mesh_files/gltf/gltf_buffer_views.h"

#include <string>

#include "fathom/mesh_files/gltf/gltf_extensions.h"
#include "fathom/mesh_files/gltf/gltf_references.h"
#include "fathom/text/counted.h"

namespace fathom::mesh_files {
using namespace files;
using namespace text;

namespace {

/// The extensions that make a view a compressed one; the second was the first's name while it was
/// not yet one of glTF's own.
constexpr const char* compressions[] = {"KHR_meshopt_compression", "EXT_meshopt_compression"};

}  // namespace

GltfBufferView GltfBufferViews::at(const JsonValue& reference) {
  const JsonValue view = referred(root_, "bufferViews", reference);
  const auto stride = view.find("byteStride");
  for (const char* name : compressions) {
    const auto compression = find_extension(view, name);
    if (!compression || has_plain_bytes(view, name)) continue;
    const std::uint64_t number = reference.integer(0, largest_integer);
    auto known = decoded_.find(number);
    if (known == decoded_.end())
      known = decoded_.emplace(number, decoded(view, *compression)).first;
    return {known->second, stride};
  }
  return {bytes_in_buffer(view), stride};
}

/// `place` has a buffer, a byteOffset and a byteLength.
Bytes GltfBufferViews::bytes_in_buffer(const JsonValue& place) {
  const JsonValue buffer_index = place.at("buffer");
  const Bytes buffer = buffers_.at(buffer_index.integer(0, largest_integer), buffer_index);
  const std::uint64_t offset = optional_integer(place, "byteOffset", 0);
  const std::uint64_t length = place.at("byteLength").integer(0, largest_integer);
  if (offset > buffer.size() || length > buffer.size() - offset)
    place.fail("reaches beyond the end of its buffer of " + text::counted(buffer.size(), "byte"));
  return buffer.subspan(offset, length);
}

/// Whether the bytes of a compressed view are also there as they are: for readers that do without
/// the extension, which the asset then does not require.
bool GltfBufferViews::has_plain_bytes(const JsonValue& view, const char* compression) const {
  if (requires_extension(root_, compression)) return false;
  const JsonValue buffer = referred(root_, "buffers", view.at("buffer"));
  const auto mark = find_extension(buffer, compression);
  const auto stands_in = mark ? mark->find("fallback") : std::nullopt;
  return !(stands_in && stands_in->boolean()) || buffer.find("uri");
}

Bytes GltfBufferViews::decoded(const JsonValue& view, const JsonValue& extension) {
  return decoders_.decode_view(extension, view.at("byteLength").integer(0, largest_integer),
                               bytes_in_buffer(extension));
}

}  // namespace fathom::mesh_files
