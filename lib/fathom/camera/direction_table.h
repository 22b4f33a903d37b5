#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "fathom/files/source.h"

namespace fathom {

/// The directions that the pixels of an image see, one for each pixel: a camera as numbers, of a
/// model that Fathom does not have or of a measurement (specification, section 2).
///
/// Frame    camera: x right, y down, z forward. The length of a direction means nothing.
/// Exact    every number is the real number that it denotes.
/// Threads  immutable; cameras share a table by a pointer.
class DirectionTable {
 public:
  using Direction = std::array<double, 3>;

  /// height × width × 3 numbers, row by row from the top. `source` is the file that they are from;
  /// its path begins messages.
  /// Fails    InputError for another count of numbers, and for an infinite number.
  DirectionTable(std::uint32_t width, std::uint32_t height, std::vector<double> numbers,
                 Source source = {});
  /// A table that is only named, as the header of a map names the table of its camera. A camera
  /// with it is not valid.
  static DirectionTable unread(Source source);

  [[nodiscard]] bool is_read() const { return width_ != 0; }
  [[nodiscard]] std::uint32_t width() const { return width_; }
  [[nodiscard]] std::uint32_t height() const { return height_; }
  [[nodiscard]] std::span<const double> numbers() const { return numbers_; }
  /// The file that the table is from; without a path if it is from no file.
  [[nodiscard]] const Source& source() const { return source_; }

  /// The direction of a pixel that the image has; nullopt if it has no ray: its direction is 0, 0,
  /// 0 or has a NaN.
  [[nodiscard]] std::optional<Direction> at(std::uint32_t column, std::uint32_t row) const;
  [[nodiscard]] std::uint64_t pixels_without_ray() const;

  /// SHA-256, as 64 hexadecimal digits: the hash of the source or, without a source, of the numbers
  /// as little-endian binary64. Empty for a table that is only named, without a hash.
  [[nodiscard]] std::string sha256() const;

  /// Whether both have the same size and the same bits, or are not read and have the same names.
  friend bool operator==(const DirectionTable& a, const DirectionTable& b);

 private:
  explicit DirectionTable(Source source) : source_(std::move(source)) {}

  std::uint32_t width_ = 0, height_ = 0;
  std::vector<double> numbers_;
  Source source_;
};

}  // namespace fathom
