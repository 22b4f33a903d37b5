#include "fathom/text/decimal.h"

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <system_error>
#include <type_traits>

namespace fathom::text {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

constexpr std::array<double, 23> powers_of_ten{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                               1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                               1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/// Reads the number at `first` if it has no exponent and so few digits that these, as a whole
/// number, and the power of ten by which they are divided are both exact in Real: one division
/// rounds it, once. Covers almost all numbers in practice. Returns false for any other input.
/// Source   [Cli90] section 1
template <class Real>
[[gnu::always_inline]] inline bool parse_short(const char* first, const char* last, Real& value,
                                               const char*& end) {
  constexpr bool is_double = std::numeric_limits<Real>::digits == 53;
  constexpr std::uint64_t most = std::uint64_t{1} << std::numeric_limits<Real>::digits;
  constexpr std::size_t most_places = is_double ? 22 : 10, most_digits = 19;
  const bool negative = first != last && *first == '-';
  const char* at = first + (negative ? 1 : 0);
  DigitRun digits = read_digits(at, last);
  std::size_t places = 0;
  if (at != last && *at == '.') {
    places = digits.count;
    digits = read_digits(++at, last, digits);
    places = digits.count - places;
  }
  if (digits.count == 0 || digits.count > most_digits) return false;
  if (digits.number > most || places > most_places) return false;
  if (at != last && (*at == 'e' || *at == 'E')) return false;
  value = static_cast<Real>(digits.number) / static_cast<Real>(powers_of_ten[places]);
  // Without a branch: of many coordinates every other one is negative.
  using Bits = std::conditional_t<is_double, std::uint64_t, std::uint32_t>;
  value =
      std::bit_cast<Real>(std::bit_cast<Bits>(value) | Bits{negative} << (8 * sizeof(Bits) - 1));
  end = at;
  return true;
}

/// Whether the number in [first, last), which is known to be out of range, is a small one: its
/// leading digit's power of ten is negative.
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
  // `power` is at most the length of the text; an exponent that reaches 10¹⁷ settles it.
  long long exponent = 0;
  for (; at != last && exponent < 1'000'000'000'000'000'000 / 10; ++at)
    exponent = 10 * exponent + (*at - '0');
  return power + (negative ? -exponent : exponent) < 0;
}

/// Below the least normal number std::from_chars may report a range error only for 0: a number that
/// rounds to a subnormal is read like any other (checked against MPFR in decimal_test).
template <class Real>
DecimalResult<Real> out_of_range(const char* first, const char* end) {
  if (is_small(first, end))
    return {std::copysign(Real(0), *first == '-' ? Real(-1) : Real(1)), end};
  return {0, end, DecimalFault::overflow};
}

}  // namespace

template <class Real>
DecimalResult<Real> parse_decimal(const char* first, const char* last) {
  // std::from_chars takes no '+'; and "+-1" is not a number.
  if (first != last && *first == '+') {
    ++first;
    if (first != last && *first == '-') return {0, first, DecimalFault::malformed};
  }
  Real value = 0;
  const char* short_end = nullptr;
  if (parse_short(first, last, value, short_end)) return {value, short_end};
  DecimalResult<Real> result;
  const auto [end, error] = std::from_chars(first, last, result.value);
  result.end = end;
  if (error == std::errc::result_out_of_range) return out_of_range<Real>(first, end);
  if (error != std::errc()) return {0, first, DecimalFault::malformed};
  if (!std::isfinite(result.value)) {
    // Either the words "inf" or "nan", or an overflow, which std::from_chars may also report so.
    const char* at = *first == '-' ? first + 1 : first;
    const bool is_number = is_digit(*at) || *at == '.';
    result.fault = is_number ? DecimalFault::overflow : DecimalFault::not_finite;
  }
  return result;
}

template DecimalResult<float> parse_decimal<float>(const char*, const char*);
template DecimalResult<double> parse_decimal<double>(const char*, const char*);

}  // namespace fathom::text
