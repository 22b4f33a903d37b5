#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "fathom/image/deep_map.h"
#include "fathom/image/map_files.h"

namespace fathom {

/// Reads a deep map back that write_deep_map() has written, bit for bit; also a file of another
/// program that has the same channels. Nothing is allocated for more samples than the file can
/// hold, or than `memory` allows.
/// Fails    InputError: "PATH: what is wrong and what was expected".
DeepMap read_deep_map(const std::filesystem::path& path, const MapMemory& memory = {});
/// The same of a file that has been read already; `name` is its name for messages.
DeepMap read_deep_map(std::span<const std::byte> bytes, const std::string& name,
                      const MapMemory& memory = {});

/// Whether a file begins as a deep EXR of one part does.
bool is_deep_map(std::span<const std::byte> bytes);

}  // namespace fathom
