#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <vector>

#include "fathom/failures/errors.h"
#include "fathom/files/byte_order.h"
#include "fathom/image/files/map_codecs.h"

/// Checks what an OpenEXR header claims against the size of the file, before OpenEXR, which
/// allocates by those claims, sees it.
/// Source   [OpenEXR] for the layout.
namespace fathom::image {
using namespace files;

namespace {

constexpr std::uint32_t flag_deep = 0x800, flag_multipart = 0x1000;

/// The bytes before the counts of a deep row.
constexpr std::uint64_t deep_chunk_header = 28;

/// For OpenEXR's compression codes 0 … 9: scan lines per chunk, and a bound on image bytes per file
/// byte. RLE: 128 from 2. DEFLATE: 1032; its doubling covers PXR24, which first drops a byte of
/// four. PIZ: a code of one bit and a run length of 8 give at most 256 16-bit values, 455. B44: 32
/// from 3. DWA: DEFLATE of one 16-bit coefficient for a block of 64 values.
struct CompressionBound {
  std::uint64_t lines, ratio;
};
constexpr std::array<CompressionBound, 10> compression_bounds{{{1, 1},
                                                               {1, 64},
                                                               {1, greatest_deflate_ratio},
                                                               {16, greatest_deflate_ratio},
                                                               {32, greatest_deflate_ratio},
                                                               {16, greatest_deflate_ratio},
                                                               {32, greatest_deflate_ratio},
                                                               {32, greatest_deflate_ratio},
                                                               {32, 64 * greatest_deflate_ratio},
                                                               {256, 64 * greatest_deflate_ratio}}};

/// OpenEXR reads these types with their fixed size, ignoring the size in the file, and would lose
/// its place.
constexpr std::array<std::pair<std::string_view, std::size_t>, 24> fixed_sizes{
    {{"box2i", 16},      {"box2f", 16},   {"chromaticities", 32},
     {"compression", 1}, {"double", 8},   {"envmap", 1},
     {"float", 4},       {"int", 4},      {"keycode", 28},
     {"lineOrder", 1},   {"m33f", 36},    {"m33d", 72},
     {"m44f", 64},       {"m44d", 128},   {"rational", 8},
     {"timecode", 8},    {"tiledesc", 9}, {"v2i", 8},
     {"v2f", 8},         {"v2d", 16},     {"v3i", 12},
     {"v3f", 12},        {"v3d", 24},     {"deepImageState", 1}}};

/// Whether a value is as long as its own contents say, for the types whose length they give.
bool is_consistent(std::string_view type, ByteView value) {
  const auto count_at = [&](std::size_t at) {
    return std::uint64_t{load<std::uint32_t>(&value[at], std::endian::little)};
  };
  for (const auto& [name, size] : fixed_sizes)
    if (type == name) return value.size() == size;
  if (type == "preview")
    return value.size() >= 8 && count_at(0) <= value.size() && count_at(4) <= value.size() &&
           8 + 4 * count_at(0) * count_at(4) == value.size();
  if (type == "stringvector") {
    std::size_t at = 0;
    while (value.size() - at >= 4 && count_at(at) <= value.size() - at - 4) at += 4 + count_at(at);
    return at == value.size();
  }
  if (type == "chlist") {
    std::size_t at = 0;
    while (at < value.size() && value[at] != std::byte{0}) {
      while (at < value.size() && value[at] != std::byte{0}) ++at;
      at += 17;
    }
    return at + 1 == value.size();
  }
  return true;
}

/// The attributes of one part, by name: their bytes. Types are left to OpenEXR.
using Attributes = std::map<std::string_view, ByteView>;

class Claims {
 public:
  Claims(ByteView bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  std::vector<std::size_t> check() {
    const std::uint32_t version = read_version();
    Attributes part = read_attributes();
    if (is_deep_of_one_part(version) || is_deep(part))
      fail(
          "is a deep map, expected scan lines or tiles; 'fathom view', 'fathom preview' and "
          "'fathom info' take it, as do DeepMap.read in Python and read_deep_map in C++");
    for (bool first = true; !part.empty(); first = false) {
      check_part(part, first ? bytes_of_a_pixel(attribute(part, "channels", 1)) : 0);
      if (!(version & flag_multipart)) break;
      part = read_attributes();
    }
    return defused_;
  }

  DeepClaims check_deep() {
    const std::uint32_t version = read_version();
    const Attributes part = read_attributes();
    if (!is_deep_of_one_part(version) || !has_type(part, "deepscanline"))
      fail("not a deep map: expected an EXR of deep scan lines in one part");
    if (attribute(part, "compression", 1)[0] > std::byte{2})
      fail("corrupt: deep images have no such compression");
    check_part(part, sizeof(std::uint32_t));  // the number of a pixel's samples
    return {defused_, check_deep_chunks(part)};
  }

 private:
  std::uint32_t read_version() {
    if (bytes_.size() < 8) fail("truncated: expected a header");
    const auto version = load<std::uint32_t>(&bytes_[4], std::endian::little);
    if ((version & 0xFF) != 2) fail("expected version 2 of the format");
    position_ = 8;
    return version;
  }

  [[noreturn]] void fail(const std::string& what) const { throw InputError(name_ + ": " + what); }

  std::string_view read_name() {
    const auto begin = bytes_.begin() + static_cast<std::ptrdiff_t>(position_);
    const auto end = std::find(begin, bytes_.end(), std::byte{0});
    if (end == bytes_.end()) fail("truncated: its header does not end");
    const auto length = static_cast<std::size_t>(end - begin);
    const std::string_view text(reinterpret_cast<const char*>(bytes_.data()) + position_, length);
    position_ += length + 1;
    return text;
  }

  Attributes read_attributes() {
    Attributes attributes;
    while (true) {
      const std::string_view name = read_name();
      if (name.empty()) return attributes;
      const std::size_t type_at = position_;
      const std::string_view type = read_name();
      // OpenEXR 3.1 reads four bytes more than such an attribute has, and misreads what follows.
      // It skips types that it does not know.
      if (type == "idmanifest") defused_.push_back(type_at);
      if (bytes_.size() - position_ < 4) fail("truncated: its header does not end");
      const auto size = load<std::uint32_t>(&bytes_[position_], std::endian::little);
      position_ += 4;
      if (size > bytes_.size() - position_)
        fail("corrupt or truncated: an attribute of its header is longer than the file");
      attributes[name] = bytes_.subspan(position_, size);
      if (!is_consistent(type, attributes[name]))
        fail("corrupt: an attribute of its header has the wrong size for its type");
      position_ += size;
    }
  }

  static bool has_type(const Attributes& part, std::string_view beginning) {
    const auto type = part.find("type");
    return type != part.end() && type->second.size() >= beginning.size() &&
           std::ranges::equal(type->second.first(beginning.size()),
                              std::as_bytes(std::span(beginning)));
  }
  static bool is_deep(const Attributes& part) { return has_type(part, "deep"); }

  ByteView attribute(const Attributes& part, std::string_view name, std::size_t least_size) const {
    const auto found = part.find(name);
    if (found == part.end() || found->second.size() < least_size)
      fail("corrupt: its header has no usable '" + std::string(name) + "'");
    return found->second;
  }

  static std::int64_t int_at(ByteView bytes, std::size_t offset) {
    return load<std::int32_t>(&bytes[offset], std::endian::little);
  }

  std::uint64_t bytes_of_a_pixel(ByteView list) const {
    std::uint64_t sum = 0;
    for (std::size_t k = 0; k < list.size() && list[k] != std::byte{0};) {
      while (k < list.size() && list[k] != std::byte{0}) ++k;
      if (list.size() - k < 17) fail("corrupt: its list of channels is truncated");
      sum += int_at(list, k + 1) == 1 ? 2 : 4;  // HALF; FLOAT and UINT
      if (int_at(list, k + 9) != 1 || int_at(list, k + 13) != 1)
        fail("subsampled channels are not read: expected every channel at every pixel");
      k += 17;
    }
    if (sum == 0) fail("it has no channels");
    return sum;
  }

  /// `bytes_of_pixel` is 0 for a part that is not read.
  void check_part(const Attributes& part, std::uint64_t bytes_of_pixel) const {
    const ByteView window = attribute(part, "dataWindow", 16);
    const std::int64_t columns = int_at(window, 8) - int_at(window, 0) + 1;
    const std::int64_t rows = int_at(window, 12) - int_at(window, 4) + 1;
    if (columns < 1 || rows < 1) fail("corrupt: its data window is empty");
    const auto code = static_cast<std::size_t>(attribute(part, "compression", 1)[0]);
    if (code >= compression_bounds.size()) fail("its compression is not known");
    const CompressionBound bound = compression_bounds[code];
    const auto width = static_cast<std::uint64_t>(columns),
               height = static_cast<std::uint64_t>(rows);
    const bool tiled = part.contains("tiles");
    if (part.contains("chunkCount") &&
        static_cast<std::uint64_t>(int_at(attribute(part, "chunkCount", 4), 0)) > bytes_.size() / 8)
      refuse(width, height);
    if (!tiled && (height - 1) / bound.lines >= bytes_.size() / 8) refuse(width, height);
    if (bytes_of_pixel == 0) return;

    // width·height < 2^64 is compared with a quotient: times a pixel's bytes it might overflow.
    const std::uint64_t most_bytes = bytes_.size() * bound.ratio;
    if (width * height > most_bytes / bytes_of_pixel) refuse(width, height);
    const std::uint64_t allowed = std::max(most_bytes, block_bytes) / bytes_of_pixel;
    if (tiled) {
      check_tiles(attribute(part, "tiles", 9), width, height, allowed);
    } else if (width > allowed / bound.lines) {
      refuse(width, height);
    }
  }

  /// Each chunk is one row: its y, the packed sizes of its counts and of its samples, and the
  /// unpacked size of these, which OpenEXR allocates. The table of where they are comes first.
  std::uint64_t check_deep_chunks(const Attributes& part) const {
    const ByteView window = attribute(part, "dataWindow", 16);
    const auto rows = static_cast<std::uint64_t>(int_at(window, 12) - int_at(window, 4) + 1);
    const auto code = static_cast<std::size_t>(attribute(part, "compression", 1)[0]);
    const auto number = [&](std::uint64_t at) {
      return load<std::uint64_t>(&bytes_[at], std::endian::little);
    };
    if ((bytes_.size() - position_) / 8 < rows) fail("truncated: its table of rows does not end");
    std::uint64_t sum = 0;
    for (std::uint64_t row = 0; row < rows; ++row) {
      const std::uint64_t at = number(position_ + 8 * row);
      if (at > bytes_.size() || bytes_.size() - at < deep_chunk_header)
        fail("corrupt or truncated: a row is outside the file");
      const std::uint64_t rest = bytes_.size() - at - deep_chunk_header;
      const std::uint64_t counts = number(at + 4), packed = number(at + 12),
                          samples = number(at + 20);
      if (counts > rest || packed > rest - counts ||
          samples > packed * compression_bounds[code].ratio)
        fail("corrupt or truncated: a row claims more samples than the file can hold");
      sum += samples;
    }
    return sum;
  }

  /// OpenEXR allocates whole chunks and rows of tiles even where the image ends inside them: these
  /// may take so much, if the file cannot hold more.
  static constexpr std::uint64_t block_bytes = std::uint64_t{1} << 26;

  /// `allowed` pixels may be in the tiles of a row.
  void check_tiles(ByteView tiles, std::uint64_t width, std::uint64_t height,
                   std::uint64_t allowed) const {
    const std::int64_t tile_width = int_at(tiles, 0), tile_height = int_at(tiles, 4);
    if (tile_width < 1 || tile_height < 1) fail("corrupt: its tiles are empty");
    const auto w = static_cast<std::uint64_t>(tile_width),
               h = static_cast<std::uint64_t>(tile_height);
    if (w * h > allowed || (width + w) > allowed / h) refuse(width, height);
    if ((width + w - 1) / w > bytes_.size() / 8 / ((height + h - 1) / h)) refuse(width, height);
  }

  [[noreturn]] void refuse(std::uint64_t width, std::uint64_t height) const {
    fail("corrupt or truncated: its header claims " + std::to_string(width) + "×" +
         std::to_string(height) + " pixels, more than " + std::to_string(bytes_.size()) +
         " bytes can hold");
  }

  ByteView bytes_;
  const std::string& name_;
  std::size_t position_ = 0;
  std::vector<std::size_t> defused_;
};

}  // namespace

bool is_deep_of_one_part(std::uint32_t version) {
  return (version & (flag_deep | flag_multipart)) == flag_deep;
}

std::vector<std::size_t> check_exr_claims(ByteView bytes, const std::string& name) {
  return Claims(bytes, name).check();
}

DeepClaims check_deep_exr_claims(ByteView bytes, const std::string& name) {
  return Claims(bytes, name).check_deep();
}

}  // namespace fathom::image
