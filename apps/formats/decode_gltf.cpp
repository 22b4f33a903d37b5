#include <draco/compression/decode.h>
#include <draco/core/draco_version.h>
#include <meshoptimizer.h>

#include <limits>
#include <stdexcept>

#include "apps/formats/tasks.h"

namespace fathom::app {
namespace {

using namespace mesh_files::formats_program;

/// The most numbers of a vertex: VEC4.
constexpr std::uint32_t widest = 4;

std::unique_ptr<draco::Mesh> decode(std::span<const std::byte> bytes) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  auto decoded = draco::Decoder().DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) throw std::runtime_error(decoded.status().error_msg_string());
  return std::move(decoded).value();
}

/// Calls visit(zero of the type) for the component type of glTF with this code.
template <class Visit>
void with_component(std::uint32_t code, const Visit& visit) {
  switch (code) {
    case 5120:
      return visit(std::int8_t{});
    case 5121:
      return visit(std::uint8_t{});
    case 5122:
      return visit(std::int16_t{});
    case 5123:
      return visit(std::uint16_t{});
    case 5125:
      return visit(std::uint32_t{});
    case 5126:
      return visit(float{});
    default:
      throw std::runtime_error("unknown component type " + std::to_string(code));
  }
}

template <class T>
void put_bytes(const std::vector<T>& numbers, MessageWriter& message) {
  message.put_list<std::byte>(std::as_bytes(std::span(numbers)));
}

template <class Index>
void put_corners(const draco::Mesh& mesh, MessageWriter& message) {
  std::vector<Index> corners;
  corners.reserve(3 * std::size_t{mesh.num_faces()});
  for (draco::FaceIndex face(0); face < mesh.num_faces(); ++face) {
    for (const draco::PointIndex& point : mesh.face(face)) {
      if (point.value() >= mesh.num_points())
        throw std::runtime_error("a triangle has a vertex that there is not");
      if (point.value() > std::numeric_limits<Index>::max())
        throw std::runtime_error("the accessor's component type is too small for its indices");
      corners.push_back(static_cast<Index>(point.value()));
    }
  }
  put_bytes(corners, message);
}

/// Of each vertex, `width` numbers.
template <class T>
void put_attribute(const draco::Mesh& mesh, const draco::PointAttribute& attribute,
                   std::uint32_t width, MessageWriter& message) {
  std::vector<T> numbers;
  numbers.reserve(std::size_t{width} * mesh.num_points());
  std::array<T, widest> element{};
  for (draco::PointIndex point(0); point < mesh.num_points(); ++point) {
    const draco::AttributeValueIndex index = attribute.mapped_index(point);
    if (index.value() >= attribute.size())
      throw std::runtime_error("a vertex has a value that there is not");
    if (!attribute.ConvertValue<T>(index, static_cast<std::int8_t>(width), element.data()))
      throw std::runtime_error("an attribute is not of its accessor's type");
    numbers.insert(numbers.end(), element.begin(), element.begin() + width);
  }
  put_bytes(numbers, message);
}

const draco::PointAttribute& attribute_of(const draco::Mesh& mesh, const DracoAttribute& wanted) {
  const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(wanted.number);
  if (attribute == nullptr)
    throw std::runtime_error("there is no attribute " + std::to_string(wanted.number));
  // It would be filled up with zeros, or cut.
  if (wanted.width == 0 || wanted.width > widest || attribute->num_components() != wanted.width)
    throw std::runtime_error("attribute " + std::to_string(wanted.number) + " has " +
                             std::to_string(attribute->num_components()) +
                             " numbers to a vertex, its accessor has " +
                             std::to_string(wanted.width));
  return *attribute;
}

}  // namespace

std::string draco_version() {
  return std::string("Draco ") + draco::kDracoVersion;
}

std::vector<std::byte> decode_by_draco(std::span<const std::byte> parameters,
                                       std::span<const std::byte> bytes) {
  const auto wanted = MessageReader(parameters).get_list<DracoAttribute>();
  const std::unique_ptr<draco::Mesh> mesh = decode(bytes);
  MessageWriter message;
  message.put_text(draco_version());
  message.put(3 * std::uint64_t{mesh->num_faces()});
  message.put(std::uint64_t{mesh->num_points()});
  with_component(wanted[0].component,
                 [&](auto zero) { put_corners<decltype(zero)>(*mesh, message); });
  for (std::size_t i = 1; i < wanted.size(); ++i) {
    const draco::PointAttribute& attribute = attribute_of(*mesh, wanted[i]);
    with_component(wanted[i].component, [&](auto zero) {
      put_attribute<decltype(zero)>(*mesh, attribute, wanted[i].width, message);
    });
  }
  return message.bytes();
}

namespace {

using namespace mesh_files::formats_program;

/// What the library only asserts: the sizes of elements that the extension allows.
void check(const MeshoptView& view) {
  const auto expect = [](bool holds, const char* what) {
    if (!holds) throw std::runtime_error(what);
  };
  const bool is_index = view.stride == 2 || view.stride == 4;
  switch (view.mode) {
    case MeshoptMode::attributes:
      expect(view.stride % 4 == 0 && view.stride > 0 && view.stride <= 256,
             "expected a byteStride of attributes of 4, 8, … 256");
      break;
    case MeshoptMode::triangles:
      expect(view.count % 3 == 0, "expected three indices for each triangle");
      [[fallthrough]];
    case MeshoptMode::indices:
      expect(is_index, "expected a byteStride of indices of 2 or 4");
      expect(view.filter == MeshoptFilter::none, "expected indices without a filter");
  }
  switch (view.filter) {
    case MeshoptFilter::octahedral:
      return expect(view.stride == 4 || view.stride == 8,
                    "expected a byteStride of 4 or 8 with the filter OCTAHEDRAL");
    case MeshoptFilter::quaternion:
      return expect(view.stride == 8, "expected a byteStride of 8 with the filter QUATERNION");
    default:
      return;
  }
}

using Decode = int (*)(void*, std::size_t, std::size_t, const unsigned char*, std::size_t);

Decode decoder_of(MeshoptMode mode) {
  switch (mode) {
    case MeshoptMode::attributes:
      return meshopt_decodeVertexBuffer;
    case MeshoptMode::triangles:
      return meshopt_decodeIndexBuffer;
    case MeshoptMode::indices:
      return meshopt_decodeIndexSequence;
  }
  throw BadMessage();
}

void decode(const MeshoptView& view, std::span<const std::byte> bytes, std::byte* result) {
  const auto* source = reinterpret_cast<const unsigned char*>(bytes.data());
  if (decoder_of(view.mode)(result, view.count, view.stride, source, bytes.size()) != 0)
    throw std::runtime_error("it is damaged, or of a version that the library does not know");
}

void undo_filter(const MeshoptView& view, std::byte* result) {
  switch (view.filter) {
    case MeshoptFilter::none:
      return;
    case MeshoptFilter::octahedral:
      return meshopt_decodeFilterOct(result, view.count, view.stride);
    case MeshoptFilter::quaternion:
      return meshopt_decodeFilterQuat(result, view.count, view.stride);
    case MeshoptFilter::exponential:
      return meshopt_decodeFilterExp(result, view.count, view.stride);
  }
}

}  // namespace

std::string meshoptimizer_version() {
  return "meshoptimizer " + std::to_string(MESHOPTIMIZER_VERSION / 1000) + "." +
         std::to_string(MESHOPTIMIZER_VERSION % 1000 / 10);
}

std::vector<std::byte> decode_by_meshoptimizer(std::span<const std::byte> parameters,
                                               std::span<const std::byte> bytes) {
  const auto view = MessageReader(parameters).get<MeshoptView>();
  check(view);
  // The library writes elements of 4 bytes. Its vector code may read past the last of them.
  std::vector<std::byte> result(view.count * view.stride + 16);
  decode(view, bytes, result.data());
  undo_filter(view, result.data());
  result.resize(view.count * view.stride);
  MessageWriter message;
  message.put_text(meshoptimizer_version());
  message.put_list<std::byte>(result);
  return message.bytes();
}

}  // namespace fathom::app
