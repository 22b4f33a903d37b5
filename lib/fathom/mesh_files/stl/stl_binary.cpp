#include "fathom/mesh_files/stl/stl_binary.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "fathom/failures/errors.h"
#include "fathom/text/counted.h"
#include "fathom/text/small_letters.h"
#include "fathom/text/text_cursor.h"
#include "fathom/text/text_ends.h"

static_assert(std::endian::native == std::endian::little, "binary STL is read as it lies");

namespace fathom::mesh_files {
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

}  // namespace fathom::mesh_files
