#pragma once

#include <cstdint>
#include <string>
#include <string_view>

/// Numbers of things, as messages tell them.
namespace fathom::text {

/// "1 vertex", "0 vertices", "2 vertices".
inline std::string counted(std::uint64_t count, std::string_view one, std::string_view many) {
  return std::to_string(count).append(" ").append(count == 1 ? one : many);
}

/// The same for a plural with s: "1 pixel", "2 pixels".
inline std::string counted(std::uint64_t count, std::string_view one) {
  return counted(count, one, std::string(one) + "s");
}

}  // namespace fathom::text
