#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace fathom::text {

/// The character at the start of a text: its code and how many bytes it takes.
struct Utf8Character {
  /// The code of a byte that begins no character of UTF-8.
  static constexpr char32_t none = 0xFFFFFFFF;

  char32_t code;
  std::size_t size;
};

/// Of a text that is not empty.
Utf8Character first_character(std::string_view text);

/// A text as UTF-8: itself, or, where it is not, each of its bytes as the character that it is in
/// ISO 8859-1. Texts that differ and are not UTF-8 stay different.
std::string as_utf8(std::string_view text);

}  // namespace fathom::text
