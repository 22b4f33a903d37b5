#include "fathom/mesh/mesh_faces.h"

#include <numeric>

#include "fathom/failures/errors.h"
#include "fathom/mesh/triangulate_face.h"
#include "fathom/text/counted.h"

namespace fathom::mesh {

void expect_countable(std::uint64_t count, const char* what, const std::string& file) {
  if (count > most_elements)
    throw InputError(file + ": " + std::to_string(count) + " " + what +
                     " are more than the 4294967294 that can be numbered");
}

void fail_too_many_triangles(const std::string& file) {
  throw InputError(file + ": more than the 4294967294 triangles that can be numbered");
}

namespace {

/// One face in the list of triangles: [first, end), a fan.
struct FanRange {
  std::size_t first, end;
};

/// The corners of a fan, from `list`.
void ring_of_fan(std::span<const CornerIndices> list, FanRange fan,
                 std::vector<std::uint32_t>& ring) {
  ring.assign({list[fan.first][0], list[fan.first][1]});
  for (std::size_t t = fan.first; t < fan.end; ++t) ring.push_back(list[t][2]);
}

void write_cut(MeshArray<CornerIndices>& list, FanRange fan, const std::vector<CornerIndices>& cut,
               std::vector<std::uint32_t>& ring) {
  if (list.empty()) return;
  ring_of_fan(list, fan, ring);
  for (std::size_t k = 0; k < cut.size(); ++k)
    list[fan.first + k] = {ring[cut[k][0]], ring[cut[k][1]], ring[cut[k][2]]};
}

}  // namespace

void FaceCollector::note_odd_face(std::size_t corners) {
  if (corners < 3) ++skipped_;
  if (odd_) return;
  odd_ = true;
  mesh_.face_of_triangle.reserve(mesh_.triangles.capacity());
  mesh_.face_of_triangle.resize(mesh_.triangles.size());
  std::iota(mesh_.face_of_triangle.begin(), mesh_.face_of_triangle.end(), 0U);
}

void warn_of_faces(std::uint64_t skipped, std::uint64_t odd, const std::string& file,
                   Warnings& warnings) {
  if (skipped > 0)
    warnings.push_back(file + ": " +
                       text::counted(skipped, "face of fewer than three corners is skipped",
                                     "faces of fewer than three corners are skipped"));
  if (odd > 0)
    warnings.push_back(
        file + ": " +
        text::counted(odd, "face that is not a simple polygon or has no normal is cut into a fan",
                      "faces that are not simple polygons or have no normal are cut into fans"));
}

std::uint64_t cut_polygons(Mesh& mesh) {
  const auto& faces = mesh.face_of_triangle;
  std::uint64_t odd_shapes = 0;
  std::vector<std::uint32_t> ring;
  std::vector<MeshPoint> points;
  std::vector<CornerIndices> cut;
  for (std::size_t first = 0, end = 0; first < faces.size(); first = end) {
    for (end = first + 1; end < faces.size() && faces[end] == faces[first];) ++end;
    const FanRange fan{first, end};
    if (end - first == 1) continue;
    ring_of_fan(mesh.triangles, fan, ring);
    points.clear();
    for (const std::uint32_t i : ring) points.push_back(mesh.vertices[i]);
    cut.clear();
    const Triangulation kind = triangulate_face(points, cut);
    if (kind == Triangulation::fallback_fan) ++odd_shapes;
    if (kind == Triangulation::convex_fan) continue;
    write_cut(mesh.triangles, fan, cut, ring);
    write_cut(mesh.texture_triangles, fan, cut, ring);
    write_cut(mesh.normal_triangles, fan, cut, ring);
  }
  return odd_shapes;
}

void cut_polygons(Mesh& mesh, std::uint64_t skipped_faces, const std::string& file,
                  Warnings& warnings) {
  warn_of_faces(skipped_faces, cut_polygons(mesh), file, warnings);
}

}  // namespace fathom::mesh
