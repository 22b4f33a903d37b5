#pragma once

#include <string>
#include <string_view>

/// Letters and blanks of ASCII, independent of the locale.
namespace fathom::text {

/// A to Z as a to z; other bytes unchanged.
constexpr char small_letter(char c) {
  return 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}
inline std::string in_small_letters(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = small_letter(c);
  return result;
}

/// The text without spaces, tabs and carriage returns before and behind it.
inline std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

}  // namespace fathom::text
