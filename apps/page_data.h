#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>

/// Data within pages for a browser.
namespace fathom::app {

/// RFC 4648, with padding.
inline std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t rest = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) word = word << 8 | (k < rest ? bytes[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= rest ? letters[word >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

/// A script element that holds JSON, found by its id. Nothing in the JSON can end the element: `<`
/// is escaped.
inline std::string script_data(const std::string& id, std::string json) {
  for (std::size_t i = 0; (i = json.find('<', i)) != std::string::npos;)
    json.replace(i, 1, "\\u003c");
  return "<script id=\"" + id + "\" type=\"application/json\">" + json + "</script>\n";
}

}  // namespace fathom::app
