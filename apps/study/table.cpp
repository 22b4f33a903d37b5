#include "apps/study/table.h"

#include "apps/study/page.h"
#include "fathom/text/csv.h"

namespace fathom::studies {
namespace {

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  return text::in_csv_quotes(text);
}

std::string page_text(const Column& column, const Cell& cell) {
  const double* share = std::get_if<double>(&cell.value);
  if (!column.is_percent || !share) return text_of(cell, column.page_format);
  return text_of(100 * *share, column.page_format) + " %";
}

/// A line of the CSV; `text_at` gives the text of a column.
template <class TextAt>
std::string csv_line(const std::vector<Column>& columns, const TextAt& text_at) {
  std::string line;
  const char* separator = "";
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].key.empty()) continue;
    line += separator + csv_field(text_at(i));
    separator = ",";
  }
  return line + "\n";
}

template <class TextAt>
std::string html_row(const std::vector<Column>& columns, const std::string& tag,
                     const TextAt& text_at) {
  std::string row = "<tr>";
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (!columns[i].heading) continue;
    row += "<" + tag + ">" + escaped_html(text_at(i)) + "</" + tag + ">";
  }
  return row + "</tr>\n";
}

}  // namespace

std::string csv_of(const Table& table) {
  const std::vector<Column>& columns = table.columns();
  std::string text = csv_line(columns, [&](std::size_t i) { return columns[i].key; });
  for (const std::vector<Cell>& row : table.rows()) {
    text +=
        csv_line(columns, [&](std::size_t i) { return text_of(row[i], columns[i].csv_format); });
  }
  return text;
}

std::string html_of(const Table& table) {
  const std::vector<Column>& columns = table.columns();
  std::string text = "<div class=\"wide\"><table>\n" +
                     html_row(columns, "th", [&](std::size_t i) { return *columns[i].heading; });
  for (const std::vector<Cell>& row : table.rows()) {
    text += html_row(columns, "td", [&](std::size_t i) { return page_text(columns[i], row[i]); });
  }
  return text + "</table></div>\n";
}

}  // namespace fathom::studies
