#include "fathom/image/files/direction_csv.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "fathom/failures/errors.h"
#include "fathom/text/comma_fields.h"
#include "fathom/text/counted.h"
#include "fathom/text/decimal.h"
#include "fathom/text/printable.h"
#include "fathom/text/text_cursor.h"

namespace fathom::image {
using namespace text;

namespace {

bool is_nan(std::string_view field) {
  return field == "nan" || field == "NaN" || field == "NAN";
}

/// The line of a heading, as far as a file has one.
bool is_heading(const std::vector<std::string_view>& fields) {
  return std::ranges::all_of(fields, [](std::string_view field) {
    return !field.empty() && !is_nan(field) &&
           parse_decimal<double>(field.data(), field.data() + field.size()).fault ==
               DecimalFault::malformed;
  });
}

double number_of(std::string_view field, const TextCursor& cursor) {
  if (is_nan(field)) return std::numeric_limits<double>::quiet_NaN();
  const char* const end = field.data() + field.size();
  const DecimalResult<double> result = parse_decimal<double>(field.data(), end);
  if (result.fault == DecimalFault::overflow || result.fault == DecimalFault::not_finite)
    cursor.fail("'" + printable(std::string(field)) +
                "' is beyond the largest binary64 number, expected finite numbers");
  if (result.fault != DecimalFault::none || result.end != end)
    cursor.fail("expected a number, found '" + printable(std::string(field)) + "'");
  return result.value;
}

}  // namespace

std::vector<double> numbers_of_csv(std::string_view text, std::uint64_t pixels,
                                   const std::string& name) {
  TextCursor cursor(text, name, {});
  std::vector<double> numbers;
  // A line has at least 6 characters.
  numbers.reserve(3 * std::min<std::uint64_t>(pixels, text.size() / 5 + 1));
  bool may_be_heading = true;
  for (; cursor.next_line_with_words(); cursor.skip_line()) {
    const std::vector<std::string_view> fields = comma_fields(cursor.rest_of_line());
    if (std::exchange(may_be_heading, false) && is_heading(fields)) continue;
    if (fields.size() != 3) cursor.fail("expected x,y,z, found " + counted(fields.size(), "field"));
    if (numbers.size() == 3 * pixels)
      cursor.fail("more than the " + std::to_string(pixels) +
                  " directions of the image, expected one line for each pixel");
    for (const std::string_view field : fields) numbers.push_back(number_of(field, cursor));
  }
  if (numbers.size() != 3 * pixels)
    throw InputError(name + ": has " + counted(numbers.size() / 3, "direction") +
                     ", expected one for each of the " + std::to_string(pixels) +
                     " pixels of the image");
  return numbers;
}

}  // namespace fathom::image
