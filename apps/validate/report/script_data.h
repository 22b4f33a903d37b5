#pragma once

#include <string>

namespace fathom::validation {

/// A script element that holds JSON, found by its id. Nothing in the JSON can end the element: `<`
/// is escaped.
inline std::string script_data(const std::string& id, std::string json) {
  for (std::size_t i = 0; (i = json.find('<', i)) != std::string::npos;)
    json.replace(i, 1, "\\u003c");
  return "<script id=\"" + id + "\" type=\"application/json\">" + json + "</script>\n";
}

}  // namespace fathom::validation
