#include "apps/rays/ray_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <variant>

#include "apps/rays/number_rows.h"
#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/image/files/npy_array.h"
#include "fathom/text/ascii.h"
#include "fathom/text/decimal.h"
#include "fathom/text/printable.h"
#include "fathom/text/text_cursor.h"

namespace fathom::app {
namespace {

/// By field of a line: which number it is; nullopt if the headings are not these names.
std::optional<std::vector<std::size_t>> order_of(const std::vector<std::string_view>& headings,
                                                 const ColumnNames& names) {
  std::vector<std::size_t> order;
  if (headings.size() != names.size()) return std::nullopt;
  for (const std::string_view heading : headings) {
    const auto* const found = std::ranges::find(names, heading);
    const auto place = static_cast<std::size_t>(found - names.begin());
    if (found == names.end() || std::ranges::find(order, place) != order.end()) return std::nullopt;
    order.push_back(place);
  }
  return order;
}

/// "a, b and c"
std::string listed(const ColumnNames& names) {
  std::string list(names.front());
  for (std::size_t i = 1; i < names.size(); ++i)
    list.append(i + 1 < names.size() ? ", " : " and ").append(names[i]);
  return list;
}

double finite_number(std::string_view field, const text::TextCursor& cursor) {
  const char* const end = field.data() + field.size();
  const auto [value, number_end, fault] = text::parse_decimal<double>(field.data(), end);
  if (fault != text::DecimalFault::none || number_end != end)
    cursor.fail("expected a finite number, found '" + text::printable(std::string(field)) + "'");
  return value;
}

NumberRows rows_of_csv(std::string_view text, const std::string& name,
                       std::span<const ColumnNames> sets, const FaultOfRow& fault_of) {
  text::TextCursor cursor(text, name, {});
  if (!cursor.next_line_with_words()) throw InputError(name + ": is empty");
  const std::vector<std::string_view> headings = text::comma_fields(cursor.rest_of_line());
  NumberRows result;
  std::optional<std::vector<std::size_t>> order;
  std::string expected;
  for (std::size_t i = 0; i < sets.size() && !order; ++i) {
    order = order_of(headings, sets[i]);
    if (order) result.names = i;
    expected += (i > 0 ? "; or " : "") + listed(sets[i]);
  }
  if (!order) cursor.fail("expected a heading with the columns " + expected);
  for (cursor.skip_line(); cursor.next_line_with_words(); cursor.skip_line()) {
    const std::vector<std::string_view> fields = text::comma_fields(cursor.rest_of_line());
    if (fields.size() != order->size())
      cursor.fail("expected 6 fields, found " + std::to_string(fields.size()));
    NumberRow& row = result.rows.emplace_back();
    for (std::size_t i = 0; i < fields.size(); ++i)
      row[(*order)[i]] = finite_number(fields[i], cursor);
    if (const std::string fault = fault_of(result.names, row); !fault.empty()) cursor.fail(fault);
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

}  // namespace

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

namespace {

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
