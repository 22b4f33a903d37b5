#include "fathom/image/files/exr_zip.h"

#include <libdeflate.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <vector>

#include "fathom/files/byte_order.h"
#include "fathom/image/files/compressor.h"
#include "fathom/threads/per_thread.h"
#include "fathom/threads/threads.h"

static_assert(std::endian::native == std::endian::little,
              "EXR has its numbers as they are in memory");

namespace fathom::image {
using namespace files;

namespace {

/// The buffers of a thread, reused for its next chunk.
struct Workplace {
  Compressor compressor = new_compressor();
  Bytes differences, compressed;
};

std::byte difference(std::byte a, std::byte b) {
  return static_cast<std::byte>(static_cast<unsigned>(a) - static_cast<unsigned>(b) + 128);
}

/// The bytes in even places, then those in odd places, each as its difference from the one before.
/// Source   [OpenEXR] ZIP compression, as OpenEXR 3.1 has it in ImfZip.cpp
void separate(std::span<const std::byte> pixels, Bytes& differences) {
  const std::size_t half = pixels.size() / 2;  // a whole number of pixels of four bytes
  differences.resize(pixels.size());
  std::byte* const even = differences.data();
  std::byte* const odd = even + half;
  even[0] = pixels[0];
  odd[0] = difference(pixels[1], pixels[2 * half - 2]);
  for (std::size_t i = 1; i < half; ++i) {
    even[i] = difference(pixels[2 * i], pixels[2 * i - 2]);
    odd[i] = difference(pixels[2 * i + 1], pixels[2 * i - 1]);
  }
}

/// The pixels of the rows [first, end): of each row all channels, one after the other.
Bytes pixels_of(std::span<const ExrPlane> planes, std::uint32_t width, std::uint32_t first,
                std::uint32_t end) {
  const std::size_t row_size = std::size_t{4} * width;
  Bytes pixels(row_size * planes.size() * (end - first));
  std::byte* to = pixels.data();
  for (std::uint32_t row = first; row < end; ++row)
    for (const ExrPlane plane : planes) {
      std::memcpy(to, plane + row_size * row, row_size);
      to += row_size;
    }
  return pixels;
}

/// What stands for the pixels in the file: they themselves where they cannot be compressed.
Bytes compressed(Bytes pixels, Workplace& place) {
  separate(pixels, place.differences);
  place.compressed.resize(pixels.size());
  const std::size_t size = libdeflate_zlib_compress(
      place.compressor.get(), place.differences.data(), place.differences.size(),
      place.compressed.data(), pixels.size() - 1);
  if (size == 0) return pixels;
  return {place.compressed.begin(), place.compressed.begin() + static_cast<std::ptrdiff_t>(size)};
}

}  // namespace

std::vector<Bytes> zip_chunks(std::span<const ExrPlane> planes, std::uint32_t width,
                              std::uint32_t height, std::uint32_t rows, int threads) {
  std::vector<Bytes> chunks((height + rows - 1) / rows);
  run_with_threads(threads, [&] {
    PerThread<Workplace> places;
    in_parallel(chunks.size(), [&](std::size_t i) {
      const std::uint32_t first = static_cast<std::uint32_t>(i) * rows;
      chunks[i] = compressed(
          pixels_of(planes, width, first, first + std::min(rows, height - first)), places.local());
    });
  });
  return chunks;
}

void append_zip_chunks(Bytes& file, std::span<const ExrPlane> planes, std::uint32_t width,
                       std::uint32_t height, std::uint32_t rows, int threads) {
  const std::vector<Bytes> chunks = zip_chunks(planes, width, height, rows, threads);
  std::size_t size = file.size();
  for (const Bytes& chunk : chunks) size += 2 * sizeof(std::uint32_t) + chunk.size();
  std::size_t entry = file.size() - sizeof(std::uint64_t) * chunks.size();
  file.reserve(size);
  const auto put = [&](auto number) { append(file, std::as_bytes(std::span(&number, 1))); };
  for (std::size_t i = 0; i < chunks.size(); ++i, entry += sizeof(std::uint64_t)) {
    const std::uint64_t offset = file.size();
    std::memcpy(file.data() + entry, &offset, sizeof offset);
    put(static_cast<std::uint32_t>(i) * rows);
    put(static_cast<std::uint32_t>(chunks[i].size()));
    append(file, chunks[i]);
  }
}

}  // namespace fathom::image
