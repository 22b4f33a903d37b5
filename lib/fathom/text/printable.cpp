#include "fathom/text/printable.h"

#include <array>
#include <cstddef>
#include <cstdio>

namespace fathom::text {
namespace {

/// The character at the start of a text: its code and how many bytes it takes. A byte that begins
/// no character of UTF-8 has the code `none`.
struct Character {
  char32_t code;
  std::size_t size;
};

constexpr char32_t none = 0xFFFFFFFF;
constexpr std::string_view replacement = "\xEF\xBF\xBD";  // U+FFFD

/// How many bytes a character takes that begins with this one; 0 where none does.
std::size_t length_after(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return 2;
  if (first >= 0xE0 && first <= 0xEF) return 3;
  return first >= 0xF0 && first <= 0xF4 ? 4 : 0;
}

Character first_of(std::string_view text) {
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
  return code < least[size] || is_surrogate || code > 0x10FFFF ? Character{none, 1}
                                                               : Character{code, size};
}

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
    const Character character = first_of(text);
    put(result, character.code, text.substr(0, character.size));
    text.remove_prefix(character.size);
  }
  return result;
}

void put_printable(std::string& to, char32_t code, std::string_view bytes) {
  if (code == none) {
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
    if (code == none || code < 0x20 || !has_effects(code)) {
      to += bytes;
      return;
    }
    std::array<char, 16> escape{};
    std::snprintf(escape.data(), escape.size(), "\\u%04x", static_cast<unsigned>(code));
    to += escape.data();
  });
}

}  // namespace fathom::text
