#pragma once

#include <string_view>

/// Fields and lines without the blanks around them.
namespace fathom::text {

/// The text without spaces, tabs and carriage returns before and behind it.
inline std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

}  // namespace fathom::text
