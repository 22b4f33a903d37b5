#include <algorithm>
#include <csetjmp>
#include <new>
#include <utility>

#include "fathom/failures/errors.h"
#include "fathom/files/byte_order.h"
#include "fathom/image/channel_names.h"
#include "fathom/image/channel_table.h"
#include "fathom/image/files/code_texts.h"
#include "fathom/image/files/map_codecs.h"
#include "fathom/image/files/name_tables.h"
#include "fathom/image/png_files.h"
#include "fathom/image/png_stream.h"
#include "fathom/image/rgb_image.h"
#include "fathom/image/surface.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/decimal.h"
#include "fathom/text/json_text.h"
#include "fathom/text/version.h"

namespace fathom::image {
using namespace files;
using namespace text;

namespace {

/// A PNG to be written: rows of bytes as PNG has them.
struct Picture {
  std::uint32_t width = 0, height = 0;
  int bit_depth = 8, colour_type = PNG_COLOR_TYPE_RGB;
  std::vector<std::byte> pixels;
  std::vector<std::pair<std::string, std::string>> texts;
};

/// Everything that a write holds, so that nothing is lost when libpng jumps.
struct Writing {
  png_structp png = nullptr;
  png_infop info = nullptr;
  PngFailure failure;
  Bytes bytes;
  std::vector<png_text> texts;
  std::vector<png_bytep> rows;

  Writing() {
    png = png_create_write_struct_2(PNG_LIBPNG_VER_STRING, &failure, png_fail, png_ignore_warning,
                                    &failure, png_allocate, png_deallocate);
    info = png ? png_create_info_struct(png) : nullptr;
    if (!info) {
      png_destroy_write_struct(&png, nullptr);
      throw std::bad_alloc();
    }
  }
  Writing(const Writing&) = delete;
  Writing& operator=(const Writing&) = delete;
  ~Writing() { png_destroy_write_struct(&png, &info); }
};

void append_bytes(png_structp png, png_bytep from, std::size_t count) {
  auto* writing = static_cast<Writing*>(png_get_io_ptr(png));
  append(writing->bytes, std::as_bytes(std::span(from, count)));
}

void flush_nothing(png_structp) {}

bool write_all(Writing& writing, const Picture& picture) {
  if (setjmp(png_jmpbuf(writing.png))) return false;
  png_set_write_fn(writing.png, &writing, append_bytes, flush_nothing);
  png_set_user_limits(writing.png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  png_set_IHDR(writing.png, writing.info, picture.width, picture.height, picture.bit_depth,
               picture.colour_type, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  if (!writing.texts.empty())
    png_set_text(writing.png, writing.info, writing.texts.data(),
                 static_cast<int>(writing.texts.size()));
  png_write_info(writing.png, writing.info);
  png_write_image(writing.png, writing.rows.data());
  png_write_end(writing.png, nullptr);
  return true;
}

bool is_plain(const std::string& text) {
  return std::all_of(text.begin(), text.end(),
                     [](char c) { return c == '\n' || (' ' <= c && c <= '~'); });
}

/// tEXt where plain characters are enough, else iTXt, which is UTF-8.
png_text as_chunk(const std::string& key, const std::string& text) {
  png_text chunk{};
  chunk.compression = is_plain(text) ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
  chunk.key = const_cast<char*>(key.c_str());
  chunk.text = const_cast<char*>(text.c_str());
  chunk.text_length = text.size();
  return chunk;
}

Bytes encode(Picture& picture, const std::string& name) {
  Writing writing;
  for (const auto& [key, text] : picture.texts) writing.texts.push_back(as_chunk(key, text));
  const std::size_t row_bytes = picture.pixels.size() / picture.height;
  for (std::size_t y = 0; y < picture.height; ++y)
    writing.rows.push_back(reinterpret_cast<png_bytep>(&picture.pixels[y * row_bytes]));
  const bool is_written = write_all(writing, picture);
  if (writing.failure.out_of_memory) throw std::bad_alloc();
  if (!is_written)
    throw OutputError(name + ": cannot be written as PNG: " + writing.failure.reason);
  return std::move(writing.bytes);
}

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

void add_texts(Picture& picture, const DepthMap& map, const ImageChannel& channel,
               const std::string& name) {
  picture.texts = {{"Software", software_in_outputs()}, {channel_text, channel.name}};
  if (std::holds_alternative<Samples<std::uint32_t>>(channel.values))
    picture.texts.emplace_back(type_text, "identifier");
  else if (map.png_scale)
    picture.texts.emplace_back(scale_text, text::shortest_decimal(*map.png_scale));
  if (map.codes_beyond && std::holds_alternative<Samples<std::uint16_t>>(channel.values))
    picture.texts.emplace_back(beyond_text, std::to_string(*map.codes_beyond));
  for (const auto& [key, text] : name_tables(map)) picture.texts.emplace_back(key, text);
  for (const auto& [key, text] : texts_of(map)) {
    if (key == "Software" || key == "software" || key.starts_with("fathom:")) continue;
    if (key.empty() || key.size() > 79 || !is_plain(key) || key.find('\n') != std::string::npos)
      throw OutputError(name + ": PNG cannot hold a text of the name '" + key.substr(0, 80) +
                        "': expected 1 to 79 plain characters");
    if (text.find('\0') != std::string::npos)
      throw OutputError(name + ": PNG cannot hold the text '" + key + "', which has a zero byte");
    picture.texts.emplace_back(key, text);
  }
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
  Picture picture{map.width, map.height, 16, PNG_COLOR_TYPE_GRAY, {}, {}};
  picture.pixels.resize(2 * codes.size());
  for (std::size_t k = 0; k < codes.size(); ++k)
    store(&picture.pixels[2 * k], codes[k], std::endian::big);
  add_texts(picture, map, channel, name);
  return encode(picture, name);
}

}  // namespace fathom::image

namespace fathom {

std::vector<std::byte> encode_png(const RgbImage& image, const std::string& name) {
  if (image.width == 0 || image.height == 0 ||
      image.pixels.size() != std::size_t{image.width} * image.height) {
    throw InputError("picture: expected a colour for each of its pixels, and at least one");
  }
  image::Picture picture{image.width, image.height, 8, PNG_COLOR_TYPE_RGB, {}, {}};
  const auto bytes = std::as_bytes(std::span(image.pixels));
  picture.pixels.assign(bytes.begin(), bytes.end());
  picture.texts = {{"Software", text::software_in_outputs()}};
  return image::encode(picture, name);
}

void write_png(const RgbImage& image, const std::filesystem::path& path) {
  files::write_file(path, encode_png(image, path.string()));
}

std::vector<std::byte> encode_mask(std::span<const std::uint8_t> mask, std::uint32_t width,
                                   std::uint32_t height, const std::string& name) {
  if (width == 0 || height == 0 || std::max(width, height) > PNG_UINT_31_MAX ||
      mask.size() != std::size_t{width} * height) {
    throw InputError(
        "mask: expected a value for each of its pixels, at least one and fewer than 2^31 a side");
  }
  image::Picture picture{width, height, 8, PNG_COLOR_TYPE_GRAY, {}, {}};
  picture.pixels.resize(mask.size());
  std::ranges::transform(mask, picture.pixels.begin(), [](std::uint8_t shown) {
    return shown != 0 ? std::byte{255} : std::byte{0};
  });
  picture.texts = {{"Software", text::software_in_outputs()}};
  return image::encode(picture, name);
}

void write_mask(std::span<const std::uint8_t> mask, std::uint32_t width, std::uint32_t height,
                const std::filesystem::path& path) {
  files::write_file(path, encode_mask(mask, width, height, path.string()));
}

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
