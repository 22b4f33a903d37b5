#include "apps/maps/info.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>

#include "apps/shell/values.h"
#include "fathom/image/map_files.h"
#include "fathom/text/parse_json.h"
#include "fathom/text/printable.h"
#include "fathom/text/text_cursor.h"

namespace fathom::app {

FileKind kind_of(std::string_view content) {
  if (is_map(std::as_bytes(std::span(content)))) return FileKind::map;
  const std::string_view text = text::TextCursor::without_mark(content);
  const std::size_t first = text.substr(0, 16).find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos || (text[first] != '{' && text[first] != '['))
    return FileKind::mesh;
  if (text[first] == '[') return FileKind::camera;
  // The reader of cameras reports files that are not JSON.
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

std::string name_line(const std::string& what, const std::vector<std::string>& names) {
  if (names.empty()) return "";
  constexpr std::size_t most = 50;
  const auto end = names.begin() + static_cast<std::ptrdiff_t>(std::min(most, names.size()));
  std::string text =
      fmt::format("  {:<10} {}", what, text::printable(joined({names.begin(), end}, ", ")));
  if (names.size() > most) text += fmt::format(" and {} more", names.size() - most);
  return text + "\n";
}

}  // namespace fathom::app
