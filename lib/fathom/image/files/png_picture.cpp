#include "fathom/image/files/png_picture.h"

#include <algorithm>
#include <csetjmp>
#include <new>

#include "fathom/failures/errors.h"
#include "fathom/image/files/file_texts.h"
#include "fathom/image/png_files.h"
#include "fathom/image/png_stream.h"
#include "fathom/image/rgb_image.h"
#include "fathom/text/version.h"

namespace fathom::image {
using namespace files;

namespace {

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

int colour_type_of(PngColour colour) {
  return colour == PngColour::grey ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB;
}

bool write_all(Writing& writing, const PngPicture& picture) {
  if (setjmp(png_jmpbuf(writing.png))) return false;
  png_set_write_fn(writing.png, &writing, append_bytes, flush_nothing);
  png_set_user_limits(writing.png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  png_set_IHDR(writing.png, writing.info, picture.width, picture.height, picture.bit_depth,
               colour_type_of(picture.colour), PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
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

}  // namespace

Bytes encode(PngPicture& picture, const std::string& name) {
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

PngPicture picture_of_mask(std::span<const std::uint8_t> mask, std::uint32_t width,
                           std::uint32_t height) {
  if (width == 0 || height == 0 || std::max(width, height) > PNG_UINT_31_MAX ||
      mask.size() != std::size_t{width} * height) {
    throw InputError(
        "mask: expected a value for each of its pixels, at least one and fewer than 2^31 a side");
  }
  PngPicture picture{width, height, 8, PngColour::grey, {}, {}};
  picture.pixels.resize(mask.size());
  std::ranges::transform(mask, picture.pixels.begin(), [](std::uint8_t shown) {
    return shown != 0 ? std::byte{255} : std::byte{0};
  });
  picture.texts = {{"Software", text::software_in_outputs()}};
  return picture;
}

void add_texts_of_map(PngPicture& picture, const DepthMap& map, const std::string& name) {
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

}  // namespace fathom::image

namespace fathom {

std::vector<std::byte> encode_png(const RgbImage& image, const std::string& name) {
  if (image.width == 0 || image.height == 0 ||
      image.pixels.size() != std::size_t{image.width} * image.height) {
    throw InputError("picture: expected a colour for each of its pixels, and at least one");
  }
  image::PngPicture picture{image.width, image.height, 8, image::PngColour::rgb, {}, {}};
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
  image::PngPicture picture = image::picture_of_mask(mask, width, height);
  return image::encode(picture, name);
}

void write_mask(std::span<const std::uint8_t> mask, std::uint32_t width, std::uint32_t height,
                const std::filesystem::path& path) {
  files::write_file(path, encode_mask(mask, width, height, path.string()));
}

}  // namespace fathom
