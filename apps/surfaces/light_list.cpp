#include "apps/surfaces/light_list.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

#include "fathom/camera/sun_position.h"
#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/text/csv.h"
#include "fathom/text/printable.h"

namespace fathom::app {
namespace {

/// Where the columns are.
struct Columns {
  /// Of x, y and z; or of azimuth and elevation.
  std::vector<std::size_t> numbers;
  std::vector<std::size_t> others;
};

using Headings = std::vector<std::string>;

void expect_distinct(const Headings& headings, const text::CsvReader& csv) {
  std::set<std::string> names;
  for (const std::string& heading : headings) {
    const std::string name = text::printable(heading);
    if (!names.insert(name).second) csv.fail("the column '" + name + "' is there twice");
  }
}

Columns columns_of(const Headings& headings, LightList::Kind kind, const text::CsvReader& csv) {
  expect_distinct(headings, csv);
  const bool takes_angles = kind == LightList::Kind::directions;
  constexpr std::array<std::string_view, 3> of_vector{"x", "y", "z"};
  constexpr std::array<std::string_view, 2> of_angles{"azimuth", "elevation"};
  const std::vector<std::size_t> vector = text::places_of(of_vector, headings);
  const std::vector<std::size_t> angles =
      takes_angles ? text::places_of(of_angles, headings) : std::vector<std::size_t>();
  if (vector.empty() && angles.empty()) {
    csv.fail(takes_angles
                 ? "expected a heading with the columns x, y and z, or azimuth and elevation"
                 : "expected a heading with the columns x, y and z");
  }
  Columns columns{vector.empty() ? angles : vector, {}};
  for (std::size_t k = 0; k < headings.size(); ++k) {
    const bool is_of_vector = std::ranges::find(vector, k) != vector.end();
    if (!is_of_vector) columns.others.push_back(k);
  }
  return columns;
}

std::array<double, 3> direction_of(double azimuth, double elevation, const text::CsvReader& csv) {
  if (!(std::abs(azimuth) <= 360)) {
    csv.fail("the azimuth must be between -360 and 360 degrees");
  }
  try {
    return compass_direction(azimuth, elevation);
  } catch (const UsageError& error) {
    csv.fail(error.what());
  }
}

LightList::Light light_of(const std::vector<std::string>& fields, const Columns& columns,
                          LightList::Kind kind, const text::CsvReader& csv) {
  LightList::Light light;
  light.line = csv.line();
  std::vector<double> numbers;
  for (const std::size_t k : columns.numbers) numbers.push_back(csv.finite_number(fields[k]));
  light.numbers = numbers.size() == 2 ? direction_of(numbers[0], numbers[1], csv)
                                      : std::array{numbers[0], numbers[1], numbers[2]};
  const bool is_zero = light.numbers == std::array{0.0, 0.0, 0.0};
  if (is_zero && kind == LightList::Kind::directions) csv.fail("the direction is 0");
  for (const std::size_t k : columns.others) light.fields.push_back(fields[k]);
  return light;
}

}  // namespace

LightList read_lights(const std::string& file, LightList::Kind kind) {
  const files::InputFile input(file);
  LightList list;
  list.file = text::printable(file);
  text::CsvReader csv(input.text(), list.file);
  csv.go_to_heading();
  const Headings headings = csv.unquoted_fields();
  const Columns columns = columns_of(headings, kind, csv);
  for (const std::size_t k : columns.others) list.headings.push_back(headings[k]);
  while (csv.next_line()) {
    const std::vector<std::string> fields = csv.unquoted_fields();
    csv.require_count(fields.size(), headings.size());
    list.lights.push_back(light_of(fields, columns, kind, csv));
  }
  if (list.lights.empty()) throw InputError(list.file + ": has a heading and no line");
  return list;
}

}  // namespace fathom::app
