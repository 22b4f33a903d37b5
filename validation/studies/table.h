#pragma once

#include <functional>
#include <string>
#include <type_traits>
#include <vector>

#include "validation/studies/cell.h"

namespace fathom::studies {

/// A column of a table: where it is written, under which name, and how.
struct Column {
  /// In CSV and, unless json_key says otherwise, in JSON. Empty: in neither.
  std::string key;
  const char* csv_format = "{:.17g}";  ///< of floating-point numbers
  /// "a.b" is the member b of the object a of each row; "a[]" is the next entry of its list a.
  /// Empty: not in JSON.
  std::optional<std::string> json_key;
  /// On the page. None: not there.
  std::optional<std::string> heading;
  const char* page_format = "{}";  ///< of floating-point numbers
  bool percent = false;            ///< the page shows a hundred times the value
};

template <class Row>
struct ColumnOf {
  Column column;
  /// A member or a function of a row.
  std::function<Cell(const Row&)> value;
};

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

/// A line of keys and one for each row. Text with a comma stands between quotes (RFC 4180).
std::string csv_of(const Table& table);

/// A row of headings and one for each row.
std::string html_of(const Table& table);

}  // namespace fathom::studies
