#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "fathom/text/decimal.h"

namespace fathom {
namespace {

using namespace text;

/// Words as files have them, and characters beside the digits, in memory of their own, so that a
/// look beyond its end is seen by the address sanitizer.
std::vector<char> any_text(std::mt19937_64& random) {
  static constexpr std::string_view usual = "0123456789012345678901234567890123456789+-*/,.:;e \n";
  std::vector<char> text(random() % 40);
  for (char& c : text)
    c = random() % 20 == 0 ? static_cast<char>(random() % 256) : usual[random() % usual.size()];
  text.shrink_to_fit();
  return text;
}

bool is_digit(char c) {
  return '0' <= c && c <= '9';
}

TEST(Digits, AreReadAsOneByOne) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 200'000; ++i) {
    const std::vector<char> text = any_text(random);
    const char* const last = text.data() + text.size();
    std::uint64_t number = 0;
    const char* end = text.data();
    for (; end != last && is_digit(*end); ++end)
      number = 10 * number + static_cast<std::uint64_t>(*end - '0');
    const char* at = text.data();
    const DigitRun run = read_digits(at, last);
    ASSERT_EQ(at, end) << std::string(text.begin(), text.end());
    ASSERT_EQ(run.count, static_cast<std::size_t>(end - text.data()));
    ASSERT_EQ(run.number, number) << std::string(text.begin(), text.end());
  }
}

TEST(Digits, FollowThoseBefore) {
  const std::string text = "007.25";
  const char* at = text.data();
  const DigitRun whole = read_digits(at, text.data() + text.size());
  const DigitRun all = read_digits(++at, text.data() + text.size(), whole);
  EXPECT_EQ(whole.number, 7U);
  EXPECT_EQ(all.number, 725U);
  EXPECT_EQ(all.count, 5U);
}

template <char least, char greatest>
void expect_skipped(const std::vector<char>& text) {
  const char* const last = text.data() + text.size();
  const char* end = text.data();
  while (end != last && least <= *end && *end <= greatest) ++end;
  const char* at = text.data();
  skip_characters<least, greatest>(at, last);
  ASSERT_EQ(at, end) << std::string(text.begin(), text.end());
}

TEST(Digits, CharactersAreSkippedAsOneByOne) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 200'000; ++i) {
    const std::vector<char> text = any_text(random);
    expect_skipped<'0', '9'>(text);
    expect_skipped<'*', '9'>(text);
  }
}

}  // namespace
}  // namespace fathom
