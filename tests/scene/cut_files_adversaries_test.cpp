// Mesh files that another program cuts short while they are read: the scene of before, that of the
// shorter file, or an InputError, never a third scene and never a signal. Files of more than 64
// MiB, of which programs map those that they may (ReadOptions::map_large_files).
#include <gtest/gtest.h>

#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <thread>

#include "fathom/failures/errors.h"
#include "fathom/scene/read_scene.h"
#include "fathom/scene/streamed_scene.h"
#include "tests/adversaries.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::size_t padding = std::size_t{66} << 20;

/// A triangle behind a comment that nobody reads.
std::string padded_obj() {
  return "v 0 0 4\nv 1 0 4\n#" + std::string(padding, ' ') + "\nv 0 1 4\nf 1 2 3\n";
}

/// Triangles that are points, but for the last one.
std::string padded_stl() {
  const auto count = static_cast<std::uint32_t>(padding / 50);
  std::string stl(84 + 50 * std::size_t{count}, '\0');
  std::memcpy(&stl[80], &count, 4);
  const float corner = 1;
  std::memcpy(&stl[stl.size() - 50 + 12], &corner, 4);
  return stl;
}

/// Vertices of which few are used, in front of one triangle.
std::string padded_ply() {
  const std::size_t vertices = padding / 12;
  std::string ply = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                    std::to_string(vertices) +
                    "\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
                    "property list uchar uint vertex_indices\nend_header\n";
  ply += std::string(12 * vertices, '\0');
  const std::uint32_t corners[] = {0, static_cast<std::uint32_t>(vertices / 2),
                                   static_cast<std::uint32_t>(vertices - 1)};
  ply += '\3' + std::string(reinterpret_cast<const char*>(corners), sizeof corners);
  return ply;
}

struct Case {
  const char* name;
  std::string (*content)();
  bool streamed;
};

const Case cases[] = {{"cut.obj", padded_obj, false},
                      {"cut.stl", padded_stl, false},
                      {"cut.ply", padded_ply, false},
                      {"cut.ply", padded_ply, true},
                      {"cut.stl", padded_stl, true}};

/// How many triangles are read from the file; all of them, one chunk after the other, where they
/// stay in it.
std::uint64_t triangles_of(const fs::path& path, bool streamed) {
  ReadOptions options;
  options.hash = false;
  Warnings warnings;
  if (!streamed) return triangle_count(read_scene({path}, options, warnings));
  const StreamedScene scene = stream_scene({path}, options, warnings);
  const TriangleStream& stream = *scene.streams.at(0);
  std::uint64_t count = 0;
  for (std::uint32_t first = 0; first < stream.triangle_count(); first += 1U << 16)
    count += stream.read(first, 1U << 16).mesh.triangles.size();
  return count;
}

void check(std::uint64_t seed, const ScratchFolder& folder) {
  std::mt19937_64 draw(seed);
  const Case& each = cases[seed % std::size(cases)];
  SCOPED_TRACE(std::string(each.name) + (each.streamed ? ", streamed" : ""));
  const std::string content = each.content();
  const fs::path path = folder.write(each.name, content);
  const auto begin = Clock::now();
  const std::uint64_t whole = triangles_of(path, each.streamed);
  const std::chrono::duration<double> needed = Clock::now() - begin;
  const double share = std::uniform_real_distribution<double>(0, 1)(draw);
  // To nothing, anywhere, or by a byte.
  const std::uint64_t size = draw() % 3 == 0   ? 0
                             : draw() % 2 == 0 ? draw() % content.size()
                                               : content.size() - 1;
  std::jthread other([&] {
    std::this_thread::sleep_for(share * needed);
    fs::resize_file(path, size);
  });
  try {
    const std::uint64_t found = triangles_of(path, each.streamed);
    if (found == whole) return;
    other.join();  // it may have been cut before it was opened
    EXPECT_EQ(found, triangles_of(path, each.streamed));
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(each.name), std::string::npos) << error.what();
  }
}

TEST(CutFilesAdversaries, AreReadWholeOrRefused) {
  const ScratchFolder folder;
  checks::for_each_adversary(20, [&](std::uint64_t seed) { check(seed, folder); });
}

}  // namespace
}  // namespace fathom
