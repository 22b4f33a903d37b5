#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace fathom::studies {

/// A value that a study found. Nothing where there was nothing to measure: empty in CSV and on the
/// page, null in JSON.
struct Cell {
  using Value = std::variant<std::monostate, bool, std::int64_t, std::uint64_t, double, std::string,
                             std::vector<double>>;
  Value value;

  Cell() = default;
  Cell(bool flag) : value(flag) {}
  template <std::signed_integral T>
  Cell(T number) : value(std::int64_t{number}) {}
  template <std::unsigned_integral T>
  Cell(T number) : value(std::uint64_t{number}) {}
  Cell(double number) : value(number) {}
  Cell(const char* text) : value(std::string(text)) {}
  Cell(std::string_view text) : value(std::string(text)) {}
  Cell(std::string text) : value(std::move(text)) {}
  Cell(std::vector<double> numbers) : value(std::move(numbers)) {}
  template <class T>
  Cell(const std::optional<T>& maybe) : Cell(maybe ? Cell(*maybe) : Cell()) {}
};

/// As plain text; a list's numbers one after another. `format` is that of floating-point numbers,
/// as {fmt} reads it after a colon: ".3g". Without one, as many digits as it takes.
std::string text_of(const Cell& cell, const char* format = "");

}  // namespace fathom::studies
