#include "fathom/image/pictures/lettering.h"

#include <ft2build.h>
#include FT_FREETYPE_H

#include <new>

#include "fathom/numeric/errors.h"

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

/// Whether FreeType says that something failed. Fails with std::bad_alloc where that was for want of
/// memory: a picture would lack letters.
bool is_failure(FT_Error error) {
  if (FT_ERROR_BASE(error) == FT_Err_Out_Of_Memory) throw std::bad_alloc();
  return error != 0;
}

}  // namespace

struct Lettering::Font {
  FT_Library library = nullptr;
  FT_Face face = nullptr;

  Font() {
    if (is_failure(FT_Init_FreeType(&library))) throw OutputError("FreeType cannot be started");
    const FT_Error error = FT_New_Face(library, FATHOM_FONT, 0, &face);
    if (error != 0) {
      FT_Done_FreeType(library);
      (void)is_failure(error);
      throw OutputError(FATHOM_FONT
                        ": the font of pictures cannot be read: expected the package "
                        "fonts-dejavu-core to be installed");
    }
  }
  Font(const Font&) = delete;
  Font& operator=(const Font&) = delete;
  ~Font() {
    FT_Done_Face(face);
    FT_Done_FreeType(library);
  }
  /// Makes `character` the current glyph; false if the font has none.
  bool load(char32_t character, int size) const {
    (void)is_failure(FT_Set_Pixel_Sizes(face, 0, static_cast<FT_UInt>(size)));
    return !is_failure(FT_Load_Char(face, character, FT_LOAD_RENDER));
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
