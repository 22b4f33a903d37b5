#pragma once

/// Decimal text to binary floating point, rounded once (specification, section 1).
namespace fathom::text {

enum class DecimalFault {
  none,
  /// No decimal number stands there.
  malformed,
  /// Beyond the largest finite number of the type.
  overflow,
  /// "nan", "inf" or "infinity": a word, not a number.
  not_finite,
};

template <class Real>
struct DecimalResult {
  Real value = 0;
  /// Behind the last character that belongs to the number.
  const char* end = nullptr;
  DecimalFault fault = DecimalFault::none;
};

/// Reads the longest decimal at `first`: [+-] digits [. digits] [e [+-] digits], digits on at least
/// one side of the point. Leading blanks are no part of it; no locale plays a role.
/// Exact    rounded once from the text to Real (float or double), to nearest, ties to even;
///          subnormals are kept; below half the least subnormal the result is a signed zero.
template <class Real>
DecimalResult<Real> parse_decimal(const char* first, const char* last);

extern template DecimalResult<float> parse_decimal<float>(const char*, const char*);
extern template DecimalResult<double> parse_decimal<double>(const char*, const char*);

}  // namespace fathom::text
