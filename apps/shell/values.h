#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <ranges>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "fathom/failures/unknown_name.h"

namespace fathom::app {

// Parsers of texts on the command line.
// Exact    decimal text is rounded once, to binary64.
// Fails    UsageError: "'text' is not …".

/// A finite number.
double parse_number(const std::string& text);
/// A finite number, or a word that stands for a number.
double parse_number_or(const std::string& text,
                       std::initializer_list<std::pair<const char*, double>> words);
/// A finite number or "inf".
double parse_number_or_infinity(const std::string& text);
/// A finite number above 0.
double parse_scale(const std::string& text);
/// A whole number in [−10⁹, 10⁹].
std::int64_t parse_whole(const std::string& text);
/// An integer in [least, 2³² − 1].
std::uint32_t parse_count_from(std::uint32_t least, std::string_view text);
inline std::uint32_t parse_count(const std::string& text) {
  return parse_count_from(0, text);
}
inline std::uint32_t parse_positive(const std::string& text) {
  return parse_count_from(1, text);
}

/// A size in bytes, at least 1: "1000000", "512M", "2G"; K, M, G and T are powers of 1024.
std::uint64_t parse_bytes(const std::string& text);

using Size = std::array<std::uint32_t, 2>;
/// "1280x720".
Size parse_size(const std::string& text);
/// "X,Y".
std::array<std::uint32_t, 2> parse_pixel(const std::string& text);
/// Two numbers, "AZIMUTH,ELEVATION".
std::array<double, 2> parse_pair(const std::string& text);
/// "X,Y,Z".
std::array<double, 3> parse_vector(const std::string& text);

/// The parts of a text between commas.
std::vector<std::string> parse_list(const std::string& text);

/// The names of a list, each checked.
std::vector<std::string> parse_names(const std::string& list,
                                     const std::function<void(const std::string&)>& check);

/// Fails    UsageError: "'name' is there twice".
[[noreturn]] void refuse_repeated(const std::string& name);

/// The values of the names of a list, each parsed by `parse`.
/// Fails    UsageError where two names have the same value; as `parse`.
template <class Parse>
auto parse_distinct(const std::string& list, const Parse& parse) {
  std::vector<std::invoke_result_t<Parse, const std::string&>> values;
  for (const std::string& name : parse_list(list)) {
    auto value = parse(name);
    if (std::ranges::find(values, value) != values.end()) refuse_repeated(name);
    values.push_back(std::move(value));
  }
  return values;
}

/// Fails    UnknownName: "'text' is not one of …", with a suggestion. `other` names what else is
///          accepted: "a number".
[[noreturn]] void refuse_word(const std::string& text, const std::vector<std::string>& words,
                              const std::string& other = "");

/// Words with their values.
template <class Value>
using Words = std::initializer_list<std::pair<const char*, Value>>;

/// The value of a word. The caller has already tried other accepted values; `other` names them.
template <class Value>
Value parse_word(const std::string& text, Words<Value> words, const std::string& other = "") {
  std::vector<std::string> names;
  for (const auto& [name, value] : words) {
    if (text == name) return value;
    names.emplace_back(name);
  }
  refuse_word(text, names, other);
}

/// The value of an enumeration with this name_of().
template <class Values>
std::ranges::range_value_t<Values> parse_enumerator(const std::string& text, const Values& values) {
  if (const auto value = value_named(values, text)) return *value;
  refuse_word(text, names_of(values));
}

}  // namespace fathom::app
