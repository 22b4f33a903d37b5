#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <utility>

#include "fathom/scene/read_scene.h"

/// Prints MB/s (of the wall clock and of processor time) and peak memory of reading a grid of
/// triangles in each format. Every reading happens in a process of its own, so that its peak is its
/// own; the files lie in the page cache. Where they have more than 64 MiB they can be mapped, too.
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct Grid {
  std::uint32_t side;

  [[nodiscard]] std::uint32_t vertices() const { return side * side; }
  [[nodiscard]] std::array<double, 3> vertex(std::uint32_t i) const {
    const double x = (i % side) / 3.0, y = (i / side) / 7.0;
    return {x, y, std::sin(x) * std::cos(y)};
  }
  void for_each_triangle(
      const std::function<void(std::uint32_t, std::uint32_t, std::uint32_t)>& f) const {
    for (std::uint32_t y = 0; y + 1 < side; ++y) {
      for (std::uint32_t x = 0; x + 1 < side; ++x) {
        const std::uint32_t a = y * side + x;
        f(a, a + 1, a + side);
        f(a + 1, a + side + 1, a + side);
      }
    }
  }
  [[nodiscard]] std::uint32_t triangles() const { return 2 * (side - 1) * (side - 1); }
};

class Writer {
 public:
  explicit Writer(const fs::path& path) : out_(path, std::ios::binary) {}
  template <class... Values>
  void print(const char* format, Values... values) {
    char text[256];
    out_.write(text, std::snprintf(text, sizeof text, format, values...));
  }
  template <class T>
  void raw(T value) {
    out_.write(reinterpret_cast<const char*>(&value), sizeof value);
  }

 private:
  std::ofstream out_;
};

void write_obj(const Grid& grid, const fs::path& path, const char* format) {
  Writer out(path);
  for (std::uint32_t i = 0; i < grid.vertices(); ++i) {
    const auto p = grid.vertex(i);
    out.print(format, p[0], p[1], p[2]);
  }
  grid.for_each_triangle(
      [&](auto a, auto b, auto c) { out.print("f %u %u %u\n", a + 1, b + 1, c + 1); });
}

void write_quads(const Grid& grid, const fs::path& path) {
  Writer out(path);
  for (std::uint32_t i = 0; i < grid.vertices(); ++i) {
    const auto p = grid.vertex(i);
    out.print("v %.6f %.6f %.6f\n", p[0], p[1], p[2]);
  }
  for (std::uint32_t y = 0; y + 1 < grid.side; ++y)
    for (std::uint32_t x = 0; x + 1 < grid.side; ++x) {
      const std::uint32_t a = y * grid.side + x + 1;
      out.print("f %u %u %u %u\n", a, a + 1, a + grid.side + 1, a + grid.side);
    }
}

void write_ply(const Grid& grid, const fs::path& path, bool binary) {
  Writer out(path);
  out.print(
      "ply\nformat %s 1.0\nelement vertex %u\nproperty float x\nproperty float y\nproperty float "
      "z\n",
      binary ? "binary_little_endian" : "ascii", grid.vertices());
  out.print("element face %u\nproperty list uchar int vertex_indices\nend_header\n",
            grid.triangles());
  for (std::uint32_t i = 0; i < grid.vertices(); ++i) {
    const auto p = grid.vertex(i);
    if (!binary) out.print("%.9g %.9g %.9g\n", p[0], p[1], p[2]);
    for (int k = 0; k < 3 && binary; ++k) out.raw(static_cast<float>(p[k]));
  }
  grid.for_each_triangle([&](auto a, auto b, auto c) {
    if (!binary) return out.print("3 %u %u %u\n", a, b, c);
    out.raw(std::uint8_t{3});
    for (const std::uint32_t i : {a, b, c}) out.raw(i);
  });
}

void write_stl(const Grid& grid, const fs::path& path, bool binary) {
  Writer out(path);
  if (binary) out.print("%-80s", "grid"), out.raw(grid.triangles());
  if (!binary) out.print("solid grid\n");
  grid.for_each_triangle([&](auto a, auto b, auto c) {
    if (!binary) out.print("facet normal 0 0 1\nouter loop\n");
    for (int k = 0; k < 3 && binary; ++k) out.raw(0.0F);
    for (const std::uint32_t i : {a, b, c}) {
      const auto p = grid.vertex(i);
      if (!binary) out.print("vertex %.9g %.9g %.9g\n", p[0], p[1], p[2]);
      for (int k = 0; k < 3 && binary; ++k) out.raw(static_cast<float>(p[k]));
    }
    if (!binary) out.print("endloop\nendfacet\n");
    if (binary) out.raw(std::uint16_t{0});
  });
  if (!binary) out.print("endsolid grid\n");
}

void write_off(const Grid& grid, const fs::path& path) {
  Writer out(path);
  out.print("OFF\n%u %u 0\n", grid.vertices(), grid.triangles());
  for (std::uint32_t i = 0; i < grid.vertices(); ++i) {
    const auto p = grid.vertex(i);
    out.print("%.9g %.9g %.9g\n", p[0], p[1], p[2]);
  }
  grid.for_each_triangle([&](auto a, auto b, auto c) { out.print("3 %u %u %u\n", a, b, c); });
}

std::size_t size_of(const fathom::Mesh& mesh) {
  return mesh.vertices.size() * sizeof mesh.vertices[0] +
         mesh.triangles.size() * sizeof mesh.triangles[0] +
         mesh.face_of_triangle.size() * sizeof(std::uint32_t);
}

enum class File { read, mapped };

void read_in_child(const char* name, const fs::path& path, int threads, bool hash,
                   File file = File::read) {
  if (const pid_t child = fork(); child != 0) {
    waitpid(child, nullptr, 0);
    return;
  }
  fathom::ReadOptions options;
  options.threads = threads;
  options.hash = hash;
  options.map_large_files = file == File::mapped;
  fathom::Warnings warnings;
  const auto start = Clock::now();
  const fathom::Scene scene = fathom::read_scene({path}, options, warnings);
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const double megabytes = static_cast<double>(fs::file_size(path)) * 1e-6;
  const auto seconds_of = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  const double cpu_seconds = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
  std::printf(
      "%-24s %7.1f MB  %-6s  threads %d  sha256 %-3s  %7.1f MB/s  %7.1f MB per CPU second  "
      "mesh %6.1f MB  peak %6.1f MB\n",
      name, megabytes, file == File::mapped ? "mapped" : "read", threads, hash ? "yes" : "no",
      megabytes / seconds, megabytes / cpu_seconds,
      static_cast<double>(size_of(scene.meshes.at(0))) * 1e-6,
      static_cast<double>(usage.ru_maxrss) * 1024e-6);
  std::fflush(stdout);
  _exit(0);
}

}  // namespace

int main(int argc, char** argv) {
  const double millions = argc > 1 ? std::atof(argv[1]) : 2;
  const Grid grid{static_cast<std::uint32_t>(std::sqrt(millions * 5e5)) + 1};
  std::string pattern = (fs::temp_directory_path() / "fathom-bench-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) return 1;
  const fs::path path = fs::path(pattern) / "mesh";
  const std::pair<const char*, std::function<void()>> formats[] = {
      {"OBJ, 6 decimals", [&] { write_obj(grid, path, "v %.6f %.6f %.6f\n"); }},
      {"OBJ, 17 digits", [&] { write_obj(grid, path, "v %.17g %.17g %.17g\n"); }},
      {"OBJ, quadrilaterals", [&] { write_quads(grid, path); }},
      {"PLY, ascii", [&] { write_ply(grid, path, false); }},
      {"PLY, binary", [&] { write_ply(grid, path, true); }},
      {"STL, ascii", [&] { write_stl(grid, path, false); }},
      {"STL, binary", [&] { write_stl(grid, path, true); }},
      {"OFF", [&] { write_off(grid, path); }},
  };
  for (const auto& [name, write] : formats) {
    write();
    read_in_child(name, path, 1, false);
    read_in_child(name, path, 2, false);
    read_in_child(name, path, 2, false, File::mapped);
    read_in_child(name, path, 2, true);
  }
  fs::remove_all(pattern);
  return 0;
}
