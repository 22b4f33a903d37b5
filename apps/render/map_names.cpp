#include "apps/render/map_names.h"

#include <fmt/format.h>

#include <filesystem>

#include "fathom/numeric/errors.h"

namespace fathom::app {

std::vector<std::string> names_of_outputs(const char* option, const std::string& pattern,
                                          std::size_t cameras) {
  const bool has_index = pattern.find("{index") != std::string::npos;
  if (!has_index) {
    if (cameras == 1) return {pattern};
    throw UsageError(fmt::format(
        "the camera file is a path of {} cameras: {} needs a pattern such as maps/{{index:04}}{}",
        cameras, option, std::filesystem::path(pattern).extension().string()));
  }
  std::vector<std::string> names;
  try {
    for (std::size_t i = 0; i < cameras; ++i) {
      names.push_back(fmt::format(fmt::runtime(pattern), fmt::arg("index", i)));
    }
  } catch (const fmt::format_error& error) {
    throw UsageError(fmt::format("{}: '{}' is not a pattern like maps/{{index:04}}: {}", option,
                                 pattern, error.what()));
  }
  return names;
}

}  // namespace fathom::app
