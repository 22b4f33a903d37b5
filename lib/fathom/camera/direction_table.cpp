#include "fathom/camera/direction_table.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "fathom/failures/errors.h"
#include "fathom/files/byte_order.h"
#include "fathom/files/sha256.h"

namespace fathom {
namespace {

bool is_ray(const DirectionTable::Direction& d) {
  const auto is_nan = [](double x) { return std::isnan(x); };
  return std::ranges::none_of(d, is_nan) && d != DirectionTable::Direction{};
}

[[noreturn]] void fail(const Source& source, const std::string& fault) {
  throw InputError((source.path.empty() ? "directions" : source.path) + ": " + fault);
}

}  // namespace

DirectionTable::DirectionTable(std::uint32_t width, std::uint32_t height,
                               std::vector<double> numbers, Source source)
    : width_(width), height_(height), numbers_(std::move(numbers)), source_(std::move(source)) {
  const std::uint64_t pixels = std::uint64_t{width} * height;
  if (numbers_.size() / 3 != pixels || numbers_.size() % 3 != 0) {
    fail(source_, "found " + std::to_string(numbers_.size()) + " numbers, expected 3 for each of " +
                      std::to_string(width) + "x" + std::to_string(height) + " pixels");
  }
  const auto infinite =
      std::ranges::find_if(numbers_, [](double number) { return std::isinf(number); });
  if (infinite == numbers_.end()) return;
  const auto pixel = static_cast<std::uint64_t>(infinite - numbers_.begin()) / 3;
  fail(source_, "the direction of the pixel in column " + std::to_string(pixel % width) + ", row " +
                    std::to_string(pixel / width) +
                    " has an infinite component, expected finite numbers, or 0,0,0 for no ray");
}

DirectionTable DirectionTable::unread(Source source) {
  return DirectionTable(std::move(source));
}

std::optional<DirectionTable::Direction> DirectionTable::at(std::uint32_t column,
                                                            std::uint32_t row) const {
  const double* const first = &numbers_[3 * (std::size_t{row} * width_ + column)];
  const Direction d{first[0], first[1], first[2]};
  return is_ray(d) ? std::optional(d) : std::nullopt;
}

std::uint64_t DirectionTable::pixels_without_ray() const {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < numbers_.size(); i += 3) {
    count += !is_ray({numbers_[i], numbers_[i + 1], numbers_[i + 2]});
  }
  return count;
}

std::string DirectionTable::sha256() const {
  if (!source_.sha256.empty() || !is_read()) return source_.sha256;
  std::vector<std::byte> bytes(numbers_.size() * sizeof(double));
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    store(&bytes[i * sizeof(double)], numbers_[i], std::endian::little);
  }
  return files::sha256(bytes);
}

bool operator==(const DirectionTable& a, const DirectionTable& b) {
  const auto have_same_bits = [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  };
  if (!a.is_read() && !b.is_read())
    return a.source_.path == b.source_.path && a.source_.sha256 == b.source_.sha256;
  return a.width_ == b.width_ && a.height_ == b.height_ &&
         std::ranges::equal(a.numbers_, b.numbers_, have_same_bits);
}

}  // namespace fathom
