#include "fathom/mesh_files/gltf/gltf_accessor.h"

#include <bit>
#include <cstring>
#include <limits>
#include <string>

#include "fathom/mesh_files/gltf/gltf_asset.h"
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

namespace {

static_assert(std::endian::native == std::endian::little, "glTF's buffers are little endian");

unsigned size_of(GltfComponent component) {
  switch (component) {
    case GltfComponent::int8:
    case GltfComponent::uint8:
      return 1;
    case GltfComponent::int16:
    case GltfComponent::uint16:
      return 2;
    default:
      return 4;
  }
}

GltfComponent read_component_type(const JsonValue& value) {
  const std::uint64_t code = value.integer(0, largest_integer);
  for (const auto known : {GltfComponent::int8, GltfComponent::uint8, GltfComponent::int16,
                           GltfComponent::uint16, GltfComponent::uint32, GltfComponent::float32})
    if (code == static_cast<std::uint64_t>(known)) return known;
  value.fail("unknown component type " + std::to_string(code));
}

unsigned read_width(const JsonValue& type) {
  const std::string& name = type.string();
  if (name == "SCALAR") return 1;
  if (name == "VEC2") return 2;
  if (name == "VEC3") return 3;
  if (name == "VEC4") return 4;
  type.fail("expected SCALAR, VEC2, VEC3 or VEC4");
}

/// Where the `count` elements lie that `holder`, an accessor or a part of one, describes.
GltfLayout lay_out(GltfBufferViews& views, const JsonValue& holder, std::uint64_t count,
                   std::uint64_t element_size, bool strided) {
  const GltfBufferView view = views.at(holder.at("bufferView"));
  std::uint64_t stride = element_size;
  if (view.stride && strided) {
    stride = view.stride->integer(4, 252);
    if (stride < element_size)
      view.stride->fail("is less than the size of an element of " +
                        text::counted(element_size, "byte"));
  }
  // The last element need not be followed by a whole stride. count < 2³² and stride < 2⁸: this
  // cannot overflow.
  const std::uint64_t offset = optional_integer(holder, "byteOffset", 0);
  const std::uint64_t needed = count == 0 ? 0 : stride * (count - 1) + element_size;
  if (offset > view.bytes.size() || needed > view.bytes.size() - offset)
    holder.fail("its " + text::counted(count, "element reaches", "elements reach") +
                " beyond the end of the bufferView of " + text::counted(view.bytes.size(), "byte"));
  return {view.bytes.subspan(offset, needed), stride};
}

}  // namespace

GltfAccessor::GltfAccessor(const JsonValue& description) : description_(description) {
  // Indices have 32 bits, and the index 2³²−1 restarts a primitive.
  count_ = description_.at("count").integer(0, std::numeric_limits<std::uint32_t>::max());
  component_ = read_component_type(description_.at("componentType"));
  width_ = read_width(description_.at("type"));
  if (const auto normalized = description_.find("normalized")) normalized_ = normalized->boolean();
}

GltfAccessor::GltfAccessor(const JsonValue& description, GltfBufferViews& views,
                           ExpansionBudget& budget)
    : GltfAccessor(description) {
  if (description_.find("bufferView"))
    elements_ = lay_out(views, description_, count_, element_size(), true);
  if (const auto sparse = description_.find("sparse")) open_sparse(views, *sparse, budget);
}

GltfAccessor::GltfAccessor(const JsonValue& description, Bytes bytes) : GltfAccessor(description) {
  if (bytes.size() < count_ * element_size())
    description_.fail("its " + text::counted(count_, "element does not", "elements do not") +
                      " fit into the " +
                      text::counted(bytes.size(), "byte that was", "bytes that were") + " decoded");
  elements_ = GltfLayout{bytes, element_size()};
}

std::uint64_t GltfAccessor::element_size() const {
  return std::uint64_t{width_} * size_of(component_);
}

void GltfAccessor::open_sparse(GltfBufferViews& views, const JsonValue& sparse,
                               ExpansionBudget& budget) {
  replaced_count_ = sparse.at("count").integer(0, count_);
  const JsonValue indices = sparse.at("indices");
  replaced_type_ = read_component_type(indices.at("componentType"));
  if (replaced_type_ != GltfComponent::uint8 && replaced_type_ != GltfComponent::uint16 &&
      replaced_type_ != GltfComponent::uint32)
    indices.fail("expected unsigned integers");
  replaced_ = lay_out(views, indices, replaced_count_, size_of(replaced_type_), false);
  replacements_ = lay_out(views, sparse.at("values"), replaced_count_, element_size(), false);
  // No memory, but time: many accessors may name the same indices.
  budget.take(replaced_count_, sizeof(std::uint32_t));
  for (std::uint64_t i = 0; i < replaced_count_; ++i)
    if (replaced(i) >= count_ || (i > 0 && replaced(i) <= replaced(i - 1)))
      indices.fail("expected increasing indices below " + std::to_string(count_));
}

std::uint64_t GltfAccessor::replaced(std::uint64_t place) const {
  std::uint32_t index = 0;  // little endian: the lower bytes come first
  std::memcpy(&index, replaced_.at(place), size_of(replaced_type_));
  return index;
}

std::shared_ptr<const GltfAccessor> GltfAccessors::at(const JsonValue& reference) {
  std::shared_ptr<const GltfAccessor>& accessor = opened_[reference.integer(0, largest_integer)];
  if (!accessor)
    accessor = std::make_shared<const GltfAccessor>(description(reference), views_, budget_);
  return accessor;
}

JsonValue GltfAccessors::description(const JsonValue& reference) const {
  return referred(root_, "accessors", reference);
}

}  // namespace fathom::mesh_files
