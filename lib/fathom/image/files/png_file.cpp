#include <algorithm>
#include <charconv>
#include <csetjmp>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <new>
#include <span>

#include "fathom/failures/errors.h"
#include "fathom/files/byte_order.h"
#include "fathom/image/channel_names.h"
#include "fathom/image/channel_table.h"
#include "fathom/image/files/file_texts.h"
#include "fathom/image/files/map_codecs.h"
#include "fathom/image/files/png_picture.h"
#include "fathom/image/png_files.h"
#include "fathom/image/png_stream.h"
#include "fathom/image/surface.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/decimal.h"
#include "fathom/text/json_text.h"
#include "fathom/text/version.h"

namespace fathom::image {
using namespace files;
using namespace text;

namespace {

std::vector<std::uint16_t> identifiers_as_codes(const Samples<std::uint32_t>& ids, bool segments,
                                                const std::string& name) {
  const std::uint32_t most = segments ? 65533 : 65534;
  std::vector<std::uint16_t> codes(ids.size());
  for (std::size_t k = 0; k < ids.size(); ++k) {
    if (ids[k] == no_surface) {
      codes[k] = 65535;
    } else if (segments && ids[k] == no_segment) {
      codes[k] = 65534;
    } else if (ids[k] <= most) {
      codes[k] = static_cast<std::uint16_t>(ids[k]);
    } else {
      throw OutputError(name + ": identifier " + std::to_string(ids[k]) +
                        " does not fit a 16-bit PNG: expected at most " + std::to_string(most));
    }
  }
  return codes;
}

void add_texts(PngPicture& picture, const DepthMap& map, const ImageChannel& channel,
               const std::string& name) {
  picture.texts = {{"Software", software_in_outputs()}, {channel_text, channel.name}};
  if (std::holds_alternative<Samples<std::uint32_t>>(channel.values))
    picture.texts.emplace_back(type_text, "identifier");
  else if (map.png_scale)
    picture.texts.emplace_back(scale_text, text::shortest_decimal(*map.png_scale));
  if (map.codes_beyond && std::holds_alternative<Samples<std::uint16_t>>(channel.values))
    picture.texts.emplace_back(beyond_text, std::to_string(*map.codes_beyond));
  add_texts_of_map(picture, map, name);
}

}  // namespace

Bytes encode_png(const DepthMap& map, const ImageChannel& channel, const std::string& name) {
  std::vector<std::uint16_t> codes;
  if (const auto* ids = std::get_if<Samples<std::uint32_t>>(&channel.values))
    codes = identifiers_as_codes(*ids, shows_segments(channel.name), name);
  else if (const auto* stored = std::get_if<Samples<std::uint16_t>>(&channel.values))
    codes.assign(stored->begin(), stored->end());
  else
    throw OutputError(name + ": PNG holds 16-bit codes, and channel '" + channel.name +
                      "' is stored as floating point; " +
                      (kind_of(channel) == ChannelKind::depth
                           ? "give a scale, in codes per scene unit"
                           : "write " + suffixes_for_any_channel()));
  PngPicture picture{map.width, map.height, 16, PngColour::grey, {}, {}};
  picture.pixels.resize(2 * codes.size());
  for (std::size_t k = 0; k < codes.size(); ++k)
    store(&picture.pixels[2 * k], codes[k], std::endian::big);
  add_texts(picture, map, channel, name);
  return encode(picture, name);
}

// Reading.

void png_fail(png_structp png, png_const_charp reason) {
  auto* failure = static_cast<PngFailure*>(png_get_error_ptr(png));
  std::strncpy(failure->reason, reason, sizeof failure->reason - 1);
  png_longjmp(png, 1);
}

void png_ignore_warning(png_structp, png_const_charp) {}

png_voidp png_allocate(png_structp png, png_alloc_size_t size) {
  void* block = std::malloc(size);
  if (block == nullptr) static_cast<PngFailure*>(png_get_mem_ptr(png))->out_of_memory = true;
  return block;
}

void png_deallocate(png_structp, png_voidp block) {
  std::free(block);
}

namespace {

/// Everything that a read holds, so that nothing is lost when libpng jumps.
struct Reading {
  png_structp png = nullptr;
  png_infop info = nullptr;
  PngFailure failure;
  ByteView bytes;
  std::size_t position = 0;
  std::vector<png_byte> pixels;
  std::vector<png_bytep> rows;

  explicit Reading(ByteView file) : bytes(file) {
    png = png_create_read_struct_2(PNG_LIBPNG_VER_STRING, &failure, png_fail, png_ignore_warning,
                                   &failure, png_allocate, png_deallocate);
    info = png ? png_create_info_struct(png) : nullptr;
    if (!info) {
      png_destroy_read_struct(&png, nullptr, nullptr);
      throw std::bad_alloc();
    }
  }
  Reading(const Reading&) = delete;
  Reading& operator=(const Reading&) = delete;
  ~Reading() { png_destroy_read_struct(&png, &info, nullptr); }
};

void read_bytes(png_structp png, png_bytep to, std::size_t count) {
  auto* reading = static_cast<Reading*>(png_get_io_ptr(png));
  if (count > reading->bytes.size() - reading->position) png_error(png, "unexpected end of file");
  std::memcpy(to, reading->bytes.data() + reading->position, count);
  reading->position += count;
}

bool read_header(Reading& reading) {
  if (setjmp(png_jmpbuf(reading.png))) return false;
  png_set_read_fn(reading.png, &reading, read_bytes);
  png_set_user_limits(reading.png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  // For compressed texts, at least libpng's usual limit.
  png_set_chunk_malloc_max(reading.png, std::max<std::size_t>(reading.bytes.size(), 8000000));
  png_read_info(reading.png, reading.info);
  return true;
}

bool read_pixels(Reading& reading) {
  if (setjmp(png_jmpbuf(reading.png))) return false;
  png_read_image(reading.png, reading.rows.data());
  png_read_end(reading.png, reading.info);
  return true;
}

void read_texts(const Reading& reading, DepthMap& map) {
  png_textp texts = nullptr;
  int count = 0;
  png_get_text(reading.png, reading.info, &texts, &count);
  for (int k = 0; k < count; ++k)
    if (texts[k].text) map.texts[texts[k].key] = texts[k].text;
}

std::optional<std::string> take_text(DepthMap& map, const std::string& key) {
  const auto found = map.texts.find(key);
  if (found == map.texts.end()) return std::nullopt;
  std::string text = found->second;
  map.texts.erase(found);
  return text;
}

/// Takes the lists of names among the texts.
void take_name_tables(DepthMap& map) {
  for (auto text = map.texts.begin(); text != map.texts.end();) {
    const bool is_table = is_name_table(text->first);
    if (is_table) take_name_table(text->first, text->second, map);
    text = is_table ? map.texts.erase(text) : std::next(text);
  }
}

/// The meaning of a PNG's pixels, by its header and texts.
enum class Pixels { codes, normals, mask, other };

Pixels pixels_of(const Reading& reading, const DepthMap& texts) {
  const int bits = png_get_bit_depth(reading.png, reading.info);
  const int colour = png_get_color_type(reading.png, reading.info);
  if (bits == 16 && colour == PNG_COLOR_TYPE_GRAY) return Pixels::codes;
  const auto type = texts.texts.find(type_text);
  if (type == texts.texts.end()) return Pixels::other;
  if (colour == PNG_COLOR_TYPE_RGB && type->second == normal_type) return Pixels::normals;
  if (bits == 8 && colour == PNG_COLOR_TYPE_GRAY && type->second == mask_type) return Pixels::mask;
  return Pixels::other;
}

/// Bytes of a pixel in the rows of the file.
std::uint64_t bytes_of_pixel(const Reading& reading) {
  return png_get_channels(reading.png, reading.info) *
         (png_get_bit_depth(reading.png, reading.info) / 8u);
}

ImageChannel mask_from(const Reading& reading, std::uint64_t pixels) {
  Samples<float> mask(pixels);
  std::transform(reading.pixels.begin(), reading.pixels.end(), mask.begin(),
                 [](png_byte value) { return value != 0 ? 1.0f : 0.0f; });
  return {"mask", std::move(mask)};
}

/// Codes or, if the file declares them, identifiers.
ImageChannel channel_from(Samples<std::uint16_t> codes, DepthMap& map) {
  const std::string channel = take_text(map, channel_text).value_or("Z");
  if (take_text(map, type_text) != "identifier") return {channel, std::move(codes)};
  Samples<std::uint32_t> ids(codes.size());
  const bool segments = shows_segments(channel);
  for (std::size_t k = 0; k < codes.size(); ++k) {
    ids[k] = codes[k];
    if (codes[k] == 65535) ids[k] = no_surface;
    if (codes[k] == 65534 && segments) ids[k] = no_segment;
  }
  return {channel, std::move(ids)};
}

/// The channels of normals, or a mask, whose rows have been read.
DepthMap map_of_picture(const Reading& reading, Pixels kind, DepthMap map) {
  const std::uint64_t pixels = std::uint64_t{map.width} * map.height;
  const std::string channel = take_text(map, channel_text).value_or("N");
  const bool flips = take_text(map, axes_text) == "opengl";
  (void)take_text(map, type_text);
  take_name_tables(map);
  if (kind == Pixels::mask) {
    map.channels.push_back(mask_from(reading, pixels));
  } else {
    map.channels = normals_from(std::as_bytes(std::span(reading.pixels)), pixels,
                                png_get_bit_depth(reading.png, reading.info), flips, channel);
  }
  return map;
}

}  // namespace

DepthMap decode_png(ByteView bytes, const std::string& name, const MapMemory& memory) {
  Reading reading(bytes);
  const auto fail = [&](const std::string& reason) {
    throw InputError(name + ": corrupt or truncated PNG file: " + reason);
  };
  if (!chunks_fit(bytes)) fail("a chunk is longer than the file");
  const bool has_header = read_header(reading);
  if (reading.failure.out_of_memory) throw std::bad_alloc();
  if (!has_header) fail(reading.failure.reason);
  DepthMap map;
  map.width = png_get_image_width(reading.png, reading.info);
  map.height = png_get_image_height(reading.png, reading.info);
  // The texts before the pixels distinguish normals and masks from pictures.
  read_texts(reading, map);
  const Pixels kind = pixels_of(reading, map);
  if (kind == Pixels::other)
    throw InputError(name +
                     ": a picture, not a depth map: expected a PNG of one 16-bit grey channel");
  const std::uint64_t pixels = std::uint64_t{map.width} * map.height;
  const std::uint64_t pixel_bytes = bytes_of_pixel(reading);
  if (pixels > bytes.size() * greatest_deflate_ratio / pixel_bytes)
    fail("its header claims " + std::to_string(map.width) + "×" + std::to_string(map.height) +
         " pixels, more than " + std::to_string(bytes.size()) + " bytes can hold");

  // Rows as libpng gives them, the same as codes, and identifiers; or normals, or a mask.
  const std::uint64_t held = kind == Pixels::codes ? 2 + 4 : kind == Pixels::normals ? 12 : 4;
  require_map_memory(map.width, map.height, pixel_bytes + held, bytes.size(), memory, name);
  reading.pixels.resize(pixel_bytes * pixels);
  reading.rows.resize(map.height);
  for (std::size_t y = 0; y < map.height; ++y)
    reading.rows[y] = &reading.pixels[y * pixel_bytes * map.width];
  const bool has_pixels = read_pixels(reading);
  if (reading.failure.out_of_memory) throw std::bad_alloc();
  if (!has_pixels) fail(reading.failure.reason);

  read_texts(reading, map);
  const auto* data = reinterpret_cast<const std::byte*>(reading.pixels.data());
  if (kind != Pixels::codes) return map_of_picture(reading, kind, std::move(map));
  Samples<std::uint16_t> codes(pixels);
  for (std::size_t k = 0; k < pixels; ++k)
    codes[k] = load<std::uint16_t>(data + 2 * k, std::endian::big);
  if (const auto text = take_text(map, scale_text)) map.png_scale = read_scale(*text, name);
  if (const auto text = take_text(map, beyond_text)) {
    std::uint64_t beyond = 0;
    const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), beyond);
    if (error != std::errc() || end != text->data() + text->size() || beyond > pixels)
      throw InputError(name + ": its fathom:beyond is '" + text->substr(0, 40) +
                       "': expected a number of pixels");
    map.codes_beyond = beyond;
  }
  take_name_tables(map);
  map.channels.push_back(channel_from(std::move(codes), map));
  return map;
}

}  // namespace fathom::image

namespace fathom {
namespace {

std::string json_member(const char* name, const std::string& json) {
  return text::json_string(name) + ": " + json;
}

const ImageChannel& channel_in_png(const DepthMap& map, const std::string& name) {
  if (name.empty() && map.channels.size() == 1) return map.channels.front();
  if (const ImageChannel* channel = map.find(name)) return *channel;
  if (!name.empty()) throw missing_channel(map, name);
  throw ambiguous_channel(names_of_channels(map), "the map has", "describe");
}

}  // namespace

std::string png_sidecar(const DepthMap& map, const std::string& name) {
  const StandardArithmetic standard;
  require_valid(map);
  const ImageChannel& channel = channel_in_png(map, name);
  const bool identifiers = std::holds_alternative<Samples<std::uint32_t>>(channel.values);
  std::string json = "{" + json_member("channel", text::json_string(channel.name));
  if (!identifiers && map.png_scale) {
    json += ", " + json_member("unit", text::json_string("codes per scene unit")) + ", " +
            json_member("scale", text::shortest_decimal(*map.png_scale));
  }
  json += ", " + json_member("none", identifiers ? "65535" : "0");
  if (!identifiers)
    json += ", " + json_member("beyond", std::to_string(map.codes_beyond.value_or(0)));
  json += ", " + json_member("width", std::to_string(map.width)) + ", " +
          json_member("height", std::to_string(map.height));
  return json + "}\n";
}

}  // namespace fathom
