#include "apps/shell/folder.h"

#include <fmt/core.h>

#include "fathom/numeric/errors.h"

namespace fathom::app {

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder, error)) {
    throw OutputError(fmt::format("{}: cannot make this folder: {}", folder.string(),
                                  error ? error.message() : "it is a file"));
  }
}

}  // namespace fathom::app
