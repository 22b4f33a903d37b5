#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fathom/files/file_bytes.h"

namespace fathom::image {

/// The values of a channel, four bytes each, row after row.
using ExrPlane = const std::byte*;

/// The pixels of a chunk that is being compressed, their differences, and what becomes of them.
inline constexpr double copies_of_zip_chunk = 3;

/// The pixels of an EXR, compressed in chunks of `rows` rows, as append_zip_chunks() writes them to
/// the file.
/// Fails    std::bad_alloc.
std::vector<files::Bytes> zip_chunks(std::span<const ExrPlane> planes, std::uint32_t width,
                                     std::uint32_t height, std::uint32_t rows, int threads);

/// Appends the pixels of an EXR to its header, in chunks of `rows` rows, compressed by ZIP: OpenEXR
/// reads them like its own. libdeflate compresses in half the time that OpenEXR 3.1 takes with
/// zlib, and to no more bytes. The same for any number of threads (0: all). `planes` are in the
/// order of the file; the table of chunks, which is filled in, ends `file`.
/// Fails    std::bad_alloc.
void append_zip_chunks(files::Bytes& file, std::span<const ExrPlane> planes, std::uint32_t width,
                       std::uint32_t height, std::uint32_t rows, int threads);

}  // namespace fathom::image
