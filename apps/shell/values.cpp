#include "apps/shell/values.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

#include "fathom/failures/errors.h"

namespace fathom::app {
namespace {

[[noreturn]] void refuse(std::string_view text, std::string_view wanted) {
  throw UsageError(fmt::format("'{}' is not {}", text, wanted));
}

template <class Number>
bool read_whole(std::string_view text, Number& value) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

/// If the text is a number and a unit, how to write it without the unit.
std::string hint_of_unit(const std::string& text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || !std::isfinite(value)) return "";
  const std::string_view unit(rest, static_cast<std::size_t>(end - rest));
  if (unit == "%") return fmt::format("; {} is a fraction: {}", text, value / 100);
  constexpr std::string_view units[] = {"mm", "cm",  "m",   "km", "in", "ft",
                                        "px", "deg", "rad", "°",  "s",  "ms"};
  if (std::ranges::find(units, unit) == std::end(units)) return "";
  return fmt::format("; leave out '{}': lengths are in units of the scene, angles in degrees",
                     unit);
}

template <std::size_t N>
std::array<double, N> parse_numbers(const std::string& text, std::string_view wanted) {
  const std::vector<std::string> parts = parse_list(text);
  if (parts.size() != N) refuse(text, wanted);
  std::array<double, N> numbers{};
  for (std::size_t i = 0; i < N; ++i) numbers[i] = parse_number(parts[i]);
  return numbers;
}

std::array<std::uint32_t, 2> parse_two_counts(std::string_view text, char separator,
                                              std::uint32_t least, std::string_view wanted) {
  const std::size_t cut = text.find(separator);
  std::array<std::uint32_t, 2> counts{};
  if (cut == std::string_view::npos || !read_whole(text.substr(0, cut), counts[0]) ||
      !read_whole(text.substr(cut + 1), counts[1]) || counts[0] < least || counts[1] < least) {
    refuse(text, wanted);
  }
  return counts;
}

}  // namespace

double parse_number(const std::string& text) {
  double value = 0;
  if (read_whole(text, value) && std::isfinite(value)) return value;
  refuse(text, "a finite number" + hint_of_unit(text));
}

double parse_number_or(const std::string& text, Words<double> words) {
  double value = 0;
  if (read_whole(text, value) && std::isfinite(value)) return value;
  return parse_word<double>(text, words, "a number");
}

double parse_number_or_infinity(const std::string& text) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (text == "infinity" || text == "+inf") return infinity;
  return parse_number_or(text, {{"inf", infinity}});
}

double parse_scale(const std::string& text) {
  const double scale = parse_number(text);
  if (!(scale > 0)) throw UsageError("'" + text + "' is not positive");
  return scale;
}

std::int64_t parse_whole(const std::string& text) {
  const double x = parse_number(text);
  if (x != std::floor(x) || std::abs(x) > 1e9)
    refuse(text, "a whole number from -1000000000 to 1000000000");
  return static_cast<std::int64_t>(x);
}

std::uint64_t parse_bytes(const std::string& text) {
  constexpr std::string_view units = "KMGT";
  const std::size_t unit = text.empty() ? units.npos : units.find(text.back());
  const bool has_unit = unit != units.npos;
  const int bits = has_unit ? 10 * (static_cast<int>(unit) + 1) : 0;
  std::uint64_t number = 0;
  const std::string_view digits(text.data(), text.size() - (has_unit ? 1 : 0));
  if (!read_whole(digits, number) || number == 0 || number > (std::uint64_t{1} << 62) >> bits) {
    refuse(text, "a size, such as 512M or 2G");
  }
  return number << bits;
}

std::uint32_t parse_count_from(std::uint32_t least, std::string_view text) {
  std::uint32_t value = 0;
  if (!read_whole(text, value) || value < least) {
    refuse(text, fmt::format("an integer from {} to 4294967295", least));
  }
  return value;
}

Size parse_size(const std::string& text) {
  return parse_two_counts(text, 'x', 1, "a size like 1280x720: WIDTHxHEIGHT, each at least 1");
}

std::array<std::uint32_t, 2> parse_pixel(const std::string& text) {
  return parse_two_counts(text, ',', 0,
                          "a pixel like 640,360: column and row, counted from 0 at the top left");
}

std::array<double, 2> parse_pair(const std::string& text) {
  return parse_numbers<2>(text, "two numbers with a comma between them");
}

std::array<double, 3> parse_vector(const std::string& text) {
  return parse_numbers<3>(text, "three numbers with commas between them");
}

std::vector<std::string> parse_list(const std::string& text) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == ',') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

void refuse_repeated(const std::string& name) {
  throw UsageError("'" + name + "' is there twice");
}

void refuse_word(const std::string& text, const std::vector<std::string>& words,
                 const std::string& other) {
  std::string message = fmt::format("'{}' is not one of {}", text, joined(words));
  if (words.size() == 2) message = fmt::format("'{}' is neither {}", text, joined(words, " nor "));
  if (!other.empty())
    message = fmt::format("'{}' is not {} or {}", text, joined(words, ", "), other);
  throw UnknownName(message, text, words);
}

std::vector<std::string> parse_names(const std::string& list,
                                     const std::function<void(const std::string&)>& check) {
  std::vector<std::string> names = parse_list(list);
  for (const std::string& name : names) check(name);
  return names;
}

}  // namespace fathom::app
