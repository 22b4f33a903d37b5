#include "fathom/mesh_files/gltf_uri.h"

#include <algorithm>
#include <optional>
#include <string>
#include <system_error>

namespace fathom::mesh_files {
using namespace text;

namespace {

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

/// %XX stands for a byte.
std::optional<std::string> percent_decoded(const std::string& uri) {
  std::string path;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] != '%') {
      path.push_back(uri[i]);
      continue;
    }
    if (i + 2 >= uri.size() || hex_digit(uri[i + 1]) < 0 || hex_digit(uri[i + 2]) < 0)
      return std::nullopt;
    path.push_back(static_cast<char>(hex_digit(uri[i + 1]) * 16 + hex_digit(uri[i + 2])));
    i += 2;
  }
  if (path.empty() || path.find('\0') != std::string::npos) return std::nullopt;
  return path;
}

/// Whether a path stays in the folder, as both are written.
bool stays_in(const std::filesystem::path& path, const std::filesystem::path& folder) {
  std::error_code error;  // no working folder: an empty path, which lies in none
  const auto written = [&](const std::filesystem::path& p) {
    return std::filesystem::absolute(p, error).lexically_normal();
  };
  const auto way = written(path).lexically_relative(written(folder / "."));
  return !way.empty() && *way.begin() != "..";
}

}  // namespace

std::filesystem::path file_of_uri(const JsonValue& uri, const std::filesystem::path& folder,
                                  bool outside_files) {
  auto name = percent_decoded(uri.string());
  if (!name || uri.string().find("://") != std::string::npos)
    uri.fail("expected a file's relative URI or a data URI");
  const auto checked = [&](const std::filesystem::path& file) {
    if (!outside_files && !stays_in(file, folder))
      uri.fail("leads out of the folder of the asset, which --outside-files allows");
    return file;
  };
  std::filesystem::path file = checked(folder / *name);
  std::error_code error;
  if (name->find('\\') == std::string::npos || std::filesystem::exists(file, error)) return file;
  std::replace(name->begin(), name->end(), '\\', '/');
  return checked(folder / *name);
}

}  // namespace fathom::mesh_files
