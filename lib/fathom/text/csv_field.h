#pragma once

#include <string>
#include <string_view>

namespace fathom::text {

/// A text in quotes, as a field of CSV (RFC 4180).
inline std::string in_csv_quotes(std::string_view text) {
  std::string field = "\"";
  for (const char c : text) {
    if (c == '"') field += '"';
    field += c;
  }
  return field + "\"";
}

}  // namespace fathom::text
