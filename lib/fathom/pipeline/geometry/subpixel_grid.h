#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "fathom/image/sample_pattern.h"
#include "fathom/pipeline/scan/arithmetic.h"
#include "fathom/pipeline/scan/pixels.h"

/// Triangles on a fixed-point grid, as graphics processors have them: corners are snapped to 2⁰ …
/// 2¹⁶ positions per pixel, and everything after that is decided in integers, without an error.
/// Triangles that share an edge share its two snapped ends, so each sample on the edge belongs to
/// exactly one of them, at every number of bits.
namespace fathom::pipeline {

inline constexpr int most_subpixel_bits = 16;
/// Positions inside a pixel are kept in units of 2⁻¹⁷, so that centres lie on the grid of every
/// number of bits.
inline constexpr int grid_bits = most_subpixel_bits + 1;
inline constexpr std::int64_t grid_one = std::int64_t{1} << grid_bits;

/// A position on the grid: pixels times 2¹⁷.
struct GridPoint {
  std::int64_t x = 0, y = 0;
  friend bool operator==(const GridPoint&, const GridPoint&) = default;
};

/// The nearest of 2^bits positions per pixel, ties to even, as a grid coordinate.
/// |x| ≤ 2³¹ in pixels, 0 ≤ bits ≤ 16. Exact.
std::int64_t snap(double x, int bits);
inline GridPoint snap(double x, double y, int bits) {
  return {snap(x, bits), snap(y, bits)};
}

/// The centre of a pixel, from which `dx`, `dy` move the sample in grid units.
constexpr GridPoint sample_of(const Pixel& p, std::int64_t dx = 0, std::int64_t dy = 0) {
  return {p.x * grid_one + grid_one / 2 + dx, p.y * grid_one + grid_one / 2 + dy};
}

/// A triangle of grid points with its edge functions; the inside of every edge is positive.
class GridTriangle {
 public:
  /// nullopt if the area is zero.
  static std::optional<GridTriangle> of(const std::array<GridPoint, 3>& corners);

  /// e_A, e_B, e_C at a sample; they add up to twice_area().
  [[nodiscard]] std::array<Int128, 3> edges_at(const GridPoint& sample) const;
  [[nodiscard]] bool covers(const GridPoint& sample) const;
  [[nodiscard]] Int128 twice_area() const { return twice_area_; }
  /// Whether the corners run counter-clockwise as seen, with y down.
  [[nodiscard]] bool counter_clockwise() const { return !turned_; }

  /// The pixels of a row whose samples, moved by (dx, dy) from the centre, are covered.
  [[nodiscard]] Span span_of_row(std::int64_t y, const PixelWindow& window, std::int64_t dx = 0,
                                 std::int64_t dy = 0) const;
  /// The pixels in which any point can be covered.
  [[nodiscard]] PixelWindow bounding_box() const;

  /// A square block of pixels against the edges: none of its samples (centres moved by less than
  /// half a pixel) is covered, all are, or some may be.
  enum class BlockCoverage { none, some, all };
  [[nodiscard]] BlockCoverage test_block(const Pixel& corner, std::int64_t size) const;

 private:
  struct Edge {
    Int128 a, b, c;
    bool left_or_top;
    [[nodiscard]] Int128 at(const GridPoint& p) const { return a * p.x + b * p.y + c; }
  };
  GridTriangle() = default;

  std::array<Edge, 3> edges_{};
  Int128 twice_area_ = 0;
  bool turned_ = false;
  GridPoint least_{}, greatest_{};
};

/// Where a pixel is sampled: offsets from its centre in grid units, at most half a pixel.
class GridSamples {
 public:
  /// One sample at the centre.
  static GridSamples centre();
  /// Rounded down to the grid, which holds all patterns except the jittered ones exactly.
  static GridSamples of(SamplePattern pattern);
  /// n × n samples at (i + ½)/n, rounded down to the grid if n is not a power of two.
  static GridSamples regular(int n);
  /// One sample, at place k of Halton's sequence for the bases 2 and 3 ([Hal60]).
  static GridSamples halton(int k);

  [[nodiscard]] std::size_t size() const {
    return jittered_ ? jittered_->count() : offsets_.size();
  }
  [[nodiscard]] GridPoint at(const Pixel& pixel, std::size_t sample) const {
    return jittered_ ? in_cell(pixel, sample) : offsets_[sample];
  }

 private:
  [[nodiscard]] GridPoint in_cell(const Pixel& pixel, std::size_t sample) const;

  std::vector<GridPoint> offsets_;
  std::optional<SamplePattern> jittered_;  ///< its samples differ from pixel to pixel
};

}  // namespace fathom::pipeline
