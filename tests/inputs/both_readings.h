#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "fathom/scene/read_scene.h"

namespace fathom::checks {

template <class T>
void put(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

inline std::string stl_of(const Mesh& mesh) {
  std::string bytes(80, ' ');
  put(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const CornerIndices& t : mesh.triangles) {
    bytes.append(12, '\0');
    for (const std::uint32_t i : t) {
      const MeshPoint& p = mesh.vertices[i];
      for (const double x : {p.x, p.y, p.z}) put(bytes, static_cast<float>(x));
    }
    put(bytes, std::uint16_t{0});
  }
  return bytes;
}

/// With an extra face of two corners before every seventh, so that faces are not triangles.
inline std::string ply_of(const Mesh& mesh) {
  std::string rows;
  std::size_t faces = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t, ++faces) {
    if (t % 7 == 0) {
      rows += '\2';
      for (int k = 0; k < 2; ++k) put(rows, std::int32_t{0});
      ++faces;
    }
    rows += '\3';
    for (const std::uint32_t i : mesh.triangles[t]) put(rows, static_cast<std::int32_t>(i));
  }
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                      std::to_string(mesh.vertices.size()) +
                      "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                      std::to_string(faces) +
                      "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const MeshPoint& p : mesh.vertices)
    for (const double x : {p.x, p.y, p.z}) put(bytes, x);
  return bytes + rows;
}

/// The same files in memory and as streams.
struct Both {
  explicit Both(std::vector<std::filesystem::path> files)
      : scene(read_scene(files, {}, warnings)),
        streamed(stream_scene(files, {}, stream_warnings)) {}
  Warnings warnings, stream_warnings;
  Scene scene;
  StreamedScene streamed;
};

}  // namespace fathom::checks
