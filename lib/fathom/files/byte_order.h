#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

/// Numbers in files, independent of the machine's byte order. Values move as integers, so that the
/// bits of a NaN survive.
namespace fathom {

template <std::size_t size>
using UnsignedOfSize = std::conditional_t<
    size == 1, unsigned char,
    std::conditional_t<size == 2, std::uint16_t,
                       std::conditional_t<size == 4, std::uint32_t, std::uint64_t>>>;

template <class T>
T load(const std::byte* from, std::endian order) {
  UnsignedOfSize<sizeof(T)> bits = 0;
  for (std::size_t k = 0; k < sizeof(T); ++k) {
    const std::size_t shift = 8 * (order == std::endian::little ? k : sizeof(T) - 1 - k);
    bits = static_cast<decltype(bits)>(bits | (static_cast<decltype(bits)>(from[k]) << shift));
  }
  return std::bit_cast<T>(bits);
}

template <class T>
void store(std::byte* to, T value, std::endian order) {
  const auto bits = std::bit_cast<UnsignedOfSize<sizeof(T)>>(value);
  for (std::size_t k = 0; k < sizeof(T); ++k) {
    const std::size_t shift = 8 * (order == std::endian::little ? k : sizeof(T) - 1 - k);
    to[k] = static_cast<std::byte>((bits >> shift) & 0xFF);
  }
}

}  // namespace fathom
