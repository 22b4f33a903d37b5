#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

#include "fathom/mesh_files/read_options.h"

namespace fathom::mesh_files {

/// What a file is: by its content or, if that does not tell (an OBJ or OFF without a word that
/// gives it away, an STL whose header is arbitrary), by the suffix of its path, in any case.
/// Foreign formats (foreign_formats.h) are recognised by their suffix alone.
/// nullopt if neither tells. `bytes` is the whole file of `size` bytes, or its beginning if only
/// binary formats matter.
std::optional<FileFormat> recognise_format(std::span<const std::byte> bytes, std::uint64_t size,
                                           const std::filesystem::path& path);
inline std::optional<FileFormat> recognise_format(std::span<const std::byte> bytes,
                                                  const std::filesystem::path& path) {
  return recognise_format(bytes, bytes.size(), path);
}

}  // namespace fathom::mesh_files
