#include "fathom/image/map_files.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/image/channel_names.h"
#include "fathom/image/files/map_codecs.h"
#include "fathom/image/files/npy_array.h"
#include "fathom/image/files/renamed_channels.h"
#include "fathom/image/png_files.h"
#include "fathom/image/surface.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/json_text.h"
#include "fathom/threads/threads.h"

namespace fathom {
using namespace image;
using namespace files;
using namespace text;

namespace {

const std::string one_channel = "this format holds one channel";

/// The error for a channel of several parts in a format that holds a single channel.
UsageError one_part_only(const DepthMap& map, const std::string& name) {
  return {Setting{"channel"}, one_channel + ", and " + text_of_parts(map, name) +
                                  "; name the one to write, or write " +
                                  suffixes_for_any_channel()};
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

/// As channel_to_write(); or the parts of the requested channel; or all channels.
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

std::string_view name_of(Compression compression) {
  constexpr std::string_view names[] = {"none", "rle", "zips", "zip", "piz"};
  return names[static_cast<std::size_t>(compression)];
}

bool is_colmap_map(ByteView bytes) {
  // As many digits as a 64-bit number has, so that larger numbers are reported as too large.
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()),
                              std::min<std::size_t>(bytes.size(), 21));
  const std::size_t end = text.find_first_not_of("0123456789");
  return end != 0 && end != std::string_view::npos && text[end] == '&';
}

namespace {

const ImageChannel& one_of(const DepthMap& map, const WriteOptions& options) {
  return channel_to_write(map, options.channel);
}

std::vector<const ImageChannel*> some_of(const DepthMap& map, const WriteOptions& options) {
  return channels_to_write(map, options.channel);
}

Bytes encode_any_png(const DepthMap& map, const WriteOptions& options, const std::string& name) {
  const std::vector<const ImageChannel*> parts = some_of(map, options);
  if (parts.size() == 3 && kind_of(*parts[0]) == ChannelKind::direction) {
    return encode_normals(map, parts, options.normals, name);
  }
  if (parts[0]->name == "mask" && std::holds_alternative<Samples<float>>(parts[0]->values)) {
    return encode_mask(map, name);
  }
  return encode_png(map, one_of(map, options), name);
}

[[noreturn]] DepthMap refuse_tiff(ByteView /*bytes*/, const std::string& name,
                                  const MapMemory& /*memory*/) {
  throw InputError(name + ": TIFF is written, not read: give the map as EXR, NPZ or NPY");
}

double nothing(Compression /*compression*/, std::uint32_t /*height*/, double /*bytes_of_map*/) {
  return 0;
}

double as_much(Compression /*compression*/, std::uint32_t /*height*/, double bytes_of_map) {
  return bytes_of_map;
}

/// How maps become files of a format, and files maps.
struct Codec {
  MapFormat format;
  Bytes (*encode)(const DepthMap& map, const WriteOptions& options, const std::string& name);
  bool (*begins)(ByteView bytes);
  DepthMap (*decode)(ByteView bytes, const std::string& name, const MapMemory& memory);
  /// As memory_to_encode().
  double (*memory)(Compression compression, std::uint32_t height, double bytes_of_map);
};

/// In the order of MapFormat.
constexpr auto codecs = std::to_array<Codec>({
    {MapFormat::exr,
     [](const DepthMap& map, const WriteOptions& options, const std::string& name) {
       return encode_exr(map, options.compression, options.threads, name);
     },
     [](ByteView bytes) { return starts_with(bytes, "\x76\x2f\x31\x01"); }, decode_exr,
     memory_to_encode_exr},
    {MapFormat::pfm,
     [](const DepthMap& map, const WriteOptions& options, const std::string& name) {
       return encode_pfm(map, one_of(map, options), name);
     },
     [](ByteView bytes) { return starts_with(bytes, "Pf") || starts_with(bytes, "PF"); },
     [](ByteView bytes, const std::string& name, const MapMemory& /*memory*/) {
       return decode_pfm(bytes, name);
     },
     as_much},
    {MapFormat::png,
     [](const DepthMap& map, const WriteOptions& options, const std::string& name) {
       return encode_any_png(map, options, name);
     },
     [](ByteView bytes) { return starts_with(bytes, "\x89PNG\r\n\x1a\n"); }, decode_png, nothing},
    {MapFormat::npy,
     [](const DepthMap& map, const WriteOptions& options, const std::string& name) {
       return encode_npy(map, some_of(map, options), name);
     },
     [](ByteView bytes) { return starts_with(bytes, "\x93NUMPY"); },
     [](ByteView bytes, const std::string& name, const MapMemory& /*memory*/) {
       return decode_npy(bytes, name);
     },
     as_much},
    {MapFormat::npz,
     [](const DepthMap& map, const WriteOptions& /*options*/, const std::string& name) {
       return encode_npz(map, name);
     },
     [](ByteView bytes) { return starts_with(bytes, "PK\x03\x04"); }, decode_npz, as_much},
    {MapFormat::colmap,
     [](const DepthMap& map, const WriteOptions& options, const std::string& name) {
       return encode_colmap(map, some_of(map, options), name);
     },
     is_colmap_map,
     [](ByteView bytes, const std::string& name, const MapMemory& /*memory*/) {
       return decode_colmap(bytes, name);
     },
     as_much},
    {MapFormat::tiff,
     [](const DepthMap& map, const WriteOptions& options, const std::string& name) {
       return encode_geotiff(map, options.camera, options.threads, name);
     },
     [](ByteView bytes) {
       return starts_with(bytes, std::string_view("II*\0", 4)) ||
              starts_with(bytes, std::string_view("MM\0*", 4));
     },
     refuse_tiff, nothing},
});
static_assert(std::ranges::equal(codecs, map_format_table, {}, &Codec::format,
                                 &MapFormatDescription::format),
              "each format has a codec");

const Codec& codec_of(MapFormat format) {
  return codecs[static_cast<std::size_t>(format)];
}

}  // namespace

double memory_to_encode(MapFormat format, Compression compression, std::uint32_t height,
                        double bytes_of_map) {
  const StandardArithmetic standard;
  return codec_of(format).memory(compression, height, bytes_of_map);
}

std::vector<std::byte> encode_map(const DepthMap& map, const std::string& name, MapFormat format,
                                  const WriteOptions& options) {
  const StandardArithmetic standard;
  require_valid(map);
  require_thread_count(options.threads);
  if (static_cast<std::size_t>(format) >= codecs.size())
    throw UsageError(name + ": unknown format");
  return codec_of(format).encode(map, options, name);
}

void write_map(const DepthMap& map, const std::filesystem::path& path, MapFormat format,
               const WriteOptions& options) {
  const StandardArithmetic standard;
  write_file(path, encode_map(map, path.string(), format, options));
}

namespace {

DepthMap decode_as_stored(ByteView bytes, const std::string& name, const MapMemory& memory) {
  for (const Codec& codec : codecs)
    if (codec.begins(bytes)) return codec.decode(bytes, name, memory);
  throw InputError(name + ": not a map: expected an " + names_of_readable_maps() + " file");
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

namespace {

/// Whether this is an archive whose first member is an array of NumPy's. Meshes come in archives,
/// too (3MF).
bool is_npz(std::string_view content) {
  constexpr std::size_t name_at = 30;
  if (!content.starts_with("PK\x03\x04") || content.size() < name_at) return false;
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(content[i]); };
  const std::size_t length = byte(26) + std::size_t{256} * byte(27);
  return content.substr(name_at, length).ends_with(".npy");
}

}  // namespace

bool is_map(std::span<const std::byte> bytes) {
  using namespace std::string_view_literals;
  const std::string_view content(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  static constexpr std::array magics{
      "\x76\x2f\x31\x01"sv, "\x89PNG"sv, "\x93NUMPY"sv, "Pf"sv, "PF"sv, "II*\0"sv, "MM\0*"sv};
  return std::ranges::any_of(magics,
                             [&](std::string_view magic) { return content.starts_with(magic); }) ||
         is_npz(content) || is_colmap_map(bytes);
}

void image::require_map_memory(std::uint32_t width, std::uint32_t height,
                               std::uint64_t bytes_per_pixel, std::uint64_t file_bytes,
                               const MapMemory& memory, const std::string& name) {
  const std::string what =
      name + ": an image of " + std::to_string(width) + "×" + std::to_string(height) + " pixels";
  const double needed = 1.0 * width * height * static_cast<double>(bytes_per_pixel);
  require_memory(what, needed, memory.allowance);
  if (memory.of_small_file && needed > MapMemory::usual_ratio * static_cast<double>(file_bytes)) {
    require_memory(what, needed, *memory.of_small_file);
  }
}

}  // namespace fathom
