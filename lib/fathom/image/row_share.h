#pragma once

#include <cstdint>

namespace fathom {

/// The rows of an image that one of several processes makes: bands of eight rows go round to them
/// in turn, so that each has some of everything that the image shows. By itself, one process has
/// all.
struct RowShare {
  static constexpr std::uint32_t rows_per_band = 8;

  std::uint32_t process = 0, processes = 1;

  [[nodiscard]] std::uint32_t process_of_band(std::uint32_t band) const { return band % processes; }
  [[nodiscard]] std::uint32_t process_of_row(std::uint32_t row) const {
    return process_of_band(row / rows_per_band);
  }
  [[nodiscard]] bool has_band(std::uint32_t band) const { return process_of_band(band) == process; }
  [[nodiscard]] bool has_row(std::uint32_t row) const { return process_of_row(row) == process; }
  /// The number of bands of this process, for an image of `rows` rows.
  [[nodiscard]] std::uint32_t bands(std::uint32_t rows) const {
    const std::uint32_t all = (rows + rows_per_band - 1) / rows_per_band;
    return all / processes + (process < all % processes ? 1 : 0);
  }
};

}  // namespace fathom
