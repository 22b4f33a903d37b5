#pragma once

#include <array>
#include <bit>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

/// Decimal text to binary floating point, rounded once (specification, section 1), and digits,
/// eight characters at a time.
namespace fathom::text {

enum class DecimalFault {
  none,
  /// There is no decimal number.
  malformed,
  /// Beyond the largest finite number of the type.
  overflow,
  /// "nan", "inf" or "infinity": a word, not a number.
  not_finite,
};

template <class Real>
struct DecimalResult {
  Real value = 0;
  /// After the last character that belongs to the number.
  const char* end = nullptr;
  DecimalFault fault = DecimalFault::none;
};

/// Reads the longest decimal at `first`: [+-] digits [. digits] [e [+-] digits], with digits on at
/// least one side of the point. It does not begin with blanks, and no locale plays a role.
/// Exact    rounded once from the text to Real (float or double), to nearest, ties to even;
///          subnormals are kept; below half the least subnormal the result is a signed zero.
template <class Real>
DecimalResult<Real> parse_decimal(const char* first, const char* last);

extern template DecimalResult<float> parse_decimal<float>(const char*, const char*);
extern template DecimalResult<double> parse_decimal<double>(const char*, const char*);

/// The shortest decimal text that is read back as the number, a float or a double: "0.1", "1e+30",
/// "inf".
template <class Real>
std::string shortest_decimal(Real value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

}  // namespace fathom::text

static_assert(std::endian::native == std::endian::little,
              "the first of eight digits is the lowest byte");

namespace fathom::text {

/// 10⁰ to 10⁸.
inline constexpr std::array<std::uint64_t, 9> short_powers_of_ten{
    1, 10, 100, 1'000, 10'000, 100'000, 1'000'000, 10'000'000, 100'000'000};

/// Digits that follow each other, and the number that they are.
struct DigitRun {
  std::uint64_t number = 0;
  std::size_t count = 0;
};

/// How many digits the eight characters begin with that have been exclusive-ored with '0'.
[[gnu::always_inline]] inline std::size_t leading_digits(std::uint64_t characters) {
  const std::uint64_t others =
      ((characters + 0x0606060606060606) | characters) & 0xF0F0F0F0F0F0F0F0;
  return static_cast<std::size_t>(std::countr_zero(others)) / 8;
}

inline constexpr std::uint64_t eight_zeros = 0x3030303030303030;  // '0': '9' becomes 9, 'a' more

/// The first digits of eight characters, without a branch for each.
/// Source   [Lem21]: neighbours are joined to numbers of two, four and eight digits.
[[gnu::always_inline]] inline DigitRun digits_of_eight(const char* at) {
  std::uint64_t word = 0;
  std::memcpy(&word, at, sizeof word);
  word ^= eight_zeros;
  const std::size_t count = leading_digits(word);
  if (count == 0) return {};
  word <<= 64 - 8 * count;  // zeros in front
  word = (word * 10 + (word >> 8)) & 0x00FF00FF00FF00FF;
  word = (word * 100 + (word >> 16)) & 0x0000FFFF0000FFFF;
  word = (word * 10000 + (word >> 32)) & 0x00000000FFFFFFFF;
  return {word, count};
}

/// Reads the digits at `at`, which continue the digits of `before`, and moves `at` behind them. The
/// number is computed modulo 2⁶⁴, so it is correct for at most 19 digits in all.
[[gnu::always_inline]] inline DigitRun read_digits(const char*& at, const char* last,
                                                   DigitRun before = {}) {
  while (static_cast<std::size_t>(last - at) >= sizeof(std::uint64_t)) {
    const DigitRun some = digits_of_eight(at);
    before.number = before.number * short_powers_of_ten[some.count] + some.number;
    before.count += some.count;
    at += some.count;
    if (some.count < sizeof(std::uint64_t)) return before;
  }
  for (; at != last && '0' <= *at && *at <= '9'; ++at, ++before.count)
    before.number = 10 * before.number + static_cast<std::uint64_t>(*at - '0');
  return before;
}

/// Sets the highest bits of those of eight characters that are not ASCII characters between `least`
/// and `greatest`; correct up to the first such character.
template <char least, char greatest>
[[gnu::always_inline]] inline std::uint64_t marks_of_others(const char* at) {
  constexpr std::uint64_t each = 0x0101010101010101;
  std::uint64_t word = 0;
  std::memcpy(&word, at, sizeof word);
  const std::uint64_t above = word + (0x7F - greatest) * each;
  const std::uint64_t not_below = word + (0x80 - least) * each;
  return (word | above | ~not_below) & (0x80 * each);
}

/// Moves `at` behind the characters there that lie between `least` and `greatest`, of ASCII.
/// Sixteen at a time, so that no branch depends on the length of a usual word.
template <char least, char greatest>
[[gnu::always_inline]] inline void skip_characters(const char*& at, const char* last) {
  while (last - at >= 16) {
    const std::uint64_t first = marks_of_others<least, greatest>(at);
    const std::uint64_t second = marks_of_others<least, greatest>(at + 8);
    const int bits = first != 0 ? std::countr_zero(first) : 64 + std::countr_zero(second);
    at += bits / 8;
    if (bits < 128) return;
  }
  while (at != last && least <= *at && *at <= greatest) ++at;
}

}  // namespace fathom::text
