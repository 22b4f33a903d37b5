#pragma once

#include <algorithm>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "apps/study/cell.h"

namespace fathom::studies {

/// The type of the cells of a column, independent of its rows, so that tables of a study have the
/// same types even without rows.
enum class CellKind {
  any,     ///< not fixed by the column: each cell has its own type
  flag,    ///< bool
  count,   ///< integers
  number,  ///< floating-point numbers, and any numbers that may be empty
  text
};

namespace table {

template <class T>
struct KindOf {
  static constexpr CellKind value = std::is_same_v<T, bool>       ? CellKind::flag
                                    : std::is_integral_v<T>       ? CellKind::count
                                    : std::is_floating_point_v<T> ? CellKind::number
                                                                  : CellKind::text;
};
template <>
struct KindOf<Cell> {
  static constexpr CellKind value = CellKind::any;
};
template <class T>
struct KindOf<std::optional<T>> {
  static constexpr CellKind value =
      KindOf<T>::value == CellKind::text ? CellKind::text : CellKind::number;
};

}  // namespace table

/// The kind of cells that are made of a T.
template <class T>
inline constexpr CellKind kind_of_cells = table::KindOf<std::remove_cvref_t<T>>::value;

/// A column of a table: the places where it is written, its names there, and the formats of its
/// floating-point numbers (see text_of). By default it is in CSV and JSON.
struct Column {
  std::string key;  ///< in CSV; empty: not there
  const char* csv_format;
  std::string json_key;                ///< empty: not there
  std::optional<std::string> heading;  ///< on the page; none: not there
  const char* page_format = "";
  bool is_percent = false;  ///< the page shows a hundred times the value
  CellKind kind = CellKind::any;

  Column(const char* name) : Column(std::string(name)) {}
  Column(const std::string& name, const char* format = "")
      : key(name), csv_format(format), json_key(name) {}

  /// Under another name in JSON: "a.b" is the member b of the object a of each row, "a[]" the next
  /// entry of its list a.
  Column& json(const std::string& name) {
    json_key = name;
    return *this;
  }
  Column& csv_only() { return json(""); }
  /// On the page too.
  Column& page(const std::string& name, const char* format = "") {
    heading = name;
    page_format = format;
    return *this;
  }
  Column& percent(const std::string& name, const char* format) {
    is_percent = true;
    return page(name, format);
  }
};

/// A column that only the page has.
inline Column heading(const std::string& name, const char* format = "") {
  return Column("").page(name, format);
}
inline Column percent_heading(const std::string& name, const char* format) {
  return Column("").percent(name, format);
}

template <class Row>
struct ColumnOf {
  Column column;
  std::function<Cell(const Row&)> value;

  /// `value_of` is a member or a function of a row.
  template <class Value>
  ColumnOf(Column of, Value value_of) : column(std::move(of)), value(std::move(value_of)) {
    column.kind = kind_of_cells<std::invoke_result_t<const Value&, const Row&>>;
  }
};

/// The rows for which `holds` is true.
template <class Row, class Predicate>
std::vector<Row> rows_where(const std::vector<Row>& rows, const Predicate& holds) {
  std::vector<Row> some;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(some), holds);
  return some;
}

/// Rows of values under columns, each declared once for CSV, JSON and the page.
class Table {
 public:
  template <class Row>
  Table(const std::vector<Row>& rows,
        const std::type_identity_t<std::vector<ColumnOf<Row>>>& columns) {
    for (const ColumnOf<Row>& column : columns) columns_.push_back(column.column);
    for (const Row& row : rows) {
      std::vector<Cell>& cells = rows_.emplace_back();
      for (const ColumnOf<Row>& column : columns) cells.push_back(column.value(row));
    }
  }

  /// One cell for each column.
  void add(std::vector<Cell> row) { rows_.push_back(std::move(row)); }

  [[nodiscard]] const std::vector<Column>& columns() const { return columns_; }
  [[nodiscard]] const std::vector<std::vector<Cell>>& rows() const { return rows_; }

 private:
  std::vector<Column> columns_;
  std::vector<std::vector<Cell>> rows_;
};

/// A line of keys and a line for each row. Text with a comma is quoted (RFC 4180).
std::string csv_of(const Table& table);

/// An HTML table: a row of headings and a row for each row.
std::string html_of(const Table& table);

}  // namespace fathom::studies
