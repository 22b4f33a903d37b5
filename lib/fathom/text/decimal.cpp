#include "fathom/text/decimal.h"

#include <charconv>
#include <cmath>
#include <system_error>

namespace fathom::text {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Whether the number that stands in [first, last) and is known to be out of range is a small one:
/// its leading digit's power of ten is negative.
bool is_small(const char* first, const char* last) {
  const char* at = first;
  if (*at == '-') ++at;
  long long power = -1;  // of ten, of the first digit that is not zero
  bool found = false;
  for (; at != last && is_digit(*at); ++at) {
    if (found || *at != '0') ++power, found = true;
  }
  if (at != last && *at == '.') {
    for (++at; at != last && is_digit(*at); ++at) {
      if (!found && *at == '0') --power;
      if (*at != '0') found = true;
    }
  }
  if (at == last) return power < 0;
  ++at;  // e
  const bool negative = *at == '-';
  if (*at == '-' || *at == '+') ++at;
  // `power` is at most the length of the text; an exponent that reaches 10¹⁸ settles it.
  long long exponent = 0;
  for (; at != last && exponent < 1'000'000'000'000'000'000 / 10; ++at)
    exponent = 10 * exponent + (*at - '0');
  return power + (negative ? -exponent : exponent) < 0;
}

/// Below the least normal number std::from_chars may report a range error for 0 only: a number
/// that rounds to a subnormal is read like any other (held to MPFR by decimal_test).
template <class Real>
DecimalResult<Real> out_of_range(const char* first, const char* end) {
  if (is_small(first, end))
    return {std::copysign(Real(0), *first == '-' ? Real(-1) : Real(1)), end};
  return {0, end, DecimalFault::overflow};
}

}  // namespace

template <class Real>
DecimalResult<Real> parse_decimal(const char* first, const char* last) {
  // std::from_chars takes no '+'; and "+-1" is no number.
  if (first != last && *first == '+') {
    ++first;
    if (first != last && *first == '-') return {0, first, DecimalFault::malformed};
  }
  DecimalResult<Real> result;
  const auto [end, error] = std::from_chars(first, last, result.value);
  result.end = end;
  if (error == std::errc::result_out_of_range) return out_of_range<Real>(first, end);
  if (error != std::errc()) return {0, first, DecimalFault::malformed};
  if (!std::isfinite(result.value)) {
    // Either the words "inf", "nan" or an overflow, which std::from_chars may also report so.
    const char* at = *first == '-' ? first + 1 : first;
    const bool is_number = is_digit(*at) || *at == '.';
    result.fault = is_number ? DecimalFault::overflow : DecimalFault::not_finite;
  }
  return result;
}

template DecimalResult<float> parse_decimal<float>(const char*, const char*);
template DecimalResult<double> parse_decimal<double>(const char*, const char*);

}  // namespace fathom::text
