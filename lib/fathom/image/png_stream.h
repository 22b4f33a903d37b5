#pragma once

#include <png.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "fathom/files/byte_order.h"
#include "fathom/files/file_bytes.h"

/// libpng without longjmp over C++ objects: callers of libpng keep everything with a destructor in
/// a struct outside the function that calls setjmp.
namespace fathom::image {

/// libpng's message when it gives up; libpng then jumps back to setjmp.
struct PngFailure {
  char reason[160] = "";
  /// It got no memory, which for some chunks it thinks worth no more than a warning.
  bool out_of_memory = false;
};
[[noreturn]] void png_fail(png_structp png, png_const_charp reason);
/// Allocates for libpng, which has been given a PngFailure for this too.
png_voidp png_allocate(png_structp png, png_alloc_size_t size);
void png_deallocate(png_structp png, png_voidp block);
void png_ignore_warning(png_structp png, png_const_charp reason);

/// Whether every chunk of a PNG (length, type, data, checksum) lies within the file. Must be
/// checked first, because libpng allocates as much for a chunk as its header claims.
inline bool chunks_fit(std::span<const std::byte> bytes) {
  constexpr std::size_t signature = 8, around = 12;
  for (std::size_t at = signature; at < bytes.size();) {
    if (bytes.size() - at < around) return false;
    const std::size_t length = load<std::uint32_t>(&bytes[at], std::endian::big);
    if (length > bytes.size() - at - around) return false;
    at += around + length;
  }
  return true;
}

}  // namespace fathom::image
