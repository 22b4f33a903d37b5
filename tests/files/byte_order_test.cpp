#include "fathom/files/byte_order.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace fathom {
namespace {

using Eight = std::array<std::byte, 8>;

template <class T>
void expect_bytes(T value, std::endian order, const Eight& expected) {
  Eight bytes{};
  store(bytes.data(), value, order);
  EXPECT_EQ(bytes, expected);
  EXPECT_EQ(load<T>(bytes.data(), order), value);
}

constexpr std::byte b(int value) {
  return static_cast<std::byte>(value);
}

TEST(ByteOrder, ValuesOfEveryTypeOnPaper) {
  const auto little = std::endian::little, big = std::endian::big;
  expect_bytes<std::int8_t>(-2, little, {b(0xFE)});
  expect_bytes<std::uint16_t>(0x1234, little, {b(0x34), b(0x12)});
  expect_bytes<std::uint16_t>(0x1234, big, {b(0x12), b(0x34)});
  expect_bytes<std::int32_t>(-2, big, {b(0xFF), b(0xFF), b(0xFF), b(0xFE)});
  expect_bytes<float>(1.5F, big, {b(0x3F), b(0xC0)});
  expect_bytes<float>(1.5F, little, {b(0), b(0), b(0xC0), b(0x3F)});
  expect_bytes<double>(-2.0, big, {b(0xC0)});
  expect_bytes<std::uint64_t>(0x0102030405060708, little,
                              {b(8), b(7), b(6), b(5), b(4), b(3), b(2), b(1)});
}

TEST(ByteOrder, TheBitsOfNaNsPass) {
  std::array<std::byte, 4> bytes{b(0x7F), b(0xA0), b(0x00), b(0x01)};  // a signalling one
  const auto bits = load<std::uint32_t>(bytes.data(), std::endian::big);
  EXPECT_EQ(bits, 0x7FA00001U);
  EXPECT_TRUE(std::isnan(load<float>(bytes.data(), std::endian::big)));
}

}  // namespace
}  // namespace fathom
