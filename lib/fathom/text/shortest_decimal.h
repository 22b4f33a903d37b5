#pragma once

#include <charconv>
#include <string>

namespace fathom::text {

/// The shortest decimal text that is read back as the number, a float or a double: "0.1", "1e+30",
/// "inf".
template <class Real>
std::string shortest_decimal(Real value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

}  // namespace fathom::text
