#include "apps/surfaces/light_list.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

#include "fathom/camera/sun_position.h"
#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/text/ascii.h"
#include "fathom/text/counted.h"
#include "fathom/text/decimal.h"
#include "fathom/text/printable.h"
#include "fathom/text/text_cursor.h"

namespace fathom::app {
namespace {

/// The fields of a line of CSV (RFC 4180); quotes are taken off, and "" in quotes is one.
std::vector<std::string> fields_of(std::string_view line, const text::TextCursor& cursor) {
  std::vector<std::string> fields;
  line = text::trimmed(line);  // a carriage return may follow a quote
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
  /// Of x, y and z; or of azimuth and elevation.
  std::vector<std::size_t> numbers;
  std::vector<std::size_t> others;
  std::size_t count = 0;
};

using Headings = std::vector<std::string>;

void expect_distinct(const Headings& headings, const text::TextCursor& cursor) {
  std::set<std::string> names;
  for (const std::string& heading : headings) {
    const std::string name = text::printable(heading);
    if (!names.insert(name).second) cursor.fail("the column '" + name + "' is there twice");
  }
}

/// The places of some columns; none if a column is missing.
std::vector<std::size_t> places_of(const Headings& wanted, const Headings& headings) {
  std::vector<std::size_t> places;
  for (const std::string& name : wanted) {
    const auto found = std::ranges::find(headings, name);
    if (found == headings.end()) return {};
    places.push_back(static_cast<std::size_t>(found - headings.begin()));
  }
  return places;
}

Columns columns_of(const Headings& headings, LightList::Kind kind, const text::TextCursor& cursor) {
  expect_distinct(headings, cursor);
  const bool takes_angles = kind == LightList::Kind::directions;
  const std::vector<std::size_t> vector = places_of({"x", "y", "z"}, headings);
  const std::vector<std::size_t> angles =
      takes_angles ? places_of({"azimuth", "elevation"}, headings) : std::vector<std::size_t>();
  if (vector.empty() && angles.empty()) {
    cursor.fail(takes_angles
                    ? "expected a heading with the columns x, y and z, or azimuth and elevation"
                    : "expected a heading with the columns x, y and z");
  }
  Columns columns{vector.empty() ? angles : vector, {}, headings.size()};
  for (std::size_t k = 0; k < headings.size(); ++k) {
    const bool is_of_vector = std::ranges::find(vector, k) != vector.end();
    if (!is_of_vector) columns.others.push_back(k);
  }
  return columns;
}

std::array<double, 3> direction_of(double azimuth, double elevation,
                                   const text::TextCursor& cursor) {
  if (!(std::abs(azimuth) <= 360)) {
    cursor.fail("the azimuth must be between -360 and 360 degrees");
  }
  try {
    return compass_direction(azimuth, elevation);
  } catch (const UsageError& error) {
    cursor.fail(error.what());
  }
}

LightList::Light light_of(const std::vector<std::string>& fields, const Columns& columns,
                          LightList::Kind kind, const text::TextCursor& cursor) {
  LightList::Light light;
  light.line = cursor.line();
  std::vector<double> numbers;
  for (const std::size_t k : columns.numbers) numbers.push_back(number_of(fields[k], cursor));
  light.numbers = numbers.size() == 2 ? direction_of(numbers[0], numbers[1], cursor)
                                      : std::array{numbers[0], numbers[1], numbers[2]};
  const bool is_zero = light.numbers == std::array{0.0, 0.0, 0.0};
  if (is_zero && kind == LightList::Kind::directions) cursor.fail("the direction is 0");
  for (const std::size_t k : columns.others) light.fields.push_back(fields[k]);
  return light;
}

}  // namespace

LightList read_lights(const std::string& file, LightList::Kind kind) {
  const files::InputFile input(file);
  LightList list;
  list.file = text::printable(file);
  text::TextCursor cursor(input.text(), list.file, {});
  if (!cursor.next_line_with_words()) throw InputError(list.file + ": is empty");
  const Headings headings = fields_of(cursor.rest_of_line(), cursor);
  const Columns columns = columns_of(headings, kind, cursor);
  for (const std::size_t k : columns.others) list.headings.push_back(headings[k]);
  for (cursor.skip_line(); cursor.next_line_with_words(); cursor.skip_line()) {
    const std::vector<std::string> fields = fields_of(cursor.rest_of_line(), cursor);
    if (fields.size() != columns.count) {
      cursor.fail("expected " + text::counted(columns.count, "field") + ", found " +
                  std::to_string(fields.size()));
    }
    list.lights.push_back(light_of(fields, columns, kind, cursor));
  }
  if (list.lights.empty()) throw InputError(list.file + ": has a heading and no line");
  return list;
}

}  // namespace fathom::app
