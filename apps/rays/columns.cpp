#include "apps/rays/columns.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <string>
#include <type_traits>
#include <utility>

#include "apps/shell/standard_streams.h"
#include "fathom/failures/errors.h"
#include "fathom/files/byte_order.h"
#include "fathom/rays/hit_values.h"
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
NpzRows::Array array_of(const Column& column, const std::vector<Number>&) {
  std::vector<std::uint64_t> shape{column.rows()};
  if (!column.parts.empty()) shape.push_back(column.width());
  return {column.name, type_of<Number>, sizeof(Number), std::move(shape)};
}

template <class Number>
files::Bytes bytes_of(const std::vector<Number>& values) {
  files::Bytes bytes(values.size() * sizeof(Number));
  for (std::size_t i = 0; i < values.size(); ++i)
    store(bytes.data() + i * sizeof(Number), values[i], std::endian::little);
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
    for (const char part : column.parts) append(column.name + "." + part);
  }
  return line + "\n";
}

std::string lines_of(const std::vector<Column>& columns) {
  std::string text;
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

}  // namespace

std::size_t Column::rows() const {
  return std::visit([](const auto& numbers) { return numbers.size(); }, values) / width();
}

bool ColumnOutput::is_for(const std::string& name) {
  return name == "-" || name.ends_with(".csv") || name.ends_with(".npz");
}

ColumnOutput::ColumnOutput(const std::string& name)
    : name_(name), is_text_(!name.ends_with(".npz")) {
  if (!is_for(name)) throw UsageError("-o: '" + name + "' does not end in .csv or .npz");
  if (name == "-") {
    expect_standard_output();
    waiting_.resize(1);
  } else {
    file_.emplace(name);
    file_->write_by_descriptor([this](int descriptor) { descriptor_ = descriptor; });
  }
}

void ColumnOutput::append(const std::vector<Column>& columns) {
  if (is_text_) {
    if (!has_rows_) append_text(heading_of(columns));
    append_text(lines_of(columns));
  } else {
    append_arrays(columns);
  }
  has_rows_ = true;
}

void ColumnOutput::append_text(const std::string& text) {
  if (file_) {
    write_all(descriptor_, text.data(), text.size(), name_);
  } else {
    waiting_.front().append(std::as_bytes(std::span(text)));
  }
}

void ColumnOutput::append_arrays(const std::vector<Column>& columns) {
  waiting_.resize(columns.size());
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const auto append_values = [&](const auto& values) {
      NpzRows::Array block = array_of(columns[k], values);
      if (has_rows_) {
        arrays_[k].shape.front() += block.shape.front();
      } else {
        arrays_.push_back(std::move(block));
      }
      waiting_[k].append(bytes_of(values));
    };
    std::visit(append_values, columns[k].values);
  }
}

void ColumnOutput::write_archive() {
  NpzRows archive(descriptor_, name_, std::move(arrays_));
  for (std::size_t k = 0; k < waiting_.size(); ++k)
    waiting_[k].for_each_piece([&](files::ByteView piece) { archive.append(k, piece); });
  archive.finish();
}

void ColumnOutput::finish() {
  if (!file_) {
    return waiting_.front().for_each_piece([](files::ByteView piece) {
      print({reinterpret_cast<const char*>(piece.data()), piece.size()});
    });
  }
  if (is_archive()) write_archive();
  file_->commit();
}

std::vector<std::uint64_t> numbers_from(std::uint64_t first, std::size_t count) {
  std::vector<std::uint64_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), first);
  return numbers;
}

namespace {

/// Whether a channel is computed from the hit; a cast itself returns t and id.
bool is_value(HitChannel channel) {
  return description_of(channel).type == HitChannelType::real && channel != HitChannel::t;
}

using Values = std::vector<HitValues<double>>;

/// A column without numbers.
Column empty_column(HitChannel channel) {
  const HitChannelDescription& description = description_of(channel);
  return {std::string(description.name), description.parts, {}};
}

Column column_of(HitChannel channel, std::span<const RayHit> hits) {
  Column column = empty_column(channel);
  if (channel == HitChannel::t) {
    auto& t = column.values.emplace<std::vector<double>>(hits.size());
    std::ranges::transform(hits, t.begin(), &RayHit::t);
  } else {
    auto& id = column.values.emplace<std::vector<std::uint32_t>>(hits.size());
    std::ranges::transform(hits, id.begin(), &RayHit::triangle);
  }
  return column;
}

Column column_of(HitChannel channel, const TriangleSource& triangles,
                 std::span<const RayHit> hits) {
  std::vector<std::uint32_t> numbers;
  numbers.reserve(hits.size());
  for (const RayHit& hit : hits) {
    if (hit.triangle == no_triangle) {
      numbers.push_back(no_triangle);
      continue;
    }
    const TriangleOrigin origin = triangles.origin(hit.triangle);
    numbers.push_back(channel == HitChannel::object ? origin.object : origin.face);
  }
  Column column = empty_column(channel);
  column.values = std::move(numbers);
  return column;
}

Column column_of(HitChannel channel, const Values& values) {
  Column column = empty_column(channel);
  std::vector<double> numbers;
  const auto append = [&](const auto& of_hit) {
    for (const HitValues<double>& each : values)
      numbers.insert(numbers.end(), (each.*of_hit).begin(), (each.*of_hit).end());
  };
  switch (channel) {
    case HitChannel::P:
      append(&HitValues<double>::position);
      break;
    case HitChannel::bary:
      append(&HitValues<double>::barycentric);
      break;
    case HitChannel::N:
      append(&HitValues<double>::normal);
      break;
    default:
      for (const HitValues<double>& each : values) numbers.push_back(each.distance);
  }
  column.values = std::move(numbers);
  return column;
}

}  // namespace

std::vector<Column> columns_of(const TriangleSource& triangles, std::span<const Ray> rays,
                               std::span<const std::uint64_t> ray_of_hit,
                               std::span<const RayHit> hits,
                               const std::vector<HitChannel>& channels, int threads) {
  Values values;
  if (std::ranges::any_of(channels, is_value)) {
    std::vector<Ray> of_hits;
    std::vector<std::uint32_t> met;
    for (std::size_t i = 0; i < hits.size(); ++i) {
      of_hits.push_back(rays[ray_of_hit[i]]);
      met.push_back(hits[i].triangle);
    }
    values = hit_values<double>(triangles, of_hits, met, threads);
  }
  std::vector<Column> columns;
  for (const HitChannel channel : channels) {
    if (is_value(channel)) {
      columns.push_back(column_of(channel, values));
    } else if (channel == HitChannel::object || channel == HitChannel::face) {
      columns.push_back(column_of(channel, triangles, hits));
    } else {
      columns.push_back(column_of(channel, hits));
    }
  }
  return columns;
}

}  // namespace fathom::app
