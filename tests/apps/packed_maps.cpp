#include "packed_maps.h"

#include <zlib.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace fathom::test {
namespace {

template <class Number>
std::string little_endian(Number number) {
  return {reinterpret_cast<const char*>(&number), sizeof number};
}

std::string big_endian(std::uint32_t number) {
  std::string bytes = little_endian(number);
  std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string packed(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), 9) != Z_OK) {
    throw std::runtime_error("compress2 failed");
  }
  packed.resize(size);
  return packed;
}

std::string attribute(const std::string& name, const std::string& type, const std::string& value) {
  return name + '\0' + type + '\0' + little_endian(static_cast<std::uint32_t>(value.size())) +
         value;
}

std::string exr_header(std::uint32_t width, std::uint32_t height) {
  const std::string channel = "Z" + std::string(1, '\0') + little_endian(2) + std::string(4, '\0') +
                              little_endian(1) + little_endian(1);
  const std::string window =
      std::string(8, '\0') + little_endian(width - 1) + little_endian(height - 1);
  return little_endian(20000630) + little_endian(2) +
         attribute("channels", "chlist", channel + '\0') +
         attribute("compression", "compression", "\3") + attribute("dataWindow", "box2i", window) +
         attribute("displayWindow", "box2i", window) +
         attribute("lineOrder", "lineOrder", std::string(1, '\0')) +
         attribute("pixelAspectRatio", "float", little_endian(1.0F)) +
         attribute("screenWindowCenter", "v2f", std::string(8, '\0')) +
         attribute("screenWindowWidth", "float", little_endian(1.0F)) + '\0';
}

/// Rows of zeros as EXR's ZIP packs them: each byte as its difference to the one before, plus 128.
std::string packed_rows(std::uint32_t width, std::uint32_t rows) {
  std::string differences(std::size_t{4} * width * rows, '\x80');
  differences[0] = '\0';
  return deflated(differences);
}

std::string png_chunk(const std::string& type, const std::string& data) {
  const std::string checked = type + data;
  const uLong sum =
      crc32(0, reinterpret_cast<const Bytef*>(checked.data()), static_cast<uInt>(checked.size()));
  return big_endian(static_cast<std::uint32_t>(data.size())) + checked +
         big_endian(static_cast<std::uint32_t>(sum));
}

}  // namespace

std::string black_exr(std::uint32_t width, std::uint32_t height) {
  constexpr std::uint32_t rows = 16;
  const std::uint32_t chunks = (height + rows - 1) / rows;
  const std::string whole = packed_rows(width, std::min(rows, height));
  const std::string last = packed_rows(width, height - rows * (chunks - 1));
  std::string file = exr_header(width, height), body;
  const std::uint64_t start = file.size() + 8 * std::uint64_t{chunks};
  for (std::uint32_t i = 0; i < chunks; ++i) {
    file += little_endian(start + body.size());
    const std::string& packed = i + 1 < chunks ? whole : last;
    body += little_endian(i * rows) + little_endian(static_cast<std::uint32_t>(packed.size()));
    body += packed;
  }
  return file + body;
}

std::string black_png(std::uint32_t width, std::uint32_t height) {
  z_stream stream{};
  if (deflateInit(&stream, 9) != Z_OK) throw std::runtime_error("deflateInit failed");
  std::string row(1 + std::size_t{2} * width, '\0'), packed, room(1 << 16, '\0');
  for (std::uint32_t y = 0; y < height; ++y) {
    stream.next_in = reinterpret_cast<Bytef*>(row.data());
    stream.avail_in = static_cast<uInt>(row.size());
    do {
      stream.next_out = reinterpret_cast<Bytef*>(room.data());
      stream.avail_out = static_cast<uInt>(room.size());
      deflate(&stream, y + 1 < height ? Z_NO_FLUSH : Z_FINISH);
      packed.append(room, 0, room.size() - stream.avail_out);
    } while (stream.avail_out == 0);
  }
  deflateEnd(&stream);
  const std::string header = big_endian(width) + big_endian(height) + std::string("\20\0\0\0\0", 5);
  return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) + png_chunk("IDAT", packed) +
         png_chunk("IEND", "");
}

}  // namespace fathom::test
