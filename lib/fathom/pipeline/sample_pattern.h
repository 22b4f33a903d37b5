#pragma once

#include <cstddef>
#include <vector>

#include "fathom/pipeline/subpixel_grid.h"

namespace fathom::pipeline {

/// Where in a pixel it is sampled: moves from its centre in grid units, at most half a pixel.
class SamplePattern {
 public:
  /// One sample at the centre.
  static SamplePattern centre();
  /// The standard positions of 1, 2, 4, 8 or 16 samples, on sixteenths of a pixel; 4 is the rotated
  /// grid (−2, −6), (6, −2), (−6, 2), (2, 6).
  /// Source   Direct3D 11, D3D11_STANDARD_MULTISAMPLE_QUALITY_LEVELS; Vulkan 1.3, 25.4.
  static SamplePattern standard(int samples);
  /// n × n samples at (i + ½)/n.
  static SamplePattern grid(int n);
  /// In each pixel its own random positions, one in each cell of a grid where the number is a
  /// square; the same in every run.
  static SamplePattern jittered(int samples);
  /// One sample, at the place k of Halton's sequence for the bases 2 and 3.
  static SamplePattern halton(int k);

  [[nodiscard]] std::size_t size() const { return offsets_.size(); }
  [[nodiscard]] GridPoint at(const Pixel& pixel, std::size_t sample) const;

 private:
  std::vector<GridPoint> offsets_;
  int cells_ = 0;  ///< a side of the jitter's grid; 0: no jitter
};

}  // namespace fathom::pipeline
