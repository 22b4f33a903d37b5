#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace fathom::text {

/// A to Z as a to z, whatever the locale of the process; other bytes as they are.
constexpr char small_letter(char c) {
  return 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}
inline std::string in_small_letters(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = small_letter(c);
  return result;
}

/// Fields and lines without the blanks around them.

/// The text without spaces, tabs and carriage returns before and behind it.
inline std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// What stands between the commas of a line, without blanks around it. Quotes have no meaning.
inline std::vector<std::string_view> comma_fields(std::string_view line) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t comma = line.find(',');
    fields.push_back(trimmed(line.substr(0, comma)));
    if (comma == line.npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

/// A text in quotes, as a field of CSV (RFC 4180).
inline std::string in_csv_quotes(std::string_view text) {
  std::string field = "\"";
  for (const char c : text) {
    if (c == '"') field += '"';
    field += c;
  }
  return field + "\"";
}

}  // namespace fathom::text
