#include "apps/shell/folder_argument.h"

#include <filesystem>

#include "fathom/failures/errors.h"

namespace fathom::app {

void refuse_folder_of(const char* file, const std::string& argument) {
  const std::filesystem::path inside = std::filesystem::path(argument) / file;
  if (!std::filesystem::exists(inside)) return;
  throw InputError(argument + ": is a folder, expected its file " + inside.string());
}

}  // namespace fathom::app
