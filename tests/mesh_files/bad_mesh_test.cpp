#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "fathom/failures/errors.h"
#include "tests/inputs/mesh_variants.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using test::MeshFile;
using test::read_variant;
using testing::AnyOf;
using testing::HasSubstr;
using testing::StartsWith;

std::string failure(const std::string& name, const std::string& bytes) {
  return message_of<InputError>([&] {
    Warnings warnings;
    read_variant({name, bytes}, warnings);
  });
}

void expect_valid(const Mesh& mesh, const std::string& name) {
  for (const CornerIndices& t : mesh.triangles)
    for (const std::uint32_t i : t) ASSERT_LT(i, mesh.vertices.size()) << name;
  for (const MeshPoint& p : mesh.vertices)
    ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) << name;
}

/// An InputError or a valid mesh; nothing else.
void read_whatever(const MeshFile& file) {
  Warnings warnings;
  try {
    expect_valid(read_variant(file, warnings, true), file.name);
  } catch (const InputError& e) {
    ASSERT_EQ(std::string(e.what()).find('\n'), std::string::npos) << file.name;
  }
}

TEST(BadMesh, CutAtEveryByte) {
  for (const MeshFile& file : test::variants_of(test::sample_mesh()))
    for (std::size_t size = 0; size < file.bytes.size(); ++size)
      ASSERT_NO_FATAL_FAILURE(read_whatever({file.name, file.bytes.substr(0, size)}));
}

TEST(BadMesh, EveryByteChanged) {
  for (const MeshFile& file : test::variants_of(test::sample_mesh())) {
    for (std::size_t at = 0; at < file.bytes.size(); ++at) {
      for (const int mask : {0x01, 0x80, 0xFF}) {
        std::string bytes = file.bytes;
        bytes[at] = static_cast<char>(bytes[at] ^ mask);
        ASSERT_NO_FATAL_FAILURE(read_whatever({file.name, bytes}));
      }
    }
  }
}

TEST(BadMesh, BinaryFilesCutShortAreRefused) {
  for (const MeshFile& file : test::variants_of(test::sample_mesh())) {
    const bool binary = file.name.starts_with("binary");
    if (!binary) continue;
    const bool has_suffix = file.name.find('.') != std::string::npos;
    const MeshFile cut{file.name, file.bytes.substr(0, file.bytes.size() - 1)};
    if (!has_suffix) continue;
    EXPECT_THAT(failure(cut.name, cut.bytes),
                AnyOf(HasSubstr("the file ends"), HasSubstr("file long enough")))
        << file.name;
  }
}

struct BadCase {
  std::string name, bytes, message;
};
void PrintTo(const BadCase& bad, std::ostream* out) {
  *out << bad.name;
}

class BadMeshCase : public testing::TestWithParam<BadCase> {};

TEST_P(BadMeshCase, IsRefusedWithItsPlace) {
  const BadCase& bad = GetParam();
  const std::string message = failure(bad.name, bad.bytes);
  EXPECT_THAT(message, StartsWith(bad.name + ": "));
  EXPECT_THAT(message, HasSubstr(bad.message));
}

const std::string v3 = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
const std::string ply_head =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
    "z\nelement face "
    "1\nproperty list uchar int vertex_indices\nend_header\n";
const std::string ply_points = "0 0 0\n1 0 0\n0 1 0\n";
const std::string off_points = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";
const std::string stl_head =
    "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n";

std::string ply_claiming(const std::string& format, const std::string& vertices,
                         const std::string& faces) {
  return "ply\nformat " + format + " 1.0\nelement vertex " + vertices +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
         "\nproperty list uchar int vertex_indices\nend_header\n" + std::string(600, '\1');
}

std::string stl_claiming(std::uint32_t count, std::size_t size) {
  std::string bytes(size, '\0');
  std::memcpy(bytes.data() + 80, &count, 4);
  return bytes;
}

std::string stl_with(float x) {
  std::string bytes = stl_claiming(1, 134);
  std::memcpy(bytes.data() + 84 + 12 + 20, &x, 4);
  return bytes;
}

const BadCase bad_cases[] = {
    {"index.obj", v3 + "\nf 1 2 4\n", "line 5: vertex index 4 is out of range, expected 1 to 3"},
    {"zero.obj", v3 + "f 1 0 3\n", "line 4: vertex index 0 is out of range"},
    {"negative.obj", v3 + "f -1 -2 -4\n", "line 4: vertex index -4 is out of range"},
    {"negative forward.obj", "v 0 0 0\nf -1 -1 -2\nv 0 0 0\n", "line 2: vertex index -2"},
    {"corner.obj", v3 + "f 1 2 x\n", "line 4: expected a corner"},
    {"corner2.obj", v3 + "f 1 2 3/1/1/1\n", "line 4: "},
    {"corner3.obj", v3 + "f 1 2 3,\n", "line 4: expected a corner"},
    {"huge index.obj", v3 + "f 1 2 99999999999999999999\n", "line 4: expected a corner"},
    {"nan.obj", "v 0 0 0\nv 0 nan 0\n", "line 2: coordinate y is not finite"},
    {"inf.obj", "v -inf 0 0\n", "line 1: coordinate x is not finite"},
    {"large.obj", "v 0 0 1e400\n", "line 1: coordinate z is too large"},
    {"word.obj", "v 0 0 zero\n", "line 1: expected coordinate z, found 'zero'"},
    {"short.obj", "v 0 0 0\nv 0 0\n", "line 2: expected coordinate z, found the end of the line"},
    {"after continuation.obj", "v 0 \\\n0 0\nv 0 0\n", "line 3: expected coordinate z"},
    {"unknown.obj", "?\n", "holds neither vertices nor faces, expected an OBJ file"},
    {"index.ply", ply_head + ply_points + "3 0 1 3\n",
     "line 13: index 3 is out of range, expected 0 to 2"},
    {"negative.ply", ply_head + ply_points + "3 0 1 -1\n", "line 13: index -1 is out of range"},
    {"nan.ply", ply_head + "0 0 0\n0 0 nan\n0 0 0\n3 0 1 2\n",
     "line 11: coordinate z is not finite"},
    {"large.ply", ply_head + "0 0 0\n0 3.5e38 0\n0 0 0\n3 0 1 2\n",
     "line 11: coordinate y is too large"},
    {"short row.ply", ply_head + "0 0\n0 0 0\n0 0 0\n3 0 1 2\n", "line 10: expected coordinate z"},
    {"long row.ply", ply_head + "0 0 0 0\n0 0 0\n0 0 0\n3 0 1 2\n",
     "line 10: expected the line to end"},
    {"few rows.ply", ply_head + ply_points + "   \n\n        ",
     "the file ends after 0 of 1 rows of element face"},
    {"list.ply", ply_head + ply_points + "-3 0 1 2\n",
     "line 13: the count of a list -3 does not fit"},
    {"type.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\n",
     "line 4: expected a type"},
    {"format.ply", "ply\nformat ebcdic 1.0\n", "line 2: expected ascii"},
    {"version.ply", "ply\nformat ascii 2.0\n", "line 2: expected version 1.0"},
    {"no end.ply", "ply\nformat ascii 1.0\n", "expected end_header"},
    {"no vertex.ply", "ply\nformat ascii 1.0\nend_header\n", "has no element vertex"},
    {"no x.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float y\nend_header\n0\n",
     "lacks x, y or z"},
    {"no properties.ply",
     "ply\nformat ascii 1.0\nelement vertex 3\nelement face 1\nproperty list uchar int "
     "vertex_indices\nend_header\n3 0 1 2\n",
     "lacks x, y or z"},
    {"no indices.ply",
     "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float "
     "z\nelement face "
     "1\nproperty int a\nend_header\n0\n",
     "lacks the list vertex_indices"},
    {"twice.ply", "ply\nformat ascii 1.0\nelement vertex 0\nelement vertex 0\n",
     "line 4: element 'vertex' stands twice"},
    {"claims.ply", ply_claiming("ascii", "4000000000", "1"),
     "4000000000 rows of element vertex are claimed"},
    {"claims faces.ply", ply_claiming("binary_little_endian", "3", "4000000000"),
     "4000000000 rows of element face are claimed"},
    {"claims big.ply", ply_claiming("binary_big_endian", "3", "9999999999999"),
     "more than the 4294967294"},
    {"claims more.ply", ply_claiming("binary_big_endian", "99999999999999999999", "1"),
     "line 3: expected a number"},
    {"index.off", off_points + "3 0 1 3\n", "line 6: index 3 is out of range, expected 0 to 2"},
    {"negative.off", off_points + "3 0 1 -1\n", "line 6: index -1 is out of range"},
    {"inf.off", "OFF\n3 1 0\n0 0 inf\n", "are claimed"},
    {"inf2.off", "OFF\n1 0 0\n0 0 inf\n", "line 3: coordinate z is not finite"},
    {"few.off", "OFF\n2 0 0\n0 0 0          \n", "the file ends after 1 of 2 vertices"},
    {"corners.off", off_points + "3 0 1\n",
     "line 6: expected the index of a vertex, found the end of the line"},
    {"many corners.off", off_points + "4000000000 0 1 2\n",
     "line 6: expected the index of a vertex"},
    {"minus corners.off", off_points + "-1 0 1 2\n",
     "line 6: expected a number of corners, found a negative one"},
    {"claims.off", "OFF\n4000000000 4000000000 0\n" + std::string(900, '1'), "are claimed"},
    {"negative count.off", "OFF\n-1 0 0\n",
     "line 2: expected a number of vertices, found a negative one"},
    {"binary.off", "OFF BINARY\n...", "line 1: binary OFF is not supported"},
    {"four.off", "4OFF\n0 0 0\n", "line 1: 4OFF is not supported"},
    {"one byte.off", "4", "expected a number of faces"},
    {"empty.off", "#\n", "expected OFF and the counts"},
    {"nan.stl", stl_with(std::numeric_limits<float>::quiet_NaN()),
     "byte 116: a coordinate of triangle 0 is not finite"},
    {"inf.stl", stl_with(-std::numeric_limits<float>::infinity()),
     "byte 116: a coordinate of triangle 0"},
    {"claims.stl", stl_claiming(4000000000U, 1000),
     "byte 1000: the file ends, expected 200000000084 bytes"},
    {"small.stl", std::string(83, '\1'), "byte 83: the file ends, expected a binary STL header"},
    {"ascii cut.stl", stl_head, "the file ends, expected 'vertex'"},
    {"ascii nan.stl", stl_head + "vertex 0 nan 0\n", "line 6: coordinate y is not finite"},
    {"ascii four.stl", stl_head + "vertex 0 1 0\nvertex 0 1 1\n", "line 7: expected 'endloop'"},
    {"ascii word.stl", "solid a\nfacette\n", "line 2: expected 'facet' or 'endsolid'"},
};
INSTANTIATE_TEST_SUITE_P(All, BadMeshCase, testing::ValuesIn(bad_cases), [](const auto& test) {
  std::string name = test.param.name;
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return name;
});

/// A header's claim must not be believed: in half a gigabyte of address space
/// nothing may fail but with InputError.
TEST(BadMesh, ClaimsTakeNoMemory) {
#if defined(FATHOM_SANITIZED)
  constexpr bool limits_memory = false;  // the sanitizers' shadow takes terabytes of addresses
#else
  constexpr bool limits_memory = true;
#endif
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    if (limits_memory) {
      const rlimit limit{std::uint64_t{512} << 20, std::uint64_t{512} << 20};
      if (setrlimit(RLIMIT_AS, &limit) != 0) _exit(3);
    }
    int refused = 0;
    for (const MeshFile& file :
         {MeshFile{"a.ply", ply_claiming("ascii", "4000000000", "1")},
          MeshFile{"b.ply", ply_claiming("binary_little_endian", "4000000000", "1")},
          MeshFile{"c.ply", ply_claiming("binary_little_endian", "3", "4000000000")},
          MeshFile{"d.off", "OFF\n4000000000 4000000000 0\n" + std::string(900, '1')},
          MeshFile{"e.off", off_points + "4000000000 0 1 2\n"},
          MeshFile{"f.stl", stl_claiming(4000000000U, 1000)}}) {
      try {
        Warnings warnings;
        read_variant(file, warnings, true);
      } catch (const InputError&) {
        ++refused;
      } catch (...) {
        _exit(2);
      }
    }
    _exit(refused == 6 ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace
}  // namespace fathom
