#include "apps/rays/ray_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <type_traits>
#include <variant>

#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/image/files/npy_array.h"
#include "fathom/text/comma_fields.h"
#include "fathom/text/counted.h"
#include "fathom/text/decimal.h"
#include "fathom/text/printable.h"
#include "fathom/text/text_cursor.h"

namespace fathom::app {
namespace {

constexpr std::array<std::string_view, 6> column_names{"x", "y", "z", "dx", "dy", "dz"};
using Numbers = std::array<double, column_names.size()>;

Ray ray_of(const Numbers& n) {
  return {{n[0], n[1], n[2]}, {n[3], n[4], n[5]}};
}

bool has_direction(const Ray& ray) {
  return ray.direction != std::array<double, 3>{};
}

/// By field of a line: which number it is.
std::vector<std::size_t> order_of(const std::vector<std::string_view>& headings,
                                  const text::TextCursor& cursor) {
  std::vector<std::size_t> order;
  for (const std::string_view heading : headings) {
    const auto* const found = std::ranges::find(column_names, heading);
    const auto place = static_cast<std::size_t>(found - column_names.begin());
    if (found == column_names.end() || std::ranges::find(order, place) != order.end()) break;
    order.push_back(place);
  }
  if (order.size() != column_names.size() || headings.size() != column_names.size())
    cursor.fail("expected a heading with the columns x, y, z, dx, dy and dz");
  return order;
}

double finite_number(std::string_view field, const text::TextCursor& cursor) {
  const char* const end = field.data() + field.size();
  const auto [value, number_end, fault] = text::parse_decimal<double>(field.data(), end);
  if (fault != text::DecimalFault::none || number_end != end)
    cursor.fail("expected a finite number, found '" + text::printable(std::string(field)) + "'");
  return value;
}

std::vector<Ray> rays_of_csv(std::string_view text, const std::string& name) {
  text::TextCursor cursor(text, name, {});
  if (!cursor.next_line_with_words()) throw InputError(name + ": is empty");
  const std::vector<std::size_t> order =
      order_of(text::comma_fields(cursor.rest_of_line()), cursor);
  std::vector<Ray> rays;
  for (cursor.skip_line(); cursor.next_line_with_words(); cursor.skip_line()) {
    const std::vector<std::string_view> fields = text::comma_fields(cursor.rest_of_line());
    if (fields.size() != order.size())
      cursor.fail("expected 6 fields, found " + std::to_string(fields.size()));
    Numbers numbers{};
    for (std::size_t i = 0; i < order.size(); ++i)
      numbers[order[i]] = finite_number(fields[i], cursor);
    rays.push_back(ray_of(numbers));
    if (!has_direction(rays.back())) cursor.fail("the direction is 0");
  }
  return rays;
}

std::vector<Ray> rays_of_npy(files::ByteView bytes, const std::string& name) {
  image::ImageSize size;
  const std::vector<ImageChannel> channels = image::channels_of_npy(bytes, "rays", size, name);
  std::vector<Ray> rays;
  const auto take = [&](const auto& values) {
    using Value = typename std::decay_t<decltype(values)>::value_type;
    if (!std::is_floating_point_v<Value> || channels.size() != 1 ||
        size.width != column_names.size())
      throw InputError(name + ": expected an array of shape N×6, of float64 or float32");
    for (std::size_t row = 0; row < size.height; ++row) {
      Numbers numbers{};
      for (std::size_t k = 0; k < numbers.size(); ++k)
        numbers[k] = values[row * numbers.size() + k];
      const auto fail = [&](const char* fault) {
        throw InputError(name + ": row " + std::to_string(row) + ": " + fault);
      };
      if (!std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); }))
        fail("expected finite numbers");
      rays.push_back(ray_of(numbers));
      if (!has_direction(rays.back())) fail("the direction is 0");
    }
  };
  std::visit(take, channels.front().values);
  return rays;
}

}  // namespace

std::vector<Ray> read_rays(const std::string& file) {
  const files::InputFile input(file);
  const std::string name = text::printable(file);
  const bool is_npy = input.text().starts_with("\x93NUMPY");
  std::vector<Ray> rays =
      is_npy ? rays_of_npy(input.bytes(), name) : rays_of_csv(input.text(), name);
  if (rays.empty()) throw InputError(name + ": has a heading and no ray");
  return rays;
}

}  // namespace fathom::app
