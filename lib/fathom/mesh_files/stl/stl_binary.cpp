#include "fathom/mesh_files/stl/stl_binary.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <vector>

#include "fathom/failures/errors.h"
#include "fathom/mesh/mesh_faces.h"
#include "fathom/mesh_files/streams.h"
#include "fathom/text/ascii.h"
#include "fathom/text/counted.h"
#include "fathom/text/text_cursor.h"
#include "fathom/text/text_ends.h"

static_assert(std::endian::native == std::endian::little, "binary STL is read as it lies");

namespace fathom::mesh_files {
using namespace files;
using namespace mesh;
using namespace text;

namespace {

std::uint32_t claimed_triangles(std::span<const std::byte> head) {
  std::uint32_t count = 0;
  std::memcpy(&count, head.data() + 80, sizeof count);
  return count;
}

}  // namespace

std::uint64_t count_binary_stl(std::span<const std::byte> head, std::uint64_t size,
                               const std::string& file, Warnings& warnings) {
  if (size < stl_header_size)
    throw InputError(file + ": byte " + std::to_string(size) +
                     ": the file ends, expected a binary STL header of 84 bytes");
  const std::uint64_t count = claimed_triangles(head);
  const std::uint64_t expected = stl_header_size + stl_triangle_size * count;
  if (size < expected)
    throw InputError(file + ": byte " + std::to_string(size) + ": the file ends, expected " +
                     std::to_string(expected) + " bytes for " + text::counted(count, "triangle"));
  if (size > expected)
    warnings.push_back(file + ": " +
                       text::counted(size - expected, "byte after the last triangle is ignored",
                                     "bytes after the last triangle are ignored"));
  return count;
}

std::array<float, 12> read_stl_triangle(const std::byte* record, std::uint64_t number,
                                        const std::string& file) {
  std::array<float, 12> values;
  std::memcpy(values.data(), record, sizeof values);
  for (std::size_t i = 3; i < 12; ++i)
    if (!std::isfinite(values[i]))
      throw InputError(file + ": byte " +
                       std::to_string(stl_header_size + stl_triangle_size * number + 4 * i) +
                       ": a coordinate of triangle " + std::to_string(number) +
                       " is not finite, expected a finite number");
  return values;
}

bool is_binary_stl_by_size(std::span<const std::byte> head, std::uint64_t size) {
  return head.size() >= stl_header_size &&
         size == stl_header_size + stl_triangle_size * std::uint64_t{claimed_triangles(head)};
}

bool is_binary_stl(std::span<const std::byte> head, std::uint64_t size) {
  if (is_binary_stl_by_size(head, size)) return true;
  std::string_view text(reinterpret_cast<const char*>(head.data()),
                        std::min<std::size_t>(head.size(), 512));
  if (text.size() == size) text = without_padding(text);
  const std::string no_name;
  TextCursor cursor(text, no_name, {.comments = true, .continuation = false});
  std::string word;
  while (cursor.next_line_with_words()) {
    word = cursor.word().substr(0, 6);
    if (!word.starts_with(';') && !word.starts_with("//")) break;
    cursor.skip_line();
  }
  return in_small_letters(word) != "solid" || text.find('\0') != text.npos;
}

namespace {

constexpr std::uint32_t triangles_at_once = 1U << 14;

std::array<MeshPoint, 3> corners_of(const std::array<float, 12>& values) {
  std::array<MeshPoint, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const float* p = &values[3 + 3 * k];
    corners[k] = {p[0], p[1], p[2]};
  }
  return corners;
}

class StlStream : public TriangleStream {
 public:
  StlStream(std::unique_ptr<RandomAccessFile> file, std::uint32_t count, bool check_now)
      : file_(std::move(file)), count_(count) {
    if (check_now) check();
  }

  [[nodiscard]] std::uint32_t triangle_count() const override { return count_; }
  [[nodiscard]] std::uint64_t face_count() const override { return count_; }
  [[nodiscard]] std::optional<Bounds> bounds() const override { return bounds_; }

  [[nodiscard]] TriangleChunk read(std::uint32_t first, std::uint32_t count) const override {
    first = std::min(first, count_);
    count = std::min(count, count_ - first);
    TriangleChunk chunk{.first = first, .mesh = {}};
    chunk.mesh.face_count = count;
    chunk.mesh.vertices.reserve(3 * std::size_t{count});
    chunk.mesh.triangles.reserve(count);
    for_each(first, count, [&](std::uint32_t, const std::array<MeshPoint, 3>& corners) {
      const auto vertex = static_cast<std::uint32_t>(chunk.mesh.vertices.size());
      chunk.mesh.vertices.append(corners.begin(), corners.end());
      chunk.mesh.triangles.push_back({vertex, vertex + 1, vertex + 2});
    });
    file_->expect_unchanged();
    return chunk;
  }

  [[nodiscard]] Triangle triangle(std::uint32_t number) const override {
    Triangle result{.corners = {}, .face = number};
    for_each(number, 1, [&](std::uint32_t, const auto& corners) { result.corners = corners; });
    file_->expect_unchanged();
    return result;
  }

  [[nodiscard]] std::uint32_t face_of(std::uint32_t number) const override { return number; }

 private:
  /// Reads through the file and finds the bounds.
  void check() {
    if (count_ == 0) return;
    const MeshPoint start = triangle(0).corners[0];
    Bounds bounds{start, start};
    for_each(0, count_, [&](std::uint32_t, const std::array<MeshPoint, 3>& corners) {
      for (const MeshPoint& p : corners) {
        bounds.lower = {std::min(bounds.lower.x, p.x), std::min(bounds.lower.y, p.y),
                        std::min(bounds.lower.z, p.z)};
        bounds.upper = {std::max(bounds.upper.x, p.x), std::max(bounds.upper.y, p.y),
                        std::max(bounds.upper.z, p.z)};
      }
    });
    bounds_ = bounds;
  }

  template <class Visit>
  void for_each(std::uint32_t first, std::uint32_t count, const Visit& visit) const {
    std::vector<std::byte> bytes(stl_triangle_size * std::min(count, triangles_at_once));
    while (count > 0) {
      const std::uint32_t now = std::min(count, triangles_at_once);
      const std::span part = std::span(bytes).first(stl_triangle_size * now);
      file_->read(stl_header_size + stl_triangle_size * std::uint64_t{first}, part);
      for (std::uint32_t i = 0; i < now; ++i) {
        const std::byte* record = part.data() + stl_triangle_size * i;
        visit(first + i, corners_of(read_stl_triangle(record, first + i, file_->name())));
      }
      first += now;
      count -= now;
    }
  }

  std::unique_ptr<RandomAccessFile> file_;
  std::uint32_t count_;
  std::optional<Bounds> bounds_;
};

}  // namespace

std::unique_ptr<TriangleStream> open_stl_stream(std::unique_ptr<RandomAccessFile> file, bool check,
                                                Warnings& warnings) {
  std::vector<std::byte> head(
      static_cast<std::size_t>(std::min<std::uint64_t>(stl_header_size, file->size())));
  file->read(0, head);
  const std::uint64_t count = count_binary_stl(head, file->size(), file->name(), warnings);
  expect_countable(count, "triangles", file->name());
  return std::make_unique<StlStream>(std::move(file), static_cast<std::uint32_t>(count), check);
}

}  // namespace fathom::mesh_files
