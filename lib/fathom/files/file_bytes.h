#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

/// Whole files in memory: every format is encoded to bytes and decoded from bytes, so that a full
/// disk, a pipe and a truncated file are each dealt with in one place.
namespace fathom::files {

using Bytes = std::vector<std::byte>;
using ByteView = std::span<const std::byte>;

/// Writes to the file itself, in place (a device or a pipe is written through).
/// Fails    OutputError: "PATH: why"; what has been written by then stays.
void write_file(const std::filesystem::path& path, ByteView bytes);

void append(Bytes& bytes, ByteView more);
void append(Bytes& bytes, const std::string& text);

}  // namespace fathom::files
