#include <array>

#include "fathom/mesh/mesh_faces.h"
#include "fathom/mesh_files/read_mesh.h"
#include "fathom/mesh_files/stl_ascii.h"
#include "fathom/mesh_files/stl_binary.h"
#include "fathom/text/text_ends.h"

namespace fathom::mesh_files {
using namespace mesh;
using namespace text;

namespace {

Mesh read_binary(std::span<const std::byte> bytes, const std::string& file, bool attributes,
                 Warnings& warnings) {
  const std::uint64_t count = count_binary_stl(bytes, bytes.size(), file, warnings);
  expect_countable(3 * count, "vertices", file);
  Mesh mesh;
  mesh.face_count = count;
  mesh.vertices.resize(3 * count);
  mesh.triangles.resize(count);
  if (attributes) mesh.normals.resize(count), mesh.normal_triangles.resize(count);
  for (std::uint32_t t = 0; t < count; ++t) {
    const std::byte* record = bytes.data() + stl_header_size + stl_triangle_size * t;
    const std::array<float, 12> values = read_stl_triangle(record, t, file);
    for (std::uint32_t k = 0; k < 3; ++k) {
      const float* p = &values[3 + 3 * k];
      mesh.vertices[3 * t + k] = {p[0], p[1], p[2]};
      mesh.triangles[t][k] = 3 * t + k;
    }
    if (!attributes) continue;
    mesh.normals[t] = {values[0], values[1], values[2]};
    mesh.normal_triangles[t] = {t, t, t};
  }
  return mesh;
}

}  // namespace

Mesh read_stl(std::span<const std::byte> bytes, const std::string& file, const ReadOptions& options,
              Warnings& warnings) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (is_binary_stl(bytes, bytes.size())) {
    if (!is_binary_stl_by_size(bytes, bytes.size())) expect_no_utf16(text, file);
    return read_binary(bytes, file, options.attributes, warnings);
  }
  return read_ascii_stl(text, file, options, warnings);
}

}  // namespace fathom::mesh_files
