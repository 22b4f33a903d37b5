// Streams against the ordinary reader: the same triangles, faces, warnings and failures.
#include "fathom/mesh_files/triangle_stream.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <limits>
#include <numeric>
#include <random>

#include "fathom/failures/errors.h"
#include "fathom/scene/bounds.h"
#include "fathom/scene/framing.h"
#include "fathom/scene/read_scene.h"
#include "tests/effort.h"
#include "tests/inputs/mesh_variants.h"
#include "tests/places.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;
using test::MeshFile;
using ::testing::HasSubstr;

const fs::path meshes = test::source_dir() / "data/meshes";

/// What a reader makes of a file: its triangles and warnings, or its failure.
struct Reading {
  test::Soup corners;
  std::vector<std::uint32_t> faces;
  std::uint64_t face_count = 0;
  std::vector<double> bounds;
  std::string hash, failure;
  Warnings warnings;
};

Reading read_ordinarily(const fs::path& path, bool hash = true) {
  Reading reading;
  try {
    const Scene scene = read_scene({path}, {.hash = hash}, reading.warnings);
    const Mesh& mesh = scene.meshes.at(0);
    reading.corners = test::soup_of(mesh);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
      reading.faces.push_back(mesh.face_of(t));
    reading.face_count = mesh.face_count;
    reading.hash = scene.sources.at(0).sha256;
    if (const auto box = world_bounds(scene)) {
      reading.bounds.assign(box->lower.begin(), box->lower.end());
      reading.bounds.insert(reading.bounds.end(), box->upper.begin(), box->upper.end());
    }
    // Said of a scene, not of a file.
    std::erase_if(reading.warnings, [](const auto& w) { return w.ends_with("has no faces"); });
  } catch (const InputError& error) {
    reading = {};
    reading.failure = error.what();
  }
  return reading;
}

void append(const TriangleChunk& chunk, Reading& reading) {
  const Mesh& mesh = chunk.mesh;
  EXPECT_EQ(chunk.first, reading.corners.size());
  for (const auto& corners : test::soup_of(mesh)) reading.corners.push_back(corners);
  EXPECT_TRUE(mesh.face_of_triangle.empty() ||
              mesh.face_of_triangle.size() == mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    reading.faces.push_back(mesh.face_of_triangle.empty() ? chunk.first + t
                                                          : mesh.face_of_triangle[t]);
  }
}

/// In chunks of `size` triangles.
Reading read_in_chunks(const fs::path& path, std::uint32_t size, bool hash = true) {
  Reading reading;
  try {
    const auto stream = open_triangle_stream(path, {.hash = hash}, reading.warnings);
    for (std::uint32_t first = 0; first < stream->triangle_count(); first += size)
      append(stream->read(first, size), reading);
    EXPECT_EQ(reading.corners.size(), stream->triangle_count());
    reading.face_count = stream->face_count();
    reading.hash = stream->source.sha256;
    EXPECT_EQ(stream->source.path, path.string());
    if (const auto box = stream->bounds()) {
      for (const MeshPoint& p : {box->lower, box->upper})
        for (const double x : {p.x, p.y, p.z}) reading.bounds.push_back(x + 0.0);
    }
  } catch (const InputError& error) {
    reading = {};
    reading.failure = error.what();
  }
  return reading;
}

/// One triangle after the other, in an order that jumps.
Reading read_one_by_one(const fs::path& path) {
  Reading reading = read_in_chunks(path, 1U << 20);
  if (!reading.failure.empty()) return reading;
  Warnings ignored;
  const auto stream = open_triangle_stream(path, {.hash = false}, ignored);
  const std::uint32_t count = stream->triangle_count();
  reading.corners.assign(count, {});
  reading.faces.assign(count, 0);
  std::uint32_t step = count / 2 + 1;
  while (std::gcd(step, count) != 1) ++step;
  for (std::uint32_t i = 0, t = 0; i < count;
       ++i, t = static_cast<std::uint32_t>((std::uint64_t{t} + step) % count)) {
    const TriangleStream::Triangle triangle = stream->triangle(t);
    reading.corners[t] = triangle.corners;
    reading.faces[t] = triangle.face;
  }
  return reading;
}

void expect_same(const Reading& ours, const Reading& truth, const std::string& what) {
  EXPECT_EQ(ours.failure, truth.failure) << what;
  EXPECT_EQ(ours.warnings, truth.warnings) << what;
  EXPECT_TRUE(ours.corners == truth.corners) << what;
  EXPECT_TRUE(ours.faces == truth.faces) << what;
  EXPECT_EQ(ours.face_count, truth.face_count) << what;
  EXPECT_EQ(ours.bounds, truth.bounds) << what;
  EXPECT_EQ(ours.hash, truth.hash) << what;
}

/// The truth, so that a test can see that it was about something.
Reading expect_streamed(const fs::path& path) {
  const Reading truth = read_ordinarily(path);
  for (const std::uint32_t size : {1U, 2U, 3U, 7U, 1000U, 1U << 20})
    expect_same(read_in_chunks(path, size), truth, "chunks of " + std::to_string(size));
  expect_same(read_one_by_one(path), truth, "one by one");
  return truth;
}

TEST(TriangleStream, FilesInData) {
  int files = 0;
  for (const auto& entry : fs::directory_iterator(meshes)) {
    const std::string name = entry.path().filename().string();
    const bool binary =
        name == "cube-big-endian.ply" || name == "cube-little-endian.ply" || name == "cube.stl";
    SCOPED_TRACE(name);
    if (binary) {
      EXPECT_EQ(expect_streamed(entry.path()).failure, "");
      ++files;
    } else {
      EXPECT_THAT(read_in_chunks(entry.path(), 9).failure,
                  HasSubstr("is not a binary STL or PLY, the formats that can be streamed"));
    }
  }
  EXPECT_EQ(files, 3);
}

TEST(TriangleStream, EveryVariantOfTheFormats) {
  const ScratchFolder folder;
  int variants = 0;
  for (const MeshFile& file : test::variants_of(test::sample_mesh())) {
    if (!file.name.starts_with("binary")) continue;
    SCOPED_TRACE(file.name);
    const Reading truth = expect_streamed(folder.write(file.name, file.bytes));
    EXPECT_EQ(truth.failure, "");
    EXPECT_EQ(truth.corners.size(), 5U);
    ++variants;
  }
  EXPECT_GE(variants, 30);
}

/// Cut at every byte, and every byte changed: the same failure, or the same triangles.
TEST(TriangleStream, BrokenFilesFailAlike) {
  const ScratchFolder folder;
  int failures = 0, readings = 0, files = 0;
  const auto check = [&](const std::string& name, const std::string& bytes, std::size_t at) {
    // A new name each time: some file systems wait for the disk when a file is written over.
    const fs::path path = folder.write(std::to_string(++files) + " " + name, bytes);
    const Reading truth = read_ordinarily(path, false);
    const Reading ours = read_in_chunks(path, 2, false);
    fs::remove(path);
    if (ours.failure.find("is not a binary STL or PLY") != std::string::npos) return;
    ++(truth.failure.empty() ? readings : failures);
    expect_same(ours, truth, name + ", byte " + std::to_string(at));
  };
  for (const MeshFile& file : test::variants_of(test::sample_mesh())) {
    const bool chosen =
        file.name == "binary.stl" || file.name == "binary_little_endian float.ply" ||
        file.name == "binary_big_endian extras.ply" || file.name == "binary_big_endian int16.ply" ||
        file.name == "binary_little_endian extras double.ply";
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
  EXPECT_GT(failures, 1000);
  EXPECT_GT(readings, 500);
}

template <class T>
void put(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// A little endian PLY of random faces: shares of faces of other than three corners, and of a list
/// property beside the corners.
std::string random_ply(std::mt19937_64& random, std::uint32_t vertices, std::uint32_t faces,
                       int other_faces, bool lists, bool faces_first) {
  const std::string vertex_head = "element vertex " + std::to_string(vertices) +
                                  "\nproperty float x\nproperty double y\nproperty short z\n";
  const std::string face_head = "element face " + std::to_string(faces) +
                                "\nproperty list uchar int vertex_indices\n" +
                                (lists ? "property list ushort float weights\n" : "");
  std::string bytes = "ply\nformat binary_little_endian 1.0\n" +
                      (faces_first ? face_head + vertex_head : vertex_head + face_head) +
                      "end_header\n";
  const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
  std::string vertex_rows, face_rows;
  for (std::uint32_t i = 0; i < vertices; ++i) {
    put(vertex_rows, static_cast<float>(below(64)));
    put(vertex_rows, static_cast<double>(below(64)));
    put(vertex_rows, static_cast<std::int16_t>(below(8) == 0 ? 1 : 0));
  }
  for (std::uint32_t i = 0; i < faces; ++i) {
    const std::uint32_t corners = below(100) < static_cast<unsigned>(other_faces) ? below(9) : 3;
    put(face_rows, static_cast<std::uint8_t>(corners));
    for (std::uint32_t k = 0; k < corners; ++k)
      put(face_rows, static_cast<std::int32_t>(below(vertices)));
    if (!lists) continue;
    const std::uint32_t weights = below(3);
    put(face_rows, static_cast<std::uint16_t>(weights));
    for (std::uint32_t k = 0; k < weights; ++k) put(face_rows, 0.5F);
  }
  return bytes + (faces_first ? face_rows + vertex_rows : vertex_rows + face_rows);
}

/// Polygons, convex and not, simple and not, skipped faces, rows of different sizes, over many
/// entries of the index.
TEST(TriangleStream, RandomPly) {
  const ScratchFolder folder;
  std::mt19937_64 random(31);
  int warned = 0, uneven = 0;
  const int files = checks::effort > 1 ? 12 : 60;
  const std::uint32_t many = checks::effort > 1 ? 600 : 2000;
  for (int i = 0; i < files; ++i) {
    SCOPED_TRACE("file " + std::to_string(i) + " of seed 31");
    const int other_faces = std::array{0, 2, 50, 100}[i % 4];
    const std::string bytes =
        random_ply(random, 40, i % 3 == 0 ? many : 5, other_faces, i % 5 == 1, i % 7 == 2);
    const Reading truth = expect_streamed(folder.write(std::to_string(i) + ".ply", bytes));
    EXPECT_EQ(truth.failure, "");
    warned += truth.warnings.size() == 2 ? 1 : 0;
    uneven += truth.faces.size() != truth.face_count ? 1 : 0;
    if (::testing::Test::HasFailure()) return;
  }
  EXPECT_GT(warned, files / 3);
  EXPECT_GT(uneven, files / 3);
}

/// Larger than what is read at once: 1 MiB of rows, 16384 triangles of an STL.
TEST(TriangleStream, ManyWindows) {
  const ScratchFolder folder;
  std::mt19937_64 random(32);
  const fs::path ply =
      folder.write("large.ply", random_ply(random, 100000, 120000, 5, true, false));
  const Reading truth = read_ordinarily(ply);
  EXPECT_GT(fs::file_size(ply), std::uintmax_t{2} << 20);
  EXPECT_EQ(truth.failure, "");
  expect_same(read_in_chunks(ply, 1000), truth, "PLY");

  std::string stl(80, ' ');
  put(stl, std::uint32_t{40000});
  for (int t = 0; t < 40000; ++t) {
    for (int k = 0; k < 12; ++k) put(stl, static_cast<float>(random() % 1000));
    put(stl, std::uint16_t{0});
  }
  const fs::path path = folder.write("large.stl", stl);
  expect_same(read_in_chunks(path, 30000), read_ordinarily(path), "STL");
  expect_same(read_one_by_one(path), read_ordinarily(path), "STL");
}

TEST(TriangleStream, TheLastFaceIsCheckedToo) {
  const ScratchFolder folder;
  std::mt19937_64 random(33);
  std::string bytes = random_ply(random, 50, 3000, 0, false, false);
  const std::int32_t index = 50;
  std::memcpy(bytes.data() + bytes.size() - 4, &index, 4);
  EXPECT_THAT(expect_streamed(folder.write("index.ply", bytes)).failure,
              HasSubstr("index 50 is out of range, expected 0 to 49"));

  std::string stl(84 + 50 * 20000, '\0');
  const std::uint32_t count = 20000;
  std::memcpy(stl.data() + 80, &count, 4);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(stl.data() + stl.size() - 6, &nan, 4);
  EXPECT_THAT(expect_streamed(folder.write("nan.stl", stl)).failure,
              HasSubstr("a coordinate of triangle 19999 is not finite"));
  stl.resize(stl.size() - 1);
  EXPECT_THAT(expect_streamed(folder.write("short.stl", stl)).failure,
              HasSubstr("the file ends, expected 1000084 bytes"));
}

TEST(TriangleStream, WhatIsNoFile) {
  const ScratchFolder folder;
  EXPECT_THAT(read_in_chunks(folder.path() / "missing.stl", 1).failure,
              HasSubstr("missing.stl: cannot be opened: No such file"));
  EXPECT_THAT(read_in_chunks(folder.path(), 1).failure, HasSubstr("is a directory"));
  EXPECT_THAT(read_in_chunks(folder.write("empty.stl", ""), 1).failure, HasSubstr("is empty"));
  const fs::path pipe = folder.path() / "pipe.stl";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(read_in_chunks(pipe, 1).failure, HasSubstr("is not a regular file"));
}

/// Cut short after it was opened: a failure, not a wrong triangle.
TEST(TriangleStream, FileCutShortMeanwhile) {
  const ScratchFolder folder;
  std::string stl(84 + 50 * 1000, '\0');
  const std::uint32_t count = 1000;
  std::memcpy(stl.data() + 80, &count, 4);
  const fs::path path = folder.write("a.stl", stl);
  Warnings warnings;
  const auto stream = open_triangle_stream(path, {}, warnings);
  fs::resize_file(path, 84 + 50 * 500);
  EXPECT_THAT(message_of<InputError>([&] { (void)stream->triangle(499); }),
              HasSubstr("has been cut short"));
  EXPECT_THAT(message_of<InputError>([&] { (void)stream->triangle(500); }),
              HasSubstr("the file ends"));
  EXPECT_THAT(message_of<InputError>([&] { (void)stream->read(0, 1000); }),
              HasSubstr("the file ends"));
}

#if !defined(FATHOM_SANITIZED)
std::string ply_with(const std::string& vertices, const std::string& faces) {
  return "ply\nformat binary_little_endian 1.0\nelement vertex " + vertices +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

/// The bytes `block` again and again behind `head`.
fs::path write_repeated(const ScratchFolder& folder, const std::string& name,
                        const std::string& head, const std::string& block, int times) {
  const fs::path path = folder.write(name, head);
  std::ofstream file(path, std::ios::binary | std::ios::app);
  for (int i = 0; i < times; ++i) file << block;
  return path;
}

/// Addresses that this process has taken, in bytes.
std::uint64_t addresses_taken() {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

/// 250 MB of STL and 272 MB of PLY within 100 MB more addresses than were taken before; of the PLY,
/// the vertices fit.
TEST(TriangleStream, FilesLargerThanTheMemoryAllowed) {
  const ScratchFolder folder;
  std::string triangles, rows;
  for (int i = 0; i < 50000; ++i) triangles += std::string(50, '\0');
  for (std::int32_t i = 0; i < 200000; ++i) {
    rows += '\3';
    for (const std::int32_t index : {0, i, 999999}) put(rows, index);
  }
  std::string stl(80, ' ');
  put(stl, std::uint32_t{5000000});
  const fs::path stl_path = write_repeated(folder, "large.stl", stl, triangles, 100);
  const std::string ply = ply_with("1000000", "20000000") + std::string(12000000, '\0');
  const fs::path ply_path = write_repeated(folder, "large.ply", ply, rows, 100);

  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const rlim_t most = addresses_taken() + (rlim_t{100} << 20);
    const rlimit limit{most, most};
    if (setrlimit(RLIMIT_AS, &limit) != 0) _exit(3);
    try {
      Warnings warnings;
      const auto stl_stream = open_triangle_stream(stl_path, {.hash = false}, warnings);
      if (stl_stream->triangle_count() != 5000000) _exit(4);
      if (stl_stream->read(4999000, 2000).mesh.triangles.size() != 1000) _exit(5);
      const auto ply_stream = open_triangle_stream(ply_path, {.hash = false}, warnings);
      if (ply_stream->triangle_count() != 20000000) _exit(6);
      if (ply_stream->triangle(19999999).face != 19999999) _exit(7);
      if (!warnings.empty()) _exit(8);
    } catch (...) {
      _exit(2);
    }
    _exit(0);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

/// A header's claims take no memory.
TEST(TriangleStream, ClaimsTakeNoMemory) {
  const ScratchFolder folder;
  const std::string claims = ply_with("4200000000", "4200000000") + std::string(1000, '\1');
  // A face before the vertices, with indices that only such a number of vertices allows.
  const std::string faces_first =
      "ply\nformat binary_little_endian 1.0\nelement face 1\nproperty list uchar uint "
      "vertex_indices\nelement vertex 4200000000\nproperty float x\nproperty float y\nproperty "
      "float z\nend_header\n\3" +
      std::string(1000, '\xEE');
  const fs::path a = folder.write("a.ply", claims), b = folder.write("b.ply", faces_first);
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const rlim_t most = addresses_taken() + (rlim_t{100} << 20);
    const rlimit limit{most, most};
    if (setrlimit(RLIMIT_AS, &limit) != 0) _exit(3);
    int refused = 0;
    for (const fs::path& path : {a, b}) {
      try {
        Warnings warnings;
        open_triangle_stream(path, {.hash = false}, warnings);
      } catch (const InputError&) {
        ++refused;
      } catch (...) {
        _exit(2);
      }
    }
    _exit(refused == 2 ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}
#endif

}  // namespace
}  // namespace fathom
