#pragma once

#include <string>

#include "fathom/text/printable.h"

namespace fathom::app {

/// A text as a field of CSV (RFC 4180), in quotes.
inline std::string quoted(const std::string& text) {
  std::string field = "\"";
  for (const char c : text::printable(text))
    field += c == '"' ? std::string("\"\"") : std::string(1, c);
  return field + "\"";
}

}  // namespace fathom::app
