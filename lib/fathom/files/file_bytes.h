#pragma once

#include <bit>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "fathom/files/byte_order.h"

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

/// Appends a number in little-endian order.
template <class T>
void put_number(Bytes& bytes, T value) {
  bytes.resize(bytes.size() + sizeof(T));
  store(&bytes[bytes.size() - sizeof(T)], value, std::endian::little);
}

}  // namespace fathom::files
