#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace fathom::app {

/// The folder that a file's name puts it in: "." where it names none.
std::filesystem::path folder_of(const std::filesystem::path& file);

/// What the name of an output leads to.
struct OutputPlace {
  /// The file that is meant, which need not exist: symbolic links are followed.
  std::filesystem::path path;
  /// The number of this process's open file that it names: 1 for /dev/stdout.
  std::optional<int> open_file;
  /// It lies in /proc, where nothing can be put.
  bool is_foreign = false;
};

/// Fails    OutputError where links lead in a circle.
OutputPlace place_of(const std::filesystem::path& target);

/// Whether what is written to this name goes on at once, into a device, a pipe or an open file: it
/// need not have the suffix of what it is.
bool is_written_through(const std::filesystem::path& target);

/// The name of a picture as an argument: it ends in .png, or is a device, a pipe or an open file.
/// Fails    UsageError: "'text' does not end in .png".
std::string parse_png_name(const std::string& text);

}  // namespace fathom::app
