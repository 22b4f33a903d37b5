#pragma once

#include <cstdint>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/camera/camera_import.h"

/// The imports of camera_import.h on what has been opened already, for their files, tests and
/// fuzzers. `name` is the file's name for messages.
namespace fathom::camera {

/// A stream with its name.
struct NamedStream {
  std::istream& stream;
  std::string name;
};

/// Both streams must be seekable.
std::vector<ImportedCamera> parse_colmap_binary(NamedStream cameras, NamedStream images);
std::vector<ImportedCamera> parse_colmap_text(NamedStream cameras, NamedStream images);
std::vector<ImportedCamera> parse_nerf(std::string_view text, const std::string& name,
                                       std::uint32_t width, std::uint32_t height,
                                       Warnings& warnings);
std::vector<ImportedCamera> parse_bop(std::string_view text, const std::string& name,
                                      std::uint32_t width, std::uint32_t height);
std::vector<ImportedCamera> parse_opengl(std::string_view text, const std::string& name);

}  // namespace fathom::camera
