#include "fathom/image/map_files.h"

#include <algorithm>
#include <cstring>

#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/image/background.h"
#include "fathom/image/channel_names.h"
#include "fathom/image/files/map_codecs.h"
#include "fathom/image/files/npy_array.h"
#include "fathom/image/missing_channel.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/json_text.h"
#include "fathom/threads/threads.h"

namespace fathom {
using namespace image;
using namespace files;
using namespace text;

namespace {

const std::string one_channel = "this format holds one channel";

/// The error of a channel of several parts, of which a file cannot hold more than one.
UsageError one_part_only(const DepthMap& map, const std::string& name) {
  return {Setting{"channel"}, one_channel + ", and " + text_of_parts(map, name) +
                                  "; name the one to write, or write .npy or .exr"};
}

const ImageChannel& channel_to_write(const DepthMap& map, const std::string& asked) {
  if (!asked.empty()) {
    if (const ImageChannel* channel = map.find(asked)) return *channel;
    if (!parts_of(map, asked).empty()) throw one_part_only(map, asked);
    throw missing_channel(map, asked);
  }
  if (map.channels.size() != 1) {
    const std::vector<std::string> names = names_of_channels(map);
    if (names.size() == 1) throw one_part_only(map, names[0]);
    throw ambiguous_channel(names, one_channel + ", and the map has", "write");
  }
  return map.channels.front();
}

/// As channel_to_write(), or those that are together the one that is asked for, or all there are.
std::vector<const ImageChannel*> channels_to_write(const DepthMap& map, const std::string& asked) {
  if (map.find(asked) == nullptr) {
    const std::string& first = map.channels.front().name;
    std::vector<const ImageChannel*> parts =
        parts_of(map, asked.empty() ? first.substr(0, first.rfind('.')) : asked);
    if (!parts.empty() && (!asked.empty() || parts.size() == map.channels.size())) return parts;
  }
  return {&channel_to_write(map, asked)};
}

bool starts_with(ByteView bytes, std::string_view magic) {
  return bytes.size() >= magic.size() && std::memcmp(bytes.data(), magic.data(), magic.size()) == 0;
}

}  // namespace

std::optional<MapFormat> map_format_of(const std::filesystem::path& path) {
  std::string suffix = path.extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(), [](char c) {
    return 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  if (suffix == ".exr") return MapFormat::exr;
  if (suffix == ".pfm") return MapFormat::pfm;
  if (suffix == ".png") return MapFormat::png;
  if (suffix == ".npy") return MapFormat::npy;
  if (suffix == ".npz") return MapFormat::npz;
  if (suffix == ".bin") return MapFormat::colmap;
  if (suffix == ".tif" || suffix == ".tiff") return MapFormat::tiff;
  return std::nullopt;
}

bool is_colmap_map(ByteView bytes) {
  // As many digits as a 64-bit number has, so that one that is too large is told as such.
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()),
                              std::min<std::size_t>(bytes.size(), 21));
  const std::size_t end = text.find_first_not_of("0123456789");
  return end != 0 && end != std::string_view::npos && text[end] == '&';
}

void require_size(MapFormat format, std::uint32_t width, std::uint32_t height,
                  const std::string& name) {
  if (format == MapFormat::exr && std::max(width, height) > 0x3FFFFFFF) {
    throw OutputError(name + ": EXR holds fewer than 2^30 pixels a side");
  }
  if (format == MapFormat::png && std::max(width, height) > 0x7FFFFFFF) {
    throw OutputError(name + ": PNG holds fewer than 2^31 pixels a side");
  }
  // Of 4 bytes each, at least.
  if (format == MapFormat::npz && std::uint64_t{width} * height >= (std::uint64_t{1} << 30)) {
    throw OutputError(name + ": an NPZ holds less than 4 GiB; .exr holds more");
  }
  if (format == MapFormat::tiff && std::uint64_t{width} * height >= (std::uint64_t{1} << 30)) {
    throw OutputError(name + ": a GeoTIFF holds less than 4 GiB; .exr holds more");
  }
}

double memory_to_encode(MapFormat format, Compression compression, std::uint32_t height,
                        double bytes_of_map) {
  const StandardArithmetic standard;
  if (format == MapFormat::png || format == MapFormat::tiff) return 0;
  return format == MapFormat::exr ? memory_to_encode_exr(compression, height, bytes_of_map)
                                  : bytes_of_map;
}

std::vector<std::byte> encode_map(const DepthMap& map, const std::string& name, MapFormat format,
                                  const WriteOptions& options) {
  const StandardArithmetic standard;
  require_valid(map);
  require_thread_count(options.threads);
  const auto one = [&]() -> const ImageChannel& { return channel_to_write(map, options.channel); };
  switch (format) {
    case MapFormat::exr:
      return encode_exr(map, options.compression, options.threads, name);
    case MapFormat::pfm:
      return encode_pfm(map, one(), name);
    case MapFormat::png:
      return encode_png(map, one(), name);
    case MapFormat::npy:
      return encode_npy(map, channels_to_write(map, options.channel), name);
    case MapFormat::npz:
      return encode_npz(map, name);
    case MapFormat::colmap:
      return encode_colmap(map, channels_to_write(map, options.channel), name);
    case MapFormat::tiff:
      return encode_geotiff(map, options.camera, options.threads, name);
  }
  throw UsageError(name + ": there is no such format");
}

void write_map(const DepthMap& map, const std::filesystem::path& path, MapFormat format,
               const WriteOptions& options) {
  const StandardArithmetic standard;
  write_file(path, encode_map(map, path.string(), format, options));
}

namespace {

DepthMap decode_as_stored(ByteView bytes, const std::string& name, const MapMemory& memory) {
  if (starts_with(bytes, "\x76\x2f\x31\x01")) return decode_exr(bytes, name, memory);
  if (starts_with(bytes, "\x89PNG\r\n\x1a\n")) return decode_png(bytes, name, memory);
  if (starts_with(bytes, "\x93NUMPY")) return decode_npy(bytes, name);
  if (starts_with(bytes, "PK\x03\x04")) return decode_npz(bytes, name, memory);
  if (starts_with(bytes, "Pf") || starts_with(bytes, "PF")) return decode_pfm(bytes, name);
  if (is_colmap_map(bytes)) return decode_colmap(bytes, name);
  if (starts_with(bytes, std::string_view("II*\0", 4)) ||
      starts_with(bytes, std::string_view("MM\0*", 4)))
    throw InputError(name + ": TIFF is written, not read: give the map as EXR, NPZ or NPY");
  throw InputError(name + ": not a map: expected an OpenEXR, PFM, PNG, NPY, NPZ or COLMAP file");
}

}  // namespace

DepthMap image::decode_map(ByteView bytes, const std::string& name, const MapMemory& memory) {
  DepthMap map = with_own_channel_names(decode_as_stored(bytes, name, memory));
  try {
    (void)declared_background(map);
  } catch (const InputError& error) {
    throw InputError(name + ": " + error.what());
  }
  return map;
}

namespace {

InputFile open_copied(const std::filesystem::path& path, const MapMemory& memory) {
  std::error_code unknown;
  const auto size = std::filesystem::file_size(path, unknown);
  if (!unknown) require_memory(path.string() + ": this file", 1.0 * size, memory.allowance);
  return InputFile(path, InputFile::Reading::copied);
}

}  // namespace

DepthMap read_map(const std::filesystem::path& path, const MapMemory& memory) {
  const StandardArithmetic standard;
  const InputFile input = open_copied(path, memory);
  return decode_map(input.bytes(), path.string(), memory);
}

DepthMap read_npz_array(const std::filesystem::path& path, const std::string& array,
                        const MapMemory& memory) {
  const StandardArithmetic standard;
  const InputFile input = open_copied(path, memory);
  return decode_npz_array(input.bytes(), array, path.string(), memory);
}

DepthMap read_map(std::span<const std::byte> bytes, const std::string& name,
                  const MapMemory& memory) {
  const StandardArithmetic standard;
  return decode_map(bytes, name, memory);
}

}  // namespace fathom
