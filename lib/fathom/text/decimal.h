#pragma once

#include <charconv>
#include <string>

/// Decimal text to binary floating point, rounded once (specification, section 1).
namespace fathom::text {

enum class DecimalFault {
  none,
  /// There is no decimal number.
  malformed,
  /// Beyond the largest finite number of the type.
  overflow,
  /// "nan", "inf" or "infinity": a word, not a number.
  not_finite,
};

template <class Real>
struct DecimalResult {
  Real value = 0;
  /// After the last character that belongs to the number.
  const char* end = nullptr;
  DecimalFault fault = DecimalFault::none;
};

/// Reads the longest decimal at `first`: [+-] digits [. digits] [e [+-] digits], with digits on at
/// least one side of the point. It does not begin with blanks, and no locale plays a role.
/// Exact    rounded once from the text to Real (float or double), to nearest, ties to even;
///          subnormals are kept; below half the least subnormal the result is a signed zero.
template <class Real>
DecimalResult<Real> parse_decimal(const char* first, const char* last);

extern template DecimalResult<float> parse_decimal<float>(const char*, const char*);
extern template DecimalResult<double> parse_decimal<double>(const char*, const char*);

/// The shortest decimal text that is read back as the number, a float or a double: "0.1", "1e+30",
/// "inf".
template <class Real>
std::string shortest_decimal(Real value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

}  // namespace fathom::text
