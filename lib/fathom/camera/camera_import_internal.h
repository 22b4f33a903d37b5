#pragma once

#include <cstdint>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/camera/camera_import.h"
#include "fathom/numeric/errors.h"

/// The imports of camera_import.h from text and streams that are already open, for their own files,
/// tests and fuzzers. `name` is the file's name for messages.
namespace fathom::camera {

/// A stream with its name.
struct NamedStream {
  std::istream& stream;
  std::string name;
};

/// A camera as `read` fills it in; where that fails, with its fault.
template <class Read>
ImportedCamera imported_camera(std::string name, const Read& read) {
  ImportedCamera result;
  try {
    read(result);
    if (const auto fault = find_fault(result.camera)) result.fault = name + ": " + *fault;
  } catch (const InputError& error) {
    result.fault = error.what();
  }
  result.camera.name = std::move(name);
  return result;
}

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
