#include "fathom/mesh_files/gltf_accessor.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

#include "fathom/mesh_files/gltf_references.h"

namespace fathom::mesh_files {
using namespace text;

namespace {

static_assert(std::endian::native == std::endian::little, "glTF's buffers are little endian");

template <class T>
double read_as(const std::byte* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return static_cast<double>(value);
}

double read_component(GltfComponent component, const std::byte* at) {
  switch (component) {
    case GltfComponent::int8:
      return read_as<std::int8_t>(at);
    case GltfComponent::uint8:
      return read_as<std::uint8_t>(at);
    case GltfComponent::int16:
      return read_as<std::int16_t>(at);
    case GltfComponent::uint16:
      return read_as<std::uint16_t>(at);
    case GltfComponent::uint32:
      return read_as<std::uint32_t>(at);
    case GltfComponent::float32:
      return read_as<float>(at);
  }
  return 0;
}

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
      view.stride->fail("is less than the size of an element of " + std::to_string(element_size) +
                        " bytes");
  }
  // The last element need not be followed by a whole stride. count < 2³² and stride < 2⁸: this
  // cannot overflow.
  const std::uint64_t offset = optional_integer(holder, "byteOffset", 0);
  const std::uint64_t needed = stride * (count - 1) + element_size;
  if (offset > view.bytes.size() || needed > view.bytes.size() - offset)
    holder.fail("its " + std::to_string(count) +
                " elements reach beyond the end of their bufferView of " +
                std::to_string(view.bytes.size()) + " bytes");
  return {view.bytes.subspan(offset, needed), stride};
}

}  // namespace

GltfAccessor::GltfAccessor(const JsonValue& description) : description_(description) {
  // Indices have 32 bits, and the index 2³²−1 restarts a primitive.
  count_ = description_.at("count").integer(1, std::numeric_limits<std::uint32_t>::max());
  component_ = read_component_type(description_.at("componentType"));
  width_ = read_width(description_.at("type"));
  if (const auto normalized = description_.find("normalized")) normalized_ = normalized->boolean();
}

GltfAccessor::GltfAccessor(const JsonValue& description, GltfBufferViews& views,
                           std::uint64_t most_zeros)
    : GltfAccessor(description) {
  if (description_.find("bufferView"))
    elements_ = lay_out(views, description_, count_, element_size(), true);
  else if (count_ > most_zeros)
    description_.fail("has " + std::to_string(count_) + " elements but no bufferView");
  if (const auto sparse = description_.find("sparse")) read_sparse(views, *sparse);
}

GltfAccessor::GltfAccessor(const JsonValue& description, Bytes bytes) : GltfAccessor(description) {
  if (bytes.size() < count_ * element_size())
    description_.fail("its " + std::to_string(count_) + " elements do not fit into the " +
                      std::to_string(bytes.size()) + " bytes that were decoded");
  elements_ = GltfLayout{bytes, element_size()};
}

std::uint64_t GltfAccessor::element_size() const {
  return std::uint64_t{width_} * size_of(component_);
}

void GltfAccessor::read_sparse(GltfBufferViews& views, const JsonValue& sparse) {
  const std::uint64_t count = sparse.at("count").integer(1, count_);
  const JsonValue indices = sparse.at("indices");
  const GltfComponent type = read_component_type(indices.at("componentType"));
  if (type != GltfComponent::uint8 && type != GltfComponent::uint16 &&
      type != GltfComponent::uint32)
    indices.fail("expected unsigned integers");
  const GltfLayout layout = lay_out(views, indices, count, size_of(type), false);
  replacements_ = lay_out(views, sparse.at("values"), count, element_size(), false);
  replaced_.reserve(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    const double index = read_component(type, layout.bytes.data() + i * layout.stride);
    if (index >= static_cast<double>(count_) || (i > 0 && index <= replaced_.back()))
      indices.fail("expected increasing indices below " + std::to_string(count_));
    replaced_.push_back(static_cast<std::uint32_t>(index));
  }
}

const std::byte* GltfAccessor::find(std::uint64_t i) const {
  const auto at = std::lower_bound(replaced_.begin(), replaced_.end(), i);
  if (at != replaced_.end() && *at == i)
    return replacements_.bytes.data() +
           static_cast<std::uint64_t>(at - replaced_.begin()) * replacements_.stride;
  return elements_ ? elements_->bytes.data() + i * elements_->stride : nullptr;
}

double GltfAccessor::stored(std::uint64_t i, unsigned k) const {
  const std::byte* element = find(i);
  return element == nullptr ? 0 : read_component(component_, element + k * size_of(component_));
}

double GltfAccessor::value(std::uint64_t i, unsigned k) const {
  const double number = stored(i, k);
  if (!normalized_) return number;
  switch (component_) {
    case GltfComponent::int8:
      return std::max(number / 127, -1.0);
    case GltfComponent::uint8:
      return number / 255;
    case GltfComponent::int16:
      return std::max(number / 32767, -1.0);
    case GltfComponent::uint16:
      return number / 65535;
    default:
      return number;
  }
}

std::shared_ptr<const GltfAccessor> GltfAccessors::at(const JsonValue& reference) {
  std::shared_ptr<const GltfAccessor>& accessor = opened_[reference.integer(0, largest_integer)];
  if (!accessor)
    accessor = std::make_shared<const GltfAccessor>(description(reference), views_, most_zeros_);
  return accessor;
}

JsonValue GltfAccessors::description(const JsonValue& reference) const {
  return referred(root_, "accessors", reference);
}

}  // namespace fathom::mesh_files
