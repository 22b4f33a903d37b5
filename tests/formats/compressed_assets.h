#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/mesh_files/gltf/gltf_asset.h"

/// glTF assets of one triangle mesh, plain and compressed by the libraries themselves.
namespace fathom::test {

struct Triangulated {
  std::vector<float> positions;
  std::vector<std::uint32_t> indices;
};

/// Of an OBJ file of triangles.
Triangulated read_triangulated(const std::string& obj_file);

nlohmann::json plain_asset(const Triangulated& mesh);

/// Draco's options: bits of the quantization of positions (0: none), and its sequential method,
/// which keeps the order of vertices and triangles.
struct DracoOptions {
  int bits = 0;
  bool sequential = true;
};
/// The compressed bytes.
std::string by_draco(const Triangulated& mesh, const DracoOptions& options);
/// What Draco itself makes of them.
Triangulated decoded_by_draco(const std::string& bytes);
/// An asset whose accessors have no other bytes. `mesh` says how many there are.
nlohmann::json draco_asset(const Triangulated& mesh, const std::string& compressed);

/// A buffer view in compressed form: its bytes, and what the extension says of it.
struct CompressedView {
  std::string bytes;
  nlohmann::json extension;
};
CompressedView attributes_by_meshopt(const std::string& elements, std::size_t stride,
                                     const std::string& filter = "");
CompressedView indices_by_meshopt(const std::vector<std::uint32_t>& indices,
                                  const std::string& mode);
/// The indices that a decoder makes of those; it may turn the corners of triangles.
std::vector<std::uint32_t> decoded_by_meshopt(const CompressedView& indices);
/// Numbers as a filter of meshoptimizer encodes them with so many bits each, and as the library
/// itself decodes those bytes.
struct FilteredElements {
  std::string encoded, decoded;
};
/// `filter` as in EXT_meshopt_compression. OCTAHEDRAL and QUATERNION take four numbers an element,
/// EXPONENTIAL stride / 4.
FilteredElements by_filter(const std::string& filter, std::size_t stride, int bits,
                           const std::vector<float>& numbers);
/// Lets a buffer view have its bytes in compressed form alone.
void compress_view(nlohmann::json& asset, std::size_t number, const CompressedView& compressed);
/// An asset of a view of positions and one of indices, with bytes in compressed form alone.
nlohmann::json meshopt_asset(const CompressedView& positions, const CompressedView& indices,
                             const std::string& extension = "EXT_meshopt_compression");

}  // namespace fathom::test
