#include "fathom/text/printable.h"

#include <array>
#include <cstddef>
#include <cstdio>

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

namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD";  // U+FFFD

bool is_between(char32_t code, char32_t first, char32_t last) {
  return first <= code && code <= last;
}

bool has_effects(char32_t code) {
  return code < 0x20 || is_between(code, 0x7F, 0x9F) || code == 0x061C ||
         is_between(code, 0x200E, 0x200F) || is_between(code, 0x2028, 0x202E) ||
         is_between(code, 0x2066, 0x2069);
}

/// The text with every character put in by put(text, character, bytes).
template <class Put>
std::string rewritten(std::string_view text, const Put& put) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const Utf8Character character = first_character(text);
    put(result, character.code, text.substr(0, character.size));
    text.remove_prefix(character.size);
  }
  return result;
}

void put_printable(std::string& to, char32_t code, std::string_view bytes) {
  if (code == Utf8Character::none) {
    to += replacement;
  } else if (has_effects(code)) {
    to += '?';
  } else {
    to += bytes;
  }
}

}  // namespace

std::string printable(std::string_view text) {
  return rewritten(text, put_printable);
}

std::string printable_lines(std::string_view text) {
  return rewritten(text, [](std::string& to, char32_t code, std::string_view bytes) {
    if (code == '\n' || code == '\t') {
      to += bytes;
    } else {
      put_printable(to, code, bytes);
    }
  });
}

std::string escaped_json(std::string_view json) {
  return rewritten(json, [](std::string& to, char32_t code, std::string_view bytes) {
    // Below U+0020 nothing is left but the blanks between values.
    if (code == Utf8Character::none || code < 0x20 || !has_effects(code)) {
      to += bytes;
      return;
    }
    std::array<char, 16> escape{};
    std::snprintf(escape.data(), escape.size(), "\\u%04x", static_cast<unsigned>(code));
    to += escape.data();
  });
}

}  // namespace fathom::text
