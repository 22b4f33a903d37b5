#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <string>

/// Names that writing and reading of Cryptomatte share. Only for the module's .cpp files.
namespace fathom::image {

inline std::string in_hexadecimal(std::uint32_t bits) {
  std::array<char, 9> text{};
  std::snprintf(text.data(), text.size(), "%08x", bits);
  return text.data();
}

/// LAYER00 holds the ranks 0 and 1, LAYER01 the ranks 2 and 3, ….
inline std::string matte_channel(const std::string& layer, std::size_t level, char component) {
  return layer + (level < 10 ? "0" : "") + std::to_string(level) + "." + component;
}

}  // namespace fathom::image
