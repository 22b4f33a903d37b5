#include "apps/rays/number_rows.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "fathom/failures/errors.h"
#include "fathom/files/byte_order.h"
#include "fathom/files/file_bytes.h"
#include "fathom/files/input_file.h"
#include "fathom/files/input_stream.h"
#include "fathom/image/files/npy_array.h"
#include "fathom/numeric/rounding.h"
#include "fathom/text/counted.h"
#include "fathom/text/csv.h"
#include "fathom/text/printable.h"

namespace fathom::app {

class NumberRows::Source {
 public:
  Source() = default;
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;
  virtual ~Source() = default;
  [[nodiscard]] virtual std::size_t names() const { return 0; }
  virtual bool next(NumberRow& row) = 0;
};

namespace {

/// This much of a file is in memory; a line must fit.
constexpr std::size_t most_kept = std::size_t{1} << 20;

/// A file, of which a piece is in memory.
class FilePiece {
 public:
  explicit FilePiece(const std::string& file) : stream_(file) { advance(0); }

  [[nodiscard]] std::string_view text() const { return buffer_; }
  [[nodiscard]] files::ByteView bytes() const { return std::as_bytes(std::span(buffer_)); }
  /// Whether the file ends with the piece.
  [[nodiscard]] bool is_last() const { return is_last_; }
  /// The bytes from the beginning of the piece to the end of the file; nullopt for a pipe.
  [[nodiscard]] std::optional<std::uint64_t> rest() const {
    const auto behind = stream_.rest();
    if (!behind) return std::nullopt;
    return *behind + buffer_.size();
  }

  /// Goes on by `count` bytes of the piece, and reads more.
  void advance(std::size_t count) {
    buffer_.erase(0, count);
    read_up_to(most_kept);
  }
  /// Reads the rest of the file.
  void take_all(const std::string& name) {
    while (!is_last_) {
      if (!stream_.rest() && buffer_.size() > files::largest_unsized_input)
        throw InputError(name + ": has more than " + std::to_string(files::largest_unsized_input) +
                         " bytes, the limit of inputs that are not regular files; expected a file");
      read_up_to(2 * buffer_.size());
    }
  }

 private:
  void read_up_to(std::size_t size) {
    if (is_last_) return;
    const std::size_t kept = buffer_.size();
    buffer_.resize(size);
    const std::size_t filled =
        kept + stream_.read(std::as_writable_bytes(std::span(buffer_)).subspan(kept));
    buffer_.resize(filled);
    is_last_ = filled < size;
  }

  files::InputStream stream_;
  std::string buffer_;
  bool is_last_ = false;
};

/// The places of the columns among the headings; empty unless these are the only columns.
std::vector<std::size_t> places_of(const ColumnNames& names,
                                   const std::vector<std::string_view>& headings) {
  return headings.size() == names.size() ? text::places_of(names, headings)
                                         : std::vector<std::size_t>();
}

/// "a, b and c"
std::string listed(const ColumnNames& names) {
  std::string list(names.front());
  for (std::size_t i = 1; i < names.size(); ++i)
    list.append(i + 1 < names.size() ? ", " : " and ").append(names[i]);
  return list;
}

/// Lines of CSV. Line ends are those of the first piece.
class CsvRows : public NumberRows::Source {
 public:
  CsvRows(FilePiece file, std::string name, NumberRowsFormat format)
      : file_(std::move(file)), name_(std::move(name)), format_(std::move(format)) {
    const std::string_view text = text::TextCursor::without_mark(file_.text());
    line_end_ = text::TextCursor::line_end_of(text);
    begin_piece(file_.text().size() - text.size(), 1);
    while (!csv_->next_line())
      if (!go_on()) throw InputError(name_ + ": is empty");
    read_heading();
  }

  [[nodiscard]] std::size_t names() const override { return names_; }

  bool next(NumberRow& row) override {
    while (!csv_->next_line())
      if (!go_on()) return false;
    const std::vector<std::string_view> fields = csv_->fields();
    csv_->require_count(fields.size(), row.size());
    NumberRow in_file;
    for (std::size_t i = 0; i < fields.size(); ++i) in_file[i] = csv_->finite_number(fields[i]);
    for (std::size_t k = 0; k < row.size(); ++k) row[k] = in_file[places_[k]];
    if (const std::string fault = format_.fault_of(names_, row); !fault.empty()) csv_->fail(fault);
    return true;
  }

 private:
  /// Takes the whole lines of the piece from `start` on.
  void begin_piece(std::size_t start, std::uint64_t first_line) {
    const std::string_view text = file_.text();
    used_ = text.size();
    if (!file_.is_last()) {
      const std::size_t last = text.rfind(line_end_);
      used_ = last == text.npos ? 0 : last + 1;
    }
    csv_.emplace(text.substr(start, used_ > start ? used_ - start : 0), name_, line_end_,
                 first_line);
    if (used_ == 0 && !text.empty())
      csv_->fail("is longer than " + std::to_string(most_kept) + " bytes");
  }

  /// Goes to the next piece; false at the end of the file.
  bool go_on() {
    const std::uint64_t line = csv_->line();
    if (file_.is_last()) return false;
    file_.advance(used_);
    begin_piece(0, line);
    return true;
  }

  void read_heading() {
    const std::vector<std::string_view> headings = csv_->fields();
    std::string expected;
    for (std::size_t i = 0; i < format_.sets.size() && places_.empty(); ++i) {
      places_ = places_of(format_.sets[i], headings);
      if (!places_.empty()) names_ = i;
      expected += (i > 0 ? "; or " : "") + listed(format_.sets[i]);
    }
    if (places_.empty()) csv_->fail("expected a heading with the columns " + expected);
  }

  FilePiece file_;
  std::string name_;
  NumberRowsFormat format_;
  char line_end_ = '\n';
  std::optional<text::CsvReader> csv_;
  /// The bytes of the piece that csv_ reads.
  std::size_t used_ = 0;
  std::size_t names_ = 0;
  /// Of the columns among those of the file.
  std::vector<std::size_t> places_;
};

/// Fails unless a row of an array has finite numbers and no fault.
void require_row(const NumberRow& row, std::uint64_t number, const std::string& name,
                 const NumberRowsFormat& format) {
  const bool is_finite = std::ranges::all_of(row, [](double x) { return std::isfinite(x); });
  const std::string fault = is_finite ? format.fault_of(0, row) : "expected finite numbers";
  if (!fault.empty()) throw InputError(name + ": row " + std::to_string(number) + ": " + fault);
}

/// The type of an array's numbers.
struct NumberType {
  std::size_t bytes = 0;
  std::endian order = std::endian::little;
};

/// nullopt unless the numbers have a type of floating point.
std::optional<NumberType> number_type_of(const std::string& type) {
  if (type.size() != 3 || (type[0] != '<' && type[0] != '>') || type[1] != 'f') return std::nullopt;
  const std::endian order = type[0] == '>' ? std::endian::big : std::endian::little;
  if (type[2] == '2' || type[2] == '4' || type[2] == '8')
    return NumberType{static_cast<std::size_t>(type[2] - '0'), order};
  return std::nullopt;
}

double number_at(const std::byte* at, const NumberType& type) {
  if (type.bytes == 8) return load<double>(at, type.order);
  if (type.bytes == 4) return load<float>(at, type.order);
  return widen_binary16(load<std::uint16_t>(at, type.order));
}

/// An array of shape N×6, row by row.
class ArrayRows : public NumberRows::Source {
 public:
  ArrayRows(FilePiece file, const image::NpyHeader& header, const NumberType& type,
            std::string name, NumberRowsFormat format)
      : file_(std::move(file)),
        type_(type),
        name_(std::move(name)),
        format_(std::move(format)),
        rows_(header.shape[0]) {
    file_.advance(header.size);
    if (const auto rest = file_.rest()) require_bytes(*rest);
  }

  bool next(NumberRow& row) override {
    const std::size_t size = row.size() * type_.bytes;
    if (file_.bytes().size() < at_ + size) {
      read_ += at_;
      file_.advance(std::exchange(at_, 0));
    }
    if (number_ == rows_ || file_.bytes().size() < size) {
      require_bytes(read_ + file_.bytes().size());
      return false;
    }
    for (std::size_t k = 0; k < row.size(); ++k)
      row[k] = number_at(&file_.bytes()[at_ + k * type_.bytes], type_);
    at_ += size;
    require_row(row, number_++, name_, format_);
    return true;
  }

 private:
  /// Fails unless the array has so many bytes.
  void require_bytes(std::uint64_t found) const {
    if (found == rows_ * NumberRow{}.size() * type_.bytes) return;
    throw InputError(name_ + ": truncated or overlong NPY file: expected " + std::to_string(rows_) +
                     "×6 values of " + text::counted(type_.bytes, "byte") + ", found " +
                     text::counted(found, "byte"));
  }

  FilePiece file_;
  NumberType type_;
  std::string name_;
  NumberRowsFormat format_;
  std::uint64_t rows_;
  /// The number of the next row, and its place in the piece.
  std::uint64_t number_ = 0;
  std::size_t at_ = 0;
  /// The bytes of the array before the piece.
  std::uint64_t read_ = 0;
};

/// Any other array, which must have the shape N×6: the rows of an image in memory.
class ImageRows : public NumberRows::Source {
 public:
  ImageRows(files::ByteView bytes, std::string name, NumberRowsFormat format)
      : name_(std::move(name)), format_(std::move(format)) {
    channels_ = image::channels_of_npy(bytes, "rows", size_, name_);
    const bool is_real = std::visit(
        [](const auto& values) {
          return std::is_floating_point_v<typename std::decay_t<decltype(values)>::value_type>;
        },
        channels_.front().values);
    if (!is_real || channels_.size() != 1 || size_.width != NumberRow{}.size())
      throw InputError(name_ + ": expected an array of shape N×6, of float64 or float32");
  }

  bool next(NumberRow& row) override {
    if (number_ == size_.height) return false;
    std::visit(
        [&](const auto& values) {
          for (std::size_t k = 0; k < row.size(); ++k)
            row[k] = static_cast<double>(values[number_ * row.size() + k]);
        },
        channels_.front().values);
    require_row(row, number_++, name_, format_);
    return true;
  }

 private:
  std::string name_;
  NumberRowsFormat format_;
  image::ImageSize size_;
  std::vector<ImageChannel> channels_;
  std::size_t number_ = 0;
};

std::unique_ptr<NumberRows::Source> source_of(const std::string& file, NumberRowsFormat format) {
  FilePiece piece(file);
  const std::string name = text::printable(file);
  if (!piece.text().starts_with("\x93NUMPY"))
    return std::make_unique<CsvRows>(std::move(piece), name, std::move(format));
  const image::NpyHeader header = image::npy_header_of(piece.bytes(), name);
  const auto type = number_type_of(header.type);
  const bool is_matrix = header.shape.size() == 2 && header.shape[1] == NumberRow{}.size();
  if (type && is_matrix && !header.fortran_order)
    return std::make_unique<ArrayRows>(std::move(piece), header, *type, name, std::move(format));
  piece.take_all(name);
  return std::make_unique<ImageRows>(piece.bytes(), name, std::move(format));
}

}  // namespace

NumberRows::NumberRows(const std::string& file, NumberRowsFormat format)
    : no_row_(text::printable(file) + ": has a heading and no " + format.row) {
  source_ = source_of(file, std::move(format));
}
NumberRows::NumberRows(NumberRows&&) noexcept = default;
NumberRows& NumberRows::operator=(NumberRows&&) noexcept = default;
NumberRows::~NumberRows() = default;

std::size_t NumberRows::names() const {
  return source_->names();
}

bool NumberRows::next(NumberRow& row) {
  if (source_->next(row)) {
    has_rows_ = true;
    return true;
  }
  if (!has_rows_) throw InputError(no_row_);
  return false;
}

}  // namespace fathom::app
