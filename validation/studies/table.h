#pragma once

#include <algorithm>
#include <functional>
#include <iterator>
#include <string>
#include <type_traits>
#include <vector>

#include "validation/studies/cell.h"

namespace fathom::studies {

/// A column of a table: where it is written, under which name, and how its floating-point numbers
/// are formatted there (see text_of). Without more it is in CSV and JSON.
struct Column {
  std::string key;  ///< in CSV; empty: not there
  const char* csv_format;
  std::string json_key;                ///< empty: not there
  std::optional<std::string> heading;  ///< on the page; none: not there
  const char* page_format = "";
  bool is_percent = false;  ///< the page shows a hundred times the value

  Column(const char* name) : Column(std::string(name)) {}
  Column(const std::string& name, const char* format = ".17g")
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

/// A column of the page alone.
inline Column heading(const std::string& name, const char* format = "") {
  return Column("").page(name, format);
}
inline Column percent_heading(const std::string& name, const char* format) {
  return Column("").percent(name, format);
}

template <class Row>
struct ColumnOf {
  Column column;
  /// A member or a function of a row.
  std::function<Cell(const Row&)> value;
};

/// The rows that `holds` is true of.
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

/// A line of keys and one for each row. Text with a comma stands between quotes (RFC 4180).
std::string csv_of(const Table& table);

/// A row of headings and one for each row.
std::string html_of(const Table& table);

}  // namespace fathom::studies
