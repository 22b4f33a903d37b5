#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "fathom/image/sample_pattern.h"
#include "fathom/pipeline/geometry/subpixel_grid.h"

namespace fathom::pipeline {

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
