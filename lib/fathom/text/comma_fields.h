#pragma once

#include <string_view>
#include <vector>

#include "fathom/text/trimmed.h"

namespace fathom::text {

/// What stands between the commas of a line, without blanks around it. Quotes have no meaning.
inline std::vector<std::string_view> comma_fields(std::string_view line) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t comma = line.find(',');
    fields.push_back(trimmed(line.substr(0, comma)));
    if (comma == line.npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

}  // namespace fathom::text
