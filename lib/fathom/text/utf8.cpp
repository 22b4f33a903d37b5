#include "fathom/text/utf8.h"

#include <array>

namespace fathom::text {
namespace {

constexpr char32_t none = Utf8Character::none;

/// How many bytes a character takes that begins with this one; 0 where none does.
std::size_t length_after(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return 2;
  if (first >= 0xE0 && first <= 0xEF) return 3;
  return first >= 0xF0 && first <= 0xF4 ? 4 : 0;
}

}  // namespace

Utf8Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::size_t size = length_after(byte(0));
  if (size == 1) return {byte(0), 1};
  if (size == 0 || size > text.size()) return {none, 1};
  char32_t code = byte(0) & (0x7FU >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xC0U) != 0x80) return {none, 1};
    code = code << 6U | (byte(i) & 0x3FU);
  }
  // Longer than need be, a surrogate, or beyond Unicode.
  constexpr std::array<char32_t, 5> least{0, 0, 0x80, 0x800, 0x10000};
  const bool is_surrogate = code >= 0xD800 && code <= 0xDFFF;
  return code < least[size] || is_surrogate || code > 0x10FFFF ? Utf8Character{none, 1}
                                                               : Utf8Character{code, size};
}

std::string as_utf8(std::string_view text) {
  bool is_utf8 = true;
  for (std::string_view rest = text; is_utf8 && !rest.empty();) {
    const Utf8Character character = first_character(rest);
    is_utf8 = character.code != none;
    rest.remove_prefix(character.size);
  }
  if (is_utf8) return std::string(text);
  std::string result;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x80) {
      result += c;
    } else {
      result += static_cast<char>(0xC0U | code >> 6U);
      result += static_cast<char>(0x80U | (code & 0x3FU));
    }
  }
  return result;
}

}  // namespace fathom::text
