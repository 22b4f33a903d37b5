#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

/// Files with six numbers in each row. "-" is standard input.
///   CSV   a heading with the names of the columns, in any order, then a line for each row; each
///         number is rounded once to binary64
///   NPY   an array of shape N×6, of binary64, binary32 or binary16
namespace fathom::app {

using NumberRow = std::array<double, 6>;
using ColumnNames = std::array<std::string_view, 6>;

/// What is wrong with a row of finite numbers; empty if nothing is. The columns have the names of
/// the set with the number `names`.
using FaultOfRow = std::function<std::string(std::size_t names, const NumberRow& row)>;

/// What a file should have.
struct NumberRowsFormat {
  /// A row in messages: "ray".
  const char* row;
  /// The columns of a CSV file have the names of one of these sets; those of an NPY file have the
  /// order of the first.
  std::span<const ColumnNames> sets;
  FaultOfRow fault_of;
};

/// Reads rows one after the other. A file of any length takes the same memory, except an NPY file
/// in Fortran order, which is read as a whole.
/// Fails    InputError "FILE: line N: …" or "FILE: row N: …": other columns, a number that is not
///          finite, a faulty row, a line of more than 1 MiB, no row.
class NumberRows {
 public:
  NumberRows(const std::string& file, NumberRowsFormat format);
  NumberRows(NumberRows&&) noexcept;
  NumberRows& operator=(NumberRows&&) noexcept;
  ~NumberRows();

  /// The number of the set of names.
  [[nodiscard]] std::size_t names() const;
  /// Reads the next row, in the order of the names; false at the end of the file.
  bool next(NumberRow& row);

  /// Where the rows come from.
  class Source;

 private:
  std::unique_ptr<Source> source_;
  bool has_rows_ = false;
  std::string no_row_;
};

}  // namespace fathom::app
