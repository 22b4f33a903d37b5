#include "fathom/mesh_files/recognise_format.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

#include "fathom/mesh_files/foreign_formats.h"
#include "fathom/mesh_files/off/off_keyword.h"
#include "fathom/mesh_files/stl/stl_binary.h"
#include "fathom/text/small_letters.h"
#include "fathom/text/text_cursor.h"

namespace fathom::mesh_files {
using namespace text;

namespace {

std::optional<FileFormat> format_by_suffix(const std::filesystem::path& path) {
  const std::string suffix = in_small_letters(path.extension().string());
  if (suffix == ".obj") return FileFormat::obj;
  if (suffix == ".ply") return FileFormat::ply;
  if (suffix == ".stl") return FileFormat::stl;
  if (suffix == ".off" || suffix == ".coff" || suffix == ".noff") return FileFormat::off;
  if (suffix == ".gltf" || suffix == ".glb") return FileFormat::gltf;
  if (suffix == ".json") return FileFormat::scene_json;
  if (!suffix.empty() && is_foreign_suffix(suffix.substr(1))) return FileFormat::foreign;
  return std::nullopt;
}

bool is_obj_keyword(std::string_view word) {
  static constexpr std::string_view known[] = {"v", "vt", "vn", "vp",     "f",
                                               "o", "g",  "s",  "usemtl", "mtllib"};
  return std::find(std::begin(known), std::end(known), word) != std::end(known);
}

/// An asset has the key "asset", which a scene file must not have. (A mesh may have that name, but
/// no colon follows a name.)
bool has_asset_key(std::string_view text) {
  constexpr std::string_view key = "\"asset\"";
  for (std::size_t at = text.find(key); at != text.npos; at = text.find(key, at + 1)) {
    const std::size_t next = text.find_first_not_of(" \t\r\n", at + key.size());
    if (next != text.npos && text[next] == ':') return true;
  }
  return false;
}

}  // namespace

std::optional<FileFormat> recognise_format(std::span<const std::byte> bytes, std::uint64_t size,
                                           const std::filesystem::path& path) {
  const std::string_view text =
      TextCursor::without_mark({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  if (text.starts_with("glTF")) return FileFormat::gltf;
  if (text.starts_with("ply\n") || text.starts_with("ply\r")) return FileFormat::ply;
  if (is_binary_stl_by_size(bytes, size)) return FileFormat::stl;

  const std::string no_name;
  TextCursor cursor(text, no_name, {.comments = true, .continuation = false});
  if (!cursor.next_line_with_words()) return format_by_suffix(path);
  const char first = *cursor.position();
  if (first == '{' || first == '[') {
    const std::optional<FileFormat> by_suffix = format_by_suffix(path);
    if (by_suffix == FileFormat::gltf) return by_suffix;
    return has_asset_key(text) ? FileFormat::gltf : FileFormat::scene_json;
  }
  const std::string_view word = cursor.word();
  if (read_off_keyword(word)) return FileFormat::off;
  if (in_small_letters(word.substr(0, 6)) == "solid") return FileFormat::stl;
  if (is_obj_keyword(word)) return FileFormat::obj;
  return format_by_suffix(path);
}

}  // namespace fathom::mesh_files
