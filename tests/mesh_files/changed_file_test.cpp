// Files that others write to while they are streamed: an error that names the file, whatever is in
// them then.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <limits>
#include <thread>

#include "fathom/failures/errors.h"
#include "fathom/mesh_files/triangle_stream.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

template <class T>
std::string bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

/// A square as binary PLY: four vertices, two triangles.
const std::string ply_head =
    "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\nproperty float "
    "y\nproperty float z\nelement face 2\nproperty list uchar uint vertex_indices\nend_header\n";
const std::string ply_vertices = bytes_of<float>({0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1});
const std::string ply_faces =
    '\3' + bytes_of<std::uint32_t>({0, 1, 2}) + '\3' + bytes_of<std::uint32_t>({0, 2, 3});

void overwrite(const fs::path& path, std::size_t offset, const std::string& bytes) {
  // The clock of a file system ticks every few milliseconds.
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  file.seekp(static_cast<std::streamoff>(offset));
  file << bytes;
}

class ChangedFile : public ::testing::Test {
 protected:
  std::unique_ptr<TriangleStream> stream(const std::string& name, const std::string& bytes,
                                         bool mapped = false) {
    path_ = folder_.write(name, bytes);
    ReadOptions options;
    options.map_large_files = mapped;
    Warnings warnings;
    return open_triangle_stream(path_, options, warnings);
  }
  static void expect_refused(const TriangleStream& stream, const std::string& said) {
    EXPECT_THAT(message_of<InputError>([&] { (void)stream.read(0, 2); }), HasSubstr(said));
  }

  ScratchFolder folder_;
  fs::path path_;
};

TEST_F(ChangedFile, EvenWithTheSameBytes) {
  const auto ply = stream("a.ply", ply_head + ply_vertices + ply_faces);
  EXPECT_EQ(ply->read(0, 2).mesh.triangles.size(), 2U);
  overwrite(path_, 0, "ply");
  expect_refused(*ply, "a.ply: has been written to");

  std::string stl(84 + 100, '\0');
  stl[80] = 2;
  const auto triangles = stream("a.stl", stl);
  EXPECT_EQ(triangles->read(0, 2).mesh.triangles.size(), 2U);
  overwrite(path_, 100, "x");
  expect_refused(*triangles, "a.stl: has been written to");
}

TEST_F(ChangedFile, WithVerticesThatAreNotFinite) {
  const auto ply = stream("a.ply", ply_head + ply_vertices + ply_faces, true);
  overwrite(path_, ply_head.size() + 12,
            bytes_of<float>({std::numeric_limits<float>::quiet_NaN(),
                             std::numeric_limits<float>::infinity(), 0}));
  expect_refused(*ply, "a.ply: vertex 1 is not finite any more");
  EXPECT_THAT(message_of<InputError>([&] { (void)ply->triangle(0); }),
              HasSubstr("a.ply: vertex 1 is not finite any more"));
}

TEST_F(ChangedFile, WithFacesThatCannotBe) {
  const auto ply = stream("a.ply", ply_head + ply_vertices + ply_faces);
  const std::size_t faces = ply_head.size() + ply_vertices.size();
  overwrite(path_, faces + 1, bytes_of<std::uint32_t>({0, 1, 4}));
  expect_refused(*ply, "a.ply: ");
  overwrite(path_, faces, "\1");  // of one corner: the rest is read as other faces
  expect_refused(*ply, "a.ply: ");
  overwrite(path_, faces, "\xFF");
  expect_refused(*ply, "a.ply: ");
}

TEST_F(ChangedFile, ThatAreCutShort) {
  for (const bool mapped : {false, true}) {
    const auto ply = stream("a.ply", ply_head + ply_vertices + ply_faces, mapped);
    fs::resize_file(path_, ply_head.size() + ply_vertices.size() + 5);
    expect_refused(*ply, "a.ply: byte ");
    EXPECT_THROW((void)ply->triangle(1), InputError);
  }
}

/// Single triangles are asked for after the chunks have been read.
TEST_F(ChangedFile, WhenSingleTrianglesAreAskedFor) {
  const std::string others = bytes_of<float>({0, 0, 2, 1, 0, 2, 1, 1, 2, 1, 0, 2});
  for (const bool mapped : {false, true}) {
    const auto ply = stream("a.ply", ply_head + ply_vertices + ply_faces, mapped);
    EXPECT_EQ(ply->triangle(0).corners[0].z, 1);
    overwrite(path_, ply_head.size(), others);
    EXPECT_THAT(message_of<InputError>([&] { (void)ply->triangle(0); }),
                HasSubstr("a.ply: has been written to"));
  }
  std::string stl(84 + 100, '\0');
  stl[80] = 2;
  const auto triangles = stream("a.stl", stl);
  overwrite(path_, 100, "x");
  EXPECT_THAT(message_of<InputError>([&] { (void)triangles->triangle(0); }),
              HasSubstr("a.stl: has been written to"));
}

/// Vertices that are read through blocks are those that are mapped.
TEST_F(ChangedFile, OrStayAsTheyAreTwoWays) {
  const auto read = stream("a.ply", ply_head + ply_vertices + ply_faces);
  const auto mapped = stream("b.ply", ply_head + ply_vertices + ply_faces, true);
  for (const std::uint32_t number : {0U, 1U}) {
    const auto one = read->triangle(number).corners, other = mapped->triangle(number).corners;
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(one[i].x, other[i].x);
      EXPECT_EQ(one[i].y, other[i].y);
      EXPECT_EQ(one[i].z, other[i].z);
    }
  }
  const TriangleChunk whole = mapped->read(0, 2);
  EXPECT_EQ(read->read(0, 2).mesh.vertices.size(), whole.mesh.vertices.size());
}

}  // namespace
}  // namespace fathom
