// Faces from hard families in files that are read in any floating-point mode: they are cut as they
// are where rounding is to nearest. tests/mesh/ holds that to rational numbers.
#include <gtest/gtest.h>

#include <cstdio>

#include "fathom/failures/errors.h"
#include "fathom/mesh/triangulate_face.h"
#include "fathom/scene/read_scene.h"
#include "tests/adversaries.h"
#include "tests/inputs/floating_point_modes.h"
#include "tests/inputs/hard_faces.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using checks::Draw;
using checks::Ring;

/// Faces as an OBJ file has them; no two share corners.
struct File {
  std::string text;
  std::vector<MeshPoint> vertices;
  std::vector<CornerIndices> triangles;

  void add(const Ring& ring) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    std::string face = "f";
    for (const MeshPoint& p : ring) {
      char line[120];
      std::snprintf(line, sizeof line, "v %.17g %.17g %.17g\n", p.x, p.y, p.z);
      text += line;
      vertices.push_back(p);
      face += " " + std::to_string(vertices.size());
    }
    text += face + "\n";
    std::vector<std::array<std::uint32_t, 3>> cut;
    mesh::triangulate_face(ring, cut);
    for (const auto& [a, b, c] : cut) triangles.push_back({first + a, first + b, first + c});
  }
};

Mesh read_in_mode(const std::filesystem::path& path, const checks::FloatingPointMode* mode) {
  const checks::InMode in_mode(mode);
  Warnings warnings;
  return read_scene({path}, {}, warnings).meshes.at(0);
}

TEST(FacesAdversaries, AreCutAlikeInEveryMode) {
  checks::for_each_adversary(60, [](std::uint64_t seed) {
    Draw draw(seed);
    File file;
    for (std::uint64_t k = 0; k < 30; ++k) {
      file.add(checks::hard_face(draw.one_of(checks::all_face_families), 30 * seed + k));
    }
    const ScratchFolder folder;
    const Mesh mesh =
        read_in_mode(folder.write("faces.obj", file.text), &draw.one_of(checks::other_modes));
    EXPECT_EQ(mesh.vertices, file.vertices);
    EXPECT_EQ(mesh.triangles, file.triangles);
  });
}

}  // namespace
}  // namespace fathom
