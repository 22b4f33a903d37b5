#include "fathom/text/version.h"

#include <cstdlib>

namespace fathom::text {

const std::string& version_in_outputs() {
  static const std::string version = [] {
    const char* const replacement = std::getenv(version_variable);
    return std::string(replacement && *replacement ? replacement : FATHOM_VERSION);
  }();
  return version;
}

std::string software_in_outputs() {
  return "Fathom " + version_in_outputs();
}

}  // namespace fathom::text
