#include "apps/shell/numbers.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <system_error>

#include "fathom/numeric/errors.h"

namespace fathom::app {
namespace {

[[noreturn]] void refuse(const std::string& option, std::string_view text,
                         std::string_view wanted) {
  throw UsageError(fmt::format("{}: '{}' is not {}", option, text, wanted));
}

template <class Number>
bool read_whole(std::string_view text, Number& value) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

template <std::size_t N>
std::array<double, N> parse_numbers(const std::string& option, std::string_view text,
                                    std::string_view wanted) {
  const std::vector<std::string> parts = split_list(text);
  if (parts.size() != N) refuse(option, text, wanted);
  std::array<double, N> numbers{};
  for (std::size_t i = 0; i < N; ++i) numbers[i] = parse_number(option, parts[i]);
  return numbers;
}

std::array<std::uint32_t, 2> parse_two_counts(const std::string& option, std::string_view text,
                                              char separator, std::uint32_t least,
                                              std::string_view wanted) {
  const std::size_t cut = text.find(separator);
  std::array<std::uint32_t, 2> counts{};
  if (cut == std::string_view::npos || !read_whole(text.substr(0, cut), counts[0]) ||
      !read_whole(text.substr(cut + 1), counts[1]) || counts[0] < least || counts[1] < least) {
    refuse(option, text, wanted);
  }
  return counts;
}

}  // namespace

double parse_number(const std::string& option, std::string_view text) {
  double value = 0;
  if (!read_whole(text, value) || !std::isfinite(value)) refuse(option, text, "a finite number");
  return value;
}

std::uint32_t parse_count(const std::string& option, std::string_view text, std::uint32_t least) {
  std::uint32_t value = 0;
  if (!read_whole(text, value) || value < least) {
    refuse(option, text, fmt::format("an integer from {} to 4294967295", least));
  }
  return value;
}

std::array<std::uint32_t, 2> parse_size(const std::string& option, std::string_view text) {
  return parse_two_counts(option, text, 'x', 1,
                          "a size like 1280x720: WIDTHxHEIGHT, each at least 1");
}

std::array<std::uint32_t, 2> parse_pixel(const std::string& option, std::string_view text) {
  return parse_two_counts(option, text, ',', 0,
                          "a pixel like 640,360: column and row, counted from 0 at the top left");
}

std::array<double, 2> parse_pair(const std::string& option, std::string_view text) {
  return parse_numbers<2>(option, text, "two numbers with a comma between them");
}

std::array<double, 3> parse_vector(const std::string& option, std::string_view text) {
  return parse_numbers<3>(option, text, "three numbers with commas between them");
}

std::vector<std::string> split_list(std::string_view text) {
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

void expect_png(const std::string& option, const std::string& name) {
  const std::string suffix = std::filesystem::path(name).extension().string();
  std::error_code error;
  if (suffix == ".png" || suffix == ".PNG") return;
  if (std::filesystem::is_other(std::filesystem::status(name, error))) return;  // a device, a pipe
  throw UsageError(option + ": '" + name + "' does not end in .png");
}

}  // namespace fathom::app
