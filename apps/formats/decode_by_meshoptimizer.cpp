#include <meshoptimizer.h>

#include <stdexcept>

#include "apps/formats/tasks.h"

namespace fathom::app {
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
