#include "fathom/text/printable.h"

#include <array>
#include <cstddef>
#include <cstdio>

#include "fathom/text/utf8.h"

namespace fathom::text {
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
