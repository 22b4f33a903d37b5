#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "fathom/fast/bins.h"
#include "fathom/fast/certified_writer.h"
#include "fathom/fast/depth_range.h"
#include "fathom/fast/setup.h"
#include "fathom/triangle/channels.h"
#include "fathom/triangle/referee.h"

namespace fathom::fast {

/// Column and row of the image.
struct DoubtfulPixel {
  std::uint32_t column, row;
};

/// The nearest surface so far at the samples of a small part of the image, whatever the order in
/// which triangles are drawn.
class Tile {
 public:
  static constexpr std::uint32_t size = 64;
  static constexpr std::uint32_t block = 8;
  static constexpr std::size_t blocks = (size / block) * (size / block);

  /// What a tile works with, one for each thread.
  struct Context {
    triangle::Referee& referee;
    RenderStatistics& statistics;
    const DepthRange& range;
    bool perspective;
    const FastSwitches& switches;
    /// Gets the pixels at which a bound does not settle a decision, where not null.
    std::vector<DoubtfulPixel>* doubtful = nullptr;

    void note_doubt(std::uint32_t column, std::uint32_t row) const {
      if (doubtful) doubtful->push_back({column, row});
    }
  };

  /// Empties the tile and moves it to an area of at most size × size pixels, its first row and
  /// column multiples of size.
  void start(const PixelBox& area);
  [[nodiscard]] const PixelBox& area() const { return area_; }

  /// Draws triangles of one object (their numbers in the scene) at the samples of the area.
  void draw(const ImageObject& object, std::span<const std::uint32_t> numbers,
            const Context& context);

  /// Writes the visible surfaces; the first fault in row order ends it. `depths`: where not null,
  /// the values of channel Z, the only channel, written here for the whole area.
  std::optional<triangle::EncodingFault> resolve(CertifiedWriter& certified, float* depths,
                                                 std::uint32_t image_width,
                                                 const Context& context) const;

  // For the vector code.
  /// Index of a sample by its column and row within the tile.
  static std::size_t index(std::uint32_t column, std::uint32_t row) {
    return static_cast<std::size_t>(row) * size + column;
  }
  /// The surface at a sample: its q, −∞ where there is none, and its tag.
  double* q() { return q_.data(); }
  std::uint64_t* tags() { return tags_.data(); }
  [[nodiscard]] const double* q() const { return q_.data(); }
  [[nodiscard]] const std::uint64_t* tags() const { return tags_.data(); }
  /// For each block a number that is not greater than the exact q at any of its samples.
  double* farthest() { return farthest_.data(); }
  /// How often a block was drawn into since its number above was computed.
  std::uint8_t* draws() { return draws_.data(); }
  /// Settles one sample exactly, as far as the bounds do not. Column and row of the image.
  void settle(const TriangleSetup& setup, bool test_range, std::uint32_t column, std::uint32_t row,
              const Context& context);
  /// Sets up a triangle from exact numbers, for the samples of `box`.
  static void set_up_exactly(std::uint32_t number, const PixelBox& box, const Context& context,
                             SetupBatch& batch);

 private:
  /// Of the surface at a sample: the bound of the error of its q, and its number.
  [[nodiscard]] double error_at(std::size_t i) const { return std::bit_cast<double>(tags_[i]); }
  [[nodiscard]] std::uint32_t number_at(std::size_t i) const {
    return static_cast<std::uint32_t>(tags_[i]);
  }

  /// Vectors may reach beyond the last row.
  static constexpr std::size_t room = size * size + block;
  PixelBox area_;
  alignas(64) std::array<double, room> q_;
  alignas(64) std::array<std::uint64_t, room> tags_;
  alignas(64) std::array<double, blocks> farthest_;
  std::array<std::uint8_t, blocks> draws_;
};

/// Tag of a surface: number in the lower half, and as a whole, read as a binary64 number, a bound
/// of the error of its q: upper_half() rounds it up, so that the lower half can only add to it. A
/// bound of +∞ becomes NaN, for which no comparison holds: nothing is certain.
inline std::uint64_t surface_tag(std::uint32_t number, double q_error) {
  return upper_half(q_error) << 32 | number;
}
/// No surface: an error of next to nothing.
inline constexpr std::uint64_t no_surface_tag = std::uint64_t{0x00100000} << 32 | no_surface;

}  // namespace fathom::fast
