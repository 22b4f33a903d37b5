#include "tests/places.h"

namespace fathom::test {

std::filesystem::path source_dir() {
  return FATHOM_SOURCE_DIR;
}

std::filesystem::path binary_dir() {
  return FATHOM_BINARY_DIR;
}

std::filesystem::path program(std::string_view name) {
  return binary_dir() / "bin" / name;
}

}  // namespace fathom::test
