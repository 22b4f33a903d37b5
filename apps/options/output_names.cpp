#include "apps/options/output_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <unordered_map>

#include "fathom/numeric/errors.h"
#include "fathom/text/printable.h"

namespace fathom::app {
namespace {

namespace fs = std::filesystem;

bool has(const std::string& pattern, const char* field) {
  return pattern.find(field) != std::string::npos;
}

/// Times have no suffix: ".160407" of "1305031102.160407" is part of the number.
std::string stem_of(const std::string& name) {
  const fs::path path(name);
  const std::string suffix = path.extension().string();
  const bool is_suffix = suffix.size() > 1 && !('0' <= suffix[1] && suffix[1] <= '9');
  return (is_suffix ? path.stem() : path.filename()).string();
}

std::string formatted(const char* option, const std::string& pattern, std::size_t index,
                      const std::string& name) {
  try {
    return fmt::format(fmt::runtime(pattern), fmt::arg("index", index), fmt::arg("name", name),
                       fmt::arg("stem", stem_of(name)));
  } catch (const fmt::format_error& error) {
    throw UsageError(fmt::format("{}: '{}' is not a pattern like maps/{{index:04}}: {}", option,
                                 pattern, error.what()));
  }
}

void require_different(const char* option, const std::vector<std::string>& names) {
  std::unordered_map<std::string, std::size_t> first;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto [there, is_new] = first.emplace(names[i], i);
    if (is_new) continue;
    throw UsageError(fmt::format("{}: cameras {} and {} would both be written as {}", option,
                                 there->second, i, text::printable(names[i])));
  }
}

}  // namespace

std::string require_within_folder(const std::string& where, const std::string& name) {
  const fs::path path(name);
  const bool leaves = path.is_absolute() || std::ranges::find(path, fs::path("..")) != path.end() ||
                      name.find('\0') != std::string::npos || !path.has_filename() ||
                      path.filename() == ".";
  if (!leaves) return name;
  throw InputError(fmt::format(
      "{}: the name '{}' is no place below a folder; expected one without '..' or a leading '/'",
      where, text::printable(name)));
}

std::vector<std::string> names_of_outputs(const char* option, const std::string& pattern,
                                          const std::vector<Camera>& cameras) {
  const bool by_name = has(pattern, "{name") || has(pattern, "{stem");
  if (!by_name && !has(pattern, "{index")) {
    if (cameras.size() == 1) return {pattern};
    throw UsageError(fmt::format(
        "the camera file is a path of {} cameras: {} needs a pattern such as maps/{{index:04}}{}",
        cameras.size(), option, fs::path(pattern).extension().string()));
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const std::string& name = cameras[i].name;
    if (by_name && name.empty()) {
      throw InputError(fmt::format(
          "camera {} has no name for '{}': camera files say it as \"name\"", i, pattern));
    }
    // Of a stem alone it does not matter where the image lies.
    const std::string where = fmt::format("camera {}", i);
    if (has(pattern, "{name")) require_within_folder(where, name);
    if (has(pattern, "{stem")) require_within_folder(where, stem_of(name));
    names.push_back(formatted(option, pattern, i, name));
  }
  require_different(option, names);
  return names;
}

}  // namespace fathom::app
