#include "apps/maps/file_kind.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "fathom/text/input_file.h"
#include "fathom/text/parse_json.h"

namespace fathom::app {

FileKind kind_of(const std::string& file) {
  if (file == "-") return FileKind::mesh;
  std::ifstream stream(file, std::ios::binary);
  std::string start(16, '\0');
  stream.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
  if (start.starts_with("\x76\x2f\x31\x01") || start.starts_with("\x89PNG") ||
      start.starts_with("\x93NUMPY") || start.starts_with("Pf") || start.starts_with("PF")) {
    return FileKind::map;
  }
  const std::size_t first = start.find_first_not_of(" \t\r\n");
  if (first == std::string::npos || (start[first] != '{' && start[first] != '['))
    return FileKind::mesh;
  if (start[first] == '[') return FileKind::camera;
  // What is no JSON is told by the reader of cameras.
  nlohmann::json json;
  try {
    text::parse_json(text::InputFile(file).text(), json);
  } catch (const text::JsonFault&) {
    return FileKind::camera;
  }
  if (json.contains("asset")) return FileKind::mesh;
  if (json.contains("meshes")) return FileKind::scene;
  return FileKind::camera;
}

}  // namespace fathom::app
