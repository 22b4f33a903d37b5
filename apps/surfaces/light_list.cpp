#include "apps/surfaces/light_list.h"

#include <algorithm>

#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/text/counted.h"
#include "fathom/text/decimal.h"
#include "fathom/text/printable.h"
#include "fathom/text/text_cursor.h"
#include "fathom/text/trimmed.h"

namespace fathom::app {
namespace {

/// The fields of a line of CSV (RFC 4180); quotes are taken off, and "" in quotes is one.
std::vector<std::string> fields_of(std::string_view line, const text::TextCursor& cursor) {
  std::vector<std::string> fields;
  while (true) {
    std::string& field = fields.emplace_back();
    const std::size_t start = line.find_first_not_of(" \t");
    if (start == line.npos || line[start] != '"') {
      const std::size_t comma = line.find(',');
      field = text::trimmed(line.substr(0, comma));
      if (comma == line.npos) return fields;
      line.remove_prefix(comma + 1);
      continue;
    }
    line.remove_prefix(start + 1);
    for (std::size_t quote = line.find('"');; quote = line.find('"')) {
      if (quote == line.npos) cursor.fail("a quote is not closed");
      field += line.substr(0, quote);
      line.remove_prefix(quote + 1);
      if (!line.starts_with('"')) break;
      field += '"';
      line.remove_prefix(1);
    }
    const std::size_t comma = line.find_first_not_of(" \t");
    if (comma == line.npos) return fields;
    if (line[comma] != ',') cursor.fail("expected a comma behind a quote");
    line.remove_prefix(comma + 1);
  }
}

double number_of(const std::string& field, const text::TextCursor& cursor) {
  const char* const end = field.data() + field.size();
  const auto result = text::parse_decimal<double>(field.data(), end);
  if (result.fault != text::DecimalFault::none || result.end != end) {
    cursor.fail("expected a finite number, found '" + text::printable(field) + "'");
  }
  return result.value;
}

/// Where the columns are.
struct Columns {
  std::array<std::size_t, 3> numbers{};
  std::vector<std::size_t> others;
  std::size_t count = 0;
};

Columns columns_of(const std::vector<std::string>& headings, const text::TextCursor& cursor) {
  Columns columns;
  columns.count = headings.size();
  std::array<int, 3> found{};
  for (std::size_t k = 0; k < headings.size(); ++k) {
    const std::size_t axis = headings[k] == "x" ? 0 : headings[k] == "y" ? 1 : 2;
    if (axis < 2 || headings[k] == "z") {
      columns.numbers[axis] = k;
      ++found[axis];
    } else {
      columns.others.push_back(k);
    }
  }
  if (found != std::array{1, 1, 1}) {
    cursor.fail("expected a heading with one column x, one y and one z");
  }
  return columns;
}

}  // namespace

LightList read_lights(const std::string& file) {
  const files::InputFile input(file);
  const std::string name = text::printable(file);
  text::TextCursor cursor(input.text(), name, {});
  LightList list;
  if (!cursor.next_line_with_words()) throw InputError(name + ": is empty");
  const std::vector<std::string> headings = fields_of(cursor.rest_of_line(), cursor);
  const Columns columns = columns_of(headings, cursor);
  for (const std::size_t k : columns.others) list.headings.push_back(headings[k]);
  for (cursor.skip_line(); cursor.next_line_with_words(); cursor.skip_line()) {
    const std::vector<std::string> fields = fields_of(cursor.rest_of_line(), cursor);
    if (fields.size() != columns.count) {
      cursor.fail("expected " + text::counted(columns.count, "field") + ", found " +
                  std::to_string(fields.size()));
    }
    LightList::Light& light = list.lights.emplace_back();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      light.numbers[axis] = number_of(fields[columns.numbers[axis]], cursor);
    }
    for (const std::size_t k : columns.others) light.fields.push_back(fields[k]);
  }
  if (list.lights.empty()) throw InputError(name + ": has a heading and no line");
  return list;
}

}  // namespace fathom::app
