#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/text/text_cursor.h"

/// Comma-separated values (CSV, RFC 4180).
namespace fathom::text {

/// A text in quotes, as a field of CSV.
std::string in_csv_quotes(std::string_view text);
/// The same for a name that comes from outside: what printable() makes of it.
std::string csv_name(const std::string& text);

/// Reads a CSV file line by line. Lines without a word are passed over. Fields have no blanks
/// around them, and no field contains a line break.
///
///   CsvReader csv(text, name);
///   while (csv.next_line()) use(csv.fields());
///
/// Fails    InputError "NAME: line N: …".
class CsvReader {
 public:
  /// `name` is the file's, for messages. The text and the name must outlive the reader.
  CsvReader(std::string_view text, const std::string& name)
      : cursor_(text, name, {}), name_(name) {}
  /// A part of a file, of whole lines: their ends, and the number of the first.
  CsvReader(std::string_view text, const std::string& name, char line_end, std::uint64_t first_line)
      : cursor_(text, name, {}, line_end, first_line), name_(name) {}

  /// Goes to the next line; false at the end of the file.
  bool next_line();
  /// Goes to the first line, which has the names of the columns.
  /// Fails    InputError "NAME: is empty".
  void go_to_heading();

  /// The number of the line, from 1.
  [[nodiscard]] std::uint64_t line() const { return cursor_.line(); }
  /// The fields of the line, in which quotes have no meaning.
  [[nodiscard]] std::vector<std::string_view> fields() const;
  /// The fields of the line without their quotes; "" within quotes is a quote.
  [[nodiscard]] std::vector<std::string> unquoted_fields() const;
  /// Fails unless a line has as many fields as its heading.
  void require_count(std::size_t fields, std::size_t headings) const;

  /// A finite decimal, rounded once to binary64.
  [[nodiscard]] double finite_number(std::string_view field) const;

  [[noreturn]] void fail(const std::string& message) const { cursor_.fail(message); }

 private:
  TextCursor cursor_;
  const std::string& name_;
  /// Whether next_line() has found a line.
  bool is_at_line_ = false;
};

/// The places of some columns among the headings, which are texts; empty if a column is missing.
template <class Headings>
std::vector<std::size_t> places_of(std::span<const std::string_view> columns,
                                   const Headings& headings) {
  std::vector<std::size_t> places;
  for (const std::string_view column : columns) {
    const auto found = std::ranges::find(headings, column);
    if (found == headings.end()) return {};
    places.push_back(static_cast<std::size_t>(found - headings.begin()));
  }
  return places;
}

}  // namespace fathom::text
