#include "apps/maps/file_kind.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>

#include "fathom/image/map_files.h"
#include "fathom/text/parse_json.h"
#include "fathom/text/text_cursor.h"

namespace fathom::app {
namespace {

/// An archive whose first member is an array of NumPy's. Meshes come in archives, too (3MF).
bool is_npz(std::string_view content) {
  constexpr std::size_t name_at = 30;
  if (!content.starts_with("PK\x03\x04") || content.size() < name_at) return false;
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(content[i]); };
  const std::size_t length = byte(26) + std::size_t{256} * byte(27);
  return content.substr(name_at, length).ends_with(".npy");
}

}  // namespace

FileKind kind_of(std::string_view content) {
  for (const std::string_view magic : {"\x76\x2f\x31\x01", "\x89PNG", "\x93NUMPY", "Pf", "PF"}) {
    if (content.starts_with(magic)) return FileKind::map;
  }
  // TIFF, of which the reader of maps says that it is not read.
  for (const std::string_view magic :
       {std::string_view("II*\0", 4), std::string_view("MM\0*", 4)}) {
    if (content.starts_with(magic)) return FileKind::map;
  }
  if (is_npz(content) || is_colmap_map(std::as_bytes(std::span(content)))) return FileKind::map;
  const std::string_view text = text::TextCursor::without_mark(content);
  const std::size_t first = text.substr(0, 16).find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos || (text[first] != '{' && text[first] != '['))
    return FileKind::mesh;
  if (text[first] == '[') return FileKind::camera;
  // What is no JSON is told by the reader of cameras.
  nlohmann::json json;
  try {
    text::parse_json(content, json);
  } catch (const text::JsonFault&) {
    return FileKind::camera;
  }
  if (json.contains("asset")) return FileKind::mesh;
  if (json.contains("meshes")) return FileKind::scene;
  return FileKind::camera;
}

}  // namespace fathom::app
