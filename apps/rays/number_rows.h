#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace fathom::app {

using NumberRow = std::array<double, 6>;
using ColumnNames = std::array<std::string_view, 6>;

/// Rows of a file whose columns have one of several sets of names.
struct NumberRows {
  /// The set of names, by number.
  std::size_t names = 0;
  /// In the order of the names.
  std::vector<NumberRow> rows;
};

/// What is wrong with a row of finite numbers; empty if nothing is.
using FaultOfRow = std::function<std::string(std::size_t names, const NumberRow& row)>;

/// Reads rows of six numbers from a file:
///   CSV   a heading with the names of a set, in any order, then a line for each row; each number
///         is rounded once to binary64
///   NPY   an array of shape N×6, of binary64 or binary32, in the order of the first set
/// "-" is standard input. `row` names a row in messages: "ray".
/// Fails    InputError "FILE: line N: …" or "FILE: row N: …": other columns, a number that is not
///          finite, a fault; no row.
NumberRows read_rows(const std::string& file, const char* row, std::span<const ColumnNames> sets,
                     const FaultOfRow& fault_of);

}  // namespace fathom::app
