#include "apps/rays/columns.h"

#include <bit>
#include <type_traits>

#include "fathom/files/byte_order.h"
#include "fathom/image/files/npy_array.h"
#include "fathom/image/files/zip_archive.h"
#include "fathom/text/decimal.h"

namespace fathom::app {
namespace {

void append_number(std::string& text, double number) {
  text += text::shortest_decimal(number);
}
template <class Whole>
void append_number(std::string& text, Whole number) {
  text += std::to_string(number);
}

template <class Number>
constexpr const char* type_of = std::is_same_v<Number, double>          ? "<f8"
                                : std::is_same_v<Number, std::uint32_t> ? "<u4"
                                                                        : "<u8";

template <class Number>
files::Bytes npy_of(const Column& column, const std::vector<Number>& values) {
  std::string shape = std::to_string(column.rows()) + ",";
  if (!column.parts.empty()) shape += " " + std::to_string(column.width());
  files::Bytes bytes = image::npy_header(type_of<Number>, shape);
  const std::size_t first = bytes.size();
  bytes.resize(first + values.size() * sizeof(Number));
  for (std::size_t i = 0; i < values.size(); ++i)
    store(bytes.data() + first + i * sizeof(Number), values[i], std::endian::little);
  return bytes;
}

std::string heading_of(const std::vector<Column>& columns) {
  std::string line;
  const auto append = [&](const std::string& name) {
    if (!line.empty()) line += ',';
    line += name;
  };
  for (const Column& column : columns) {
    if (column.parts.empty()) append(column.name);
    for (const std::string_view part : column.parts) append(column.name + "." + std::string(part));
  }
  return line + "\n";
}

}  // namespace

std::size_t Column::rows() const {
  return std::visit([](const auto& numbers) { return numbers.size(); }, values) / width();
}

std::string csv_of(const std::vector<Column>& columns) {
  std::string text = heading_of(columns);
  for (std::size_t row = 0; row < columns.front().rows(); ++row) {
    for (const Column& column : columns) {
      std::visit(
          [&](const auto& numbers) {
            for (std::size_t k = 0; k < column.width(); ++k) {
              if (k > 0 || &column != columns.data()) text += ',';
              append_number(text, numbers[row * column.width() + k]);
            }
          },
          column.values);
    }
    text += '\n';
  }
  return text;
}

files::Bytes npz_of(const std::vector<Column>& columns, const std::string& name) {
  image::ZipWriter archive(name);
  for (const Column& column : columns) {
    std::visit(
        [&](const auto& numbers) { archive.add(column.name + ".npy", npy_of(column, numbers)); },
        column.values);
  }
  return archive.take();
}

}  // namespace fathom::app
