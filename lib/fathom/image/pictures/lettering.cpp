#include "fathom/image/pictures/lettering.h"

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_MODULE_H

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <new>

#include "fathom/failures/errors.h"

namespace fathom::image {
namespace {

/// The characters of UTF-8 text; a byte that is not UTF-8 becomes U+FFFD.
std::u32string characters_of(const std::string& text) {
  std::u32string characters;
  for (std::size_t k = 0; k < text.size();) {
    const auto first = static_cast<unsigned char>(text[k]);
    const std::size_t length = first < 0x80       ? 1
                               : first >> 5 == 6  ? 2
                               : first >> 4 == 14 ? 3
                               : first >> 3 == 30 ? 4
                                                  : 0;
    bool valid = length > 0 && k + length <= text.size();
    char32_t character = length <= 1 ? first : first & (0x7Fu >> length);
    for (std::size_t n = 1; valid && n < length; ++n) {
      const auto next = static_cast<unsigned char>(text[k + n]);
      valid = next >> 6 == 2;
      character = character << 6 | (next & 0x3Fu);
    }
    characters += valid ? character : U'\uFFFD';
    k += valid ? length : 1;
  }
  return characters;
}

std::uint8_t blend(std::uint8_t below, std::uint8_t ink, unsigned cover) {
  return static_cast<std::uint8_t>((below * (255 - cover) + ink * cover + 127) / 255);
}

void stamp(RgbImage& image, const FT_Bitmap& glyph, int left, int top, Rgb colour) {
  for (unsigned row = 0; row < glyph.rows; ++row)
    for (unsigned column = 0; column < glyph.width; ++column) {
      const int x = left + static_cast<int>(column), y = top + static_cast<int>(row);
      if (x < 0 || y < 0 || x >= static_cast<int>(image.width) ||
          y >= static_cast<int>(image.height))
        continue;
      const unsigned cover = glyph.buffer[row * static_cast<unsigned>(glyph.pitch) + column];
      Rgb& pixel = image.at(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
      for (std::size_t c = 0; c < 3; ++c) pixel[c] = blend(pixel[c], colour[c], cover);
    }
}

/// Allocates FreeType's memory with operator new, and records failures: without memory FreeType
/// continues without modules or hinting, or crashes. (If a program's operator new ends the program
/// on failure, it ends here.)
struct FontMemory {
  FT_MemoryRec_ functions{.user = this, .alloc = allocate, .free = release, .realloc = reallocate};
  bool exhausted = false;

  FontMemory() = default;
  FontMemory(const FontMemory&) = delete;
  FontMemory& operator=(const FontMemory&) = delete;

 private:
  static void* allocate(FT_Memory memory, long size) noexcept {
    try {
      return ::operator new(static_cast<std::size_t>(size));
    } catch (const std::bad_alloc&) {
      static_cast<FontMemory*>(memory->user)->exhausted = true;
      return nullptr;
    }
  }
  static void release(FT_Memory /*memory*/, void* block) noexcept { ::operator delete(block); }
  static void* reallocate(FT_Memory memory, long size, long new_size, void* block) noexcept {
    void* const larger = allocate(memory, new_size);
    if (larger == nullptr) return nullptr;
    if (block != nullptr) {
      std::memcpy(larger, block, static_cast<std::size_t>(std::min(size, new_size)));
    }
    release(memory, block);
    return larger;
  }
};

/// The environment variable FATHOM_FONT replaces the font that was found when Fathom was built.
std::string font_file() {
  const char* const replacement = std::getenv("FATHOM_FONT");
  return replacement == nullptr ? FATHOM_FONT : replacement;
}

}  // namespace

struct Lettering::Font {
  FontMemory memory;
  FT_Library library = nullptr;
  FT_Face face = nullptr;

  Font() {
    const bool starts = !is_failure(FT_New_Library(&memory.functions, &library));
    if (starts) {
      FT_Add_Default_Modules(library);
      FT_Set_Default_Properties(library);
    }
    const std::string font = font_file();
    const bool has_face = starts && !is_failure(FT_New_Face(library, font.c_str(), 0, &face));
    if (has_face && !memory.exhausted) return;
    close();
    if (memory.exhausted) throw std::bad_alloc();
    throw OutputError(starts ? font +
                                   ": the font of pictures cannot be read: expected the package "
                                   "fonts-dejavu-core to be installed"
                             : "FreeType cannot be started");
  }
  Font(const Font&) = delete;
  Font& operator=(const Font&) = delete;
  ~Font() { close(); }

  /// Makes `character` the current glyph; false if the font has none. Fails with std::bad_alloc: a
  /// picture would lack letters.
  bool load(char32_t character, int size) {
    const bool sized = !is_failure(FT_Set_Pixel_Sizes(face, 0, static_cast<FT_UInt>(size)));
    const bool loaded = sized && !is_failure(FT_Load_Char(face, character, FT_LOAD_RENDER));
    if (memory.exhausted) throw std::bad_alloc();
    return loaded;
  }

 private:
  bool is_failure(FT_Error error) {
    // FreeType is out of memory, too, where a table would be too large.
    memory.exhausted = memory.exhausted || FT_ERROR_BASE(error) == FT_Err_Out_Of_Memory;
    return error != 0;
  }
  void close() {
    FT_Done_Face(face);
    if (library != nullptr) FT_Done_Library(library);
  }
};

Lettering::Lettering() : font_(std::make_unique<Font>()) {}
Lettering::~Lettering() = default;
Lettering::Lettering(Lettering&&) noexcept = default;

int Lettering::width(const std::string& text, int size) const {
  long width = 0;  // in 64ths of a pixel
  for (const char32_t character : characters_of(text))
    if (font_->load(character, size)) width += font_->face->glyph->advance.x;
  return static_cast<int>((width + 63) / 64);
}

void Lettering::draw(RgbImage& image, int x, int y, const std::string& text, int size,
                     Rgb colour) const {
  long pen = long{x} * 64;
  for (const char32_t character : characters_of(text)) {
    if (!font_->load(character, size)) continue;
    const FT_GlyphSlot glyph = font_->face->glyph;
    stamp(image, glyph->bitmap, static_cast<int>(pen / 64) + glyph->bitmap_left,
          y - glyph->bitmap_top, colour);
    pen += glyph->advance.x;
  }
}

}  // namespace fathom::image
