#include "fathom/text/csv.h"

#include "fathom/failures/errors.h"
#include "fathom/text/ascii.h"
#include "fathom/text/counted.h"
#include "fathom/text/decimal.h"
#include "fathom/text/printable.h"

namespace fathom::text {

std::string in_csv_quotes(std::string_view text) {
  std::string field = "\"";
  for (const char c : text) {
    if (c == '"') field += '"';
    field += c;
  }
  return field + "\"";
}

std::string csv_name(const std::string& text) {
  return in_csv_quotes(printable(text));
}

bool CsvReader::next_line() {
  if (is_at_line_) cursor_.skip_line();
  is_at_line_ = cursor_.next_line_with_words();
  return is_at_line_;
}

void CsvReader::go_to_heading() {
  if (!next_line()) throw InputError(name_ + ": is empty");
}

std::vector<std::string_view> CsvReader::fields() const {
  std::string_view line = cursor_.rest_of_line();
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t comma = line.find(',');
    fields.push_back(trimmed(line.substr(0, comma)));
    if (comma == line.npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

std::vector<std::string> CsvReader::unquoted_fields() const {
  std::vector<std::string> fields;
  std::string_view line = trimmed(cursor_.rest_of_line());  // a carriage return may follow a quote
  while (true) {
    std::string& field = fields.emplace_back();
    const std::size_t start = line.find_first_not_of(" \t");
    if (start == line.npos || line[start] != '"') {
      const std::size_t comma = line.find(',');
      field = trimmed(line.substr(0, comma));
      if (comma == line.npos) return fields;
      line.remove_prefix(comma + 1);
      continue;
    }
    line.remove_prefix(start + 1);
    for (std::size_t quote = line.find('"');; quote = line.find('"')) {
      if (quote == line.npos) fail("a quote is not closed");
      field += line.substr(0, quote);
      line.remove_prefix(quote + 1);
      if (!line.starts_with('"')) break;
      field += '"';
      line.remove_prefix(1);
    }
    const std::size_t comma = line.find_first_not_of(" \t");
    if (comma == line.npos) return fields;
    if (line[comma] != ',') fail("expected a comma behind a quote");
    line.remove_prefix(comma + 1);
  }
}

void CsvReader::require_count(std::size_t fields, std::size_t headings) const {
  if (fields == headings) return;
  fail("expected " + counted(headings, "field") + ", found " + std::to_string(fields));
}

double CsvReader::finite_number(std::string_view field) const {
  const char* const end = field.data() + field.size();
  const DecimalResult<double> result = parse_decimal<double>(field.data(), end);
  if (result.fault != DecimalFault::none || result.end != end)
    fail("expected a finite number, found '" + printable(std::string(field)) + "'");
  return result.value;
}

}  // namespace fathom::text
