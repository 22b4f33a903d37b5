// Streams of files that are opened without being read through: when all parts have been checked and
// all triangles read, the same as by the ordinary reader, its warnings and failures included.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "fathom/failures/errors.h"
#include "fathom/mesh_files/triangle_stream.h"
#include "fathom/scene/read_scene.h"
#include "tests/inputs/mesh_variants.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;
using test::MeshFile;

/// What is made of a file: its triangles and warnings, or its failure.
struct Made {
  test::Soup corners;
  std::vector<std::uint32_t> faces;
  std::string failure;
  Warnings warnings;
  /// Whether the file was what its size lets suppose.
  bool as_supposed = true;
};

void expect_same(const Made& ours, const Made& truth, const std::string& what) {
  EXPECT_EQ(ours.failure, truth.failure) << what;
  EXPECT_EQ(ours.warnings, truth.warnings) << what;
  EXPECT_TRUE(ours.corners == truth.corners) << what;
  EXPECT_TRUE(ours.faces == truth.faces) << what;
}

Made made_ordinarily(const fs::path& path) {
  Made made;
  try {
    const Scene scene = read_scene({path}, {.hash = false}, made.warnings);
    const Mesh& mesh = scene.meshes.at(0);
    made.corners = test::soup_of(mesh);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) made.faces.push_back(mesh.face_of(t));
    std::erase_if(made.warnings, [](const auto& w) { return w.ends_with("has no faces"); });
  } catch (const InputError& error) {
    made.failure = error.what();
    made.warnings = {};
  }
  return made;
}

bool check_parts(const TriangleStream& stream, std::uint64_t parts) {
  bool holds = true;
  for (std::uint64_t part = parts; part-- > 0;) holds = stream.check_part(part, parts) && holds;
  return holds;
}

/// As ranks do it: opened again where a part is not as it was supposed to be.
Made made_of_parts(const fs::path& path, std::uint64_t parts) {
  Made made;
  try {
    ReadOptions options{.check_when_opened = false, .hash = false};
    auto stream = open_triangle_stream(path, options, made.warnings);
    made.as_supposed = check_parts(*stream, parts);
    if (!made.as_supposed) {
      options.check_when_opened = true;
      made.warnings = {};
      stream = open_triangle_stream(path, options, made.warnings);
    }
    const Mesh mesh = stream->read(0, stream->triangle_count()).mesh;
    made.corners = test::soup_of(mesh);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      made.faces.push_back(mesh.face_of(t));
      EXPECT_EQ(stream->triangle(t).corners, made.corners[t]);
      EXPECT_EQ(stream->face_of(t), mesh.face_of(t));
    }
  } catch (const InputError& error) {
    made.failure = error.what();
    made.warnings = {};
    made.corners = {};
    made.faces = {};
  }
  return made;
}

TEST(UncheckedStream, EveryVariantOfTheFormats) {
  const ScratchFolder folder;
  int variants = 0;
  for (const MeshFile& file : test::variants_of(test::sample_mesh())) {
    if (!file.name.starts_with("binary")) continue;
    const fs::path path = folder.write(file.name, file.bytes);
    for (const std::uint64_t parts : {1U, 2U, 3U, 9U})
      expect_same(made_of_parts(path, parts), made_ordinarily(path), file.name);
    ++variants;
  }
  EXPECT_GE(variants, 30);
}

/// Cut at every byte, and every byte changed: the same failure, or the same triangles.
TEST(UncheckedStream, BrokenFilesFailAlike) {
  const ScratchFolder folder;
  int failures = 0, readings = 0, files = 0, not_as_supposed = 0;
  const auto check = [&](const std::string& name, const std::string& bytes, std::size_t at) {
    const fs::path path = folder.write(std::to_string(++files) + " " + name, bytes);
    const Made truth = made_ordinarily(path), ours = made_of_parts(path, 2);
    fs::remove(path);
    if (ours.failure.find("is not a binary STL or PLY") != std::string::npos) return;
    ++(truth.failure.empty() ? readings : failures);
    not_as_supposed += ours.as_supposed ? 0 : 1;
    expect_same(ours, truth, name + ", byte " + std::to_string(at));
  };
  for (const MeshFile& file : test::variants_of(test::sample_mesh())) {
    const bool chosen = file.name == "binary_little_endian float.ply" ||
                        file.name == "binary_big_endian extras.ply" ||
                        file.name == "binary_big_endian int16.ply";
    if (!chosen) continue;
    for (std::size_t at = 0; at < file.bytes.size(); ++at) {
      if (at > 0) check(file.name, file.bytes.substr(0, at), at);
      for (const int mask : {0x01, 0xFF}) {
        std::string bytes = file.bytes;
        bytes[at] = static_cast<char>(bytes[at] ^ mask);
        check(file.name, bytes, at);
      }
      if (::testing::Test::HasFailure()) return;
    }
  }
  EXPECT_GT(failures, 500);
  EXPECT_GT(readings, 200);
  EXPECT_GT(not_as_supposed, 10);
}

template <class T>
void append(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// A PLY whose faces have so many corners, little endian, with an element before its vertices.
std::string ply_of(const std::vector<std::uint8_t>& corners, std::mt19937& random) {
  constexpr std::uint32_t vertices = 50;
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement camera 2\nproperty double t\n"
      "element vertex 50\nproperty float x\nproperty float y\nproperty float z\n"
      "element face " +
      std::to_string(corners.size()) +
      "\nproperty list uchar int vertex_indices\nproperty uchar flags\nend_header\n";
  append(bytes, 1.5);
  append(bytes, 2.5);
  for (std::uint32_t i = 0; i < 3 * vertices; ++i) append(bytes, static_cast<float>(random() % 32));
  for (const std::uint8_t count : corners) {
    append(bytes, count);
    for (int k = 0; k < count; ++k) append(bytes, static_cast<std::int32_t>(random() % vertices));
    append(bytes, std::uint8_t{3});
  }
  return bytes;
}

/// A file of the size that triangles would have is not taken for one of triangles.
TEST(UncheckedStream, AFaceOfTwoCornersAndOneOfFour) {
  const ScratchFolder folder;
  std::mt19937 random(34);
  std::vector<std::uint8_t> corners(40, 3);
  const fs::path triangles = folder.write("triangles.ply", ply_of(corners, random));
  for (const std::uint64_t parts : {1U, 3U, 50U}) {
    const Made made = made_of_parts(triangles, parts);
    EXPECT_TRUE(made.as_supposed);
    expect_same(made, made_ordinarily(triangles), "triangles");
  }
  corners[0] = 2;
  corners[1] = 4;
  for (int i = 0; i < 30; ++i) {
    const fs::path path = folder.write(std::to_string(i) + ".ply", ply_of(corners, random));
    for (const std::uint64_t parts : {1U, 3U}) {
      const Made made = made_of_parts(path, parts);
      EXPECT_FALSE(made.as_supposed);
      EXPECT_EQ(made.failure, "");
      expect_same(made, made_ordinarily(path), std::to_string(i));
    }
    std::shuffle(corners.begin(), corners.end(), random);
  }
}

/// Whoever does not ask is told, not given wrong triangles.
TEST(UncheckedStream, ReadingChecksToo) {
  const ScratchFolder folder;
  std::mt19937 random(35);
  const fs::path path = folder.write("mixed.ply", ply_of({3, 3, 2, 4, 3}, random));
  Warnings warnings;
  const auto stream = open_triangle_stream(path, {.check_when_opened = false}, warnings);
  EXPECT_EQ(stream->triangle_count(), 5U);
  EXPECT_FALSE(stream->bounds());
  EXPECT_EQ(stream->read(0, 2).mesh.triangles.size(), 2U);
  EXPECT_THROW((void)stream->read(0, 3), InputError);
  EXPECT_THROW((void)stream->triangle(2), InputError);
}

}  // namespace
}  // namespace fathom
