#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <string>

#include "fathom/drawing/drawing.h"
#include "fathom/failures/errors.h"

namespace fathom::drawing {

/// Appends the shortest decimal text without an exponent, which PDF does not read, that is read
/// back as the number, and a space.
template <class Real>
void append_number(std::string& text, Real number) {
  // The longest have all digits of the least binary64 number after the point.
  std::array<char, 400> digits{};
  const auto end =
      std::to_chars(digits.data(), digits.data() + digits.size(), number, std::chars_format::fixed);
  text.append(digits.data(), end.ptr);
  text += ' ';
}

inline void append_point(std::string& text, const DrawnPoint& point) {
  append_number(text, point[0]);
  append_number(text, point[1]);
}

inline void require_valid(const DrawingStyle& style) {
  if (!std::isfinite(style.stroke) || style.stroke <= 0) {
    throw UsageError("the stroke: expected a width in pixels above 0");
  }
}

}  // namespace fathom::drawing
