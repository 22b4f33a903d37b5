#pragma once

#include <filesystem>
#include <string_view>

/// Where tests find what they read and run. The paths stand in one source, so that all others
/// compile to the same object wherever the repository lies.
namespace fathom::test {

/// The root of the repository.
std::filesystem::path source_dir();
/// The root of the build folder.
std::filesystem::path binary_dir();
/// A program that was built: "fathom", "fathom-bench".
std::filesystem::path program(std::string_view name);

}  // namespace fathom::test
