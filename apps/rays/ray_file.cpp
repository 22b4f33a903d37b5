#include "apps/rays/ray_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

#include "fathom/failures/errors.h"
#include "fathom/files/byte_order.h"
#include "fathom/files/input_file.h"
#include "fathom/image/files/npy_array.h"
#include "fathom/text/csv.h"
#include "fathom/text/printable.h"

namespace fathom::app {
namespace {

using NumberRow = std::array<double, 6>;
using ColumnNames = std::array<std::string_view, 6>;

/// Rows of a file whose columns have one of several sets of names.
struct NumberRows {
  /// The set of names, by number.
  std::size_t names = 0;
  /// In the order of the names.
  std::vector<NumberRow> rows;
};

/// What is wrong with a row of finite numbers; empty if nothing is.
using FaultOfRow = std::function<std::string(std::size_t names, const NumberRow& row)>;

/// The places of the columns among the headings; empty unless these are the only columns.
std::vector<std::size_t> places_of(const ColumnNames& names,
                                   const std::vector<std::string_view>& headings) {
  return headings.size() == names.size() ? text::places_of(names, headings)
                                         : std::vector<std::size_t>();
}

/// "a, b and c"
std::string listed(const ColumnNames& names) {
  std::string list(names.front());
  for (std::size_t i = 1; i < names.size(); ++i)
    list.append(i + 1 < names.size() ? ", " : " and ").append(names[i]);
  return list;
}

NumberRows rows_of_csv(std::string_view text, const std::string& name,
                       std::span<const ColumnNames> sets, const FaultOfRow& fault_of) {
  text::CsvReader csv(text, name);
  csv.go_to_heading();
  const std::vector<std::string_view> headings = csv.fields();
  NumberRows result;
  std::vector<std::size_t> places;
  std::string expected;
  for (std::size_t i = 0; i < sets.size() && places.empty(); ++i) {
    places = places_of(sets[i], headings);
    if (!places.empty()) result.names = i;
    expected += (i > 0 ? "; or " : "") + listed(sets[i]);
  }
  if (places.empty()) csv.fail("expected a heading with the columns " + expected);
  while (csv.next_line()) {
    const std::vector<std::string_view> fields = csv.fields();
    csv.require_count(fields.size(), headings.size());
    NumberRow in_file, row;
    for (std::size_t i = 0; i < fields.size(); ++i) in_file[i] = csv.finite_number(fields[i]);
    for (std::size_t k = 0; k < row.size(); ++k) row[k] = in_file[places[k]];
    if (const std::string fault = fault_of(result.names, row); !fault.empty()) csv.fail(fault);
    result.rows.push_back(row);
  }
  return result;
}

NumberRows rows_of_npy(files::ByteView bytes, const std::string& name, const FaultOfRow& fault_of) {
  image::ImageSize size;
  const std::vector<ImageChannel> channels = image::channels_of_npy(bytes, "rows", size, name);
  NumberRows result;
  const auto take = [&](const auto& values) {
    using Value = typename std::decay_t<decltype(values)>::value_type;
    if (!std::is_floating_point_v<Value> || channels.size() != 1 ||
        size.width != NumberRow{}.size())
      throw InputError(name + ": expected an array of shape N×6, of float64 or float32");
    for (std::size_t i = 0; i < size.height; ++i) {
      NumberRow& row = result.rows.emplace_back();
      for (std::size_t k = 0; k < row.size(); ++k) row[k] = values[i * row.size() + k];
      const bool is_finite = std::ranges::all_of(row, [](double x) { return std::isfinite(x); });
      const std::string fault = is_finite ? fault_of(0, row) : "expected finite numbers";
      if (!fault.empty()) throw InputError(name + ": row " + std::to_string(i) + ": " + fault);
    }
  };
  std::visit(take, channels.front().values);
  return result;
}

/// Reads the rows of a file. The columns of a CSV file have the names of a set, and the columns of
/// an NPY file have the order of the first set. `row` names a row in messages: "ray".
NumberRows read_rows(const std::string& file, const char* row, std::span<const ColumnNames> sets,
                     const FaultOfRow& fault_of) {
  const files::InputFile input(file);
  const std::string name = text::printable(file);
  const bool is_npy = input.text().starts_with("\x93NUMPY");
  NumberRows rows = is_npy ? rows_of_npy(input.bytes(), name, fault_of)
                           : rows_of_csv(input.text(), name, sets, fault_of);
  if (rows.rows.empty()) throw InputError(name + ": has a heading and no " + row);
  return rows;
}

constexpr std::array<ColumnNames, 1> ray_columns{{{"x", "y", "z", "dx", "dy", "dz"}}};
constexpr std::array<ColumnNames, 2> pair_columns{
    {{"x", "y", "z", "px", "py", "pz"}, {"x", "y", "z", "triangle", "v", "w"}}};
/// The number of the second set.
constexpr std::size_t on_surface = 1;

Ray ray_of(const NumberRow& n) {
  return {{n[0], n[1], n[2]}, {n[3], n[4], n[5]}};
}

std::string fault_of_ray(std::size_t, const NumberRow& row) {
  return ray_of(row).direction == std::array<double, 3>{} ? "the direction is 0" : "";
}

bool is_triangle_number(double x) {
  return x >= 0 && x < no_triangle && x == static_cast<double>(static_cast<std::uint32_t>(x));
}

std::string fault_of_pair(std::size_t names, const NumberRow& row) {
  if (names != on_surface || is_triangle_number(row[3])) return "";
  return "expected the number of a triangle";
}

}  // namespace

std::vector<Ray> read_rays(const std::string& file) {
  std::vector<Ray> rays;
  for (const NumberRow& row : read_rows(file, "ray", ray_columns, fault_of_ray).rows)
    rays.push_back(ray_of(row));
  return rays;
}

files::Bytes npy_of_rays(std::span<const Ray> rays) {
  constexpr std::size_t row = sizeof(double) * NumberRow{}.size();
  files::Bytes bytes = image::npy_header("<f8", std::to_string(rays.size()) + ", 6");
  std::size_t end = bytes.size();
  bytes.resize(end + rays.size() * row);
  for (const Ray& ray : rays)
    for (const auto& numbers : {ray.origin, ray.direction})
      for (const double x : numbers) {
        store(&bytes[end], x, std::endian::little);
        end += sizeof x;
      }
  return bytes;
}

SightPairs read_pairs(const std::string& file) {
  const NumberRows given = read_rows(file, "pair", pair_columns, fault_of_pair);
  SightPairs pairs;
  for (const NumberRow& row : given.rows) {
    pairs.eyes.emplace_back(std::array{row[0], row[1], row[2]});
    if (given.names == on_surface) {
      pairs.points.emplace_back(SurfacePoint{static_cast<std::uint32_t>(row[3]), row[4], row[5]});
    } else {
      pairs.points.emplace_back(std::array{row[3], row[4], row[5]});
    }
  }
  return pairs;
}

}  // namespace fathom::app
