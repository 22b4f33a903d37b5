#pragma once

#include <functional>

#include "fathom/area/coverage.h"
#include "fathom/area/image_cell.h"

namespace fathom::area {

/// A triangle that may cover a part of the pixels of a box.
struct BoxedTriangle {
  std::uint32_t number = 0;
  PixelBox box;
};

/// The triangles of a scene sorted into bands of rows of the image, those that certainly cover
/// nothing left out; in the order of their numbers.
class TriangleBands {
 public:
  static constexpr std::uint32_t rows_per_band = 8;

  explicit TriangleBands(const CoverageFrame& frame);

  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(bands_.size()); }
  struct Band {
    std::uint32_t first_row = 0, end_row = 0;
    std::span<const BoxedTriangle> triangles;
  };
  [[nodiscard]] Band operator[](std::uint32_t band) const;

 private:
  std::uint32_t height_;
  std::vector<std::vector<BoxedTriangle>> bands_;
};

/// What is asked about a pixel, with the triangles that may cover a part of it, in the order of
/// their numbers, at least one.
using VisitPixel = std::function<void(std::uint32_t column, std::uint32_t row,
                                      std::span<const SurfaceRegion* const> triangles)>;

/// Visits every pixel that a triangle may cover a part of, different ones at the same time.
/// `part_done` is called, where set, after each band of the image (TriangleBands::count()), from
/// any thread.
void for_each_pixel(const CoverageFrame& frame, const VisitPixel& visit,
                    const std::function<void()>& part_done = {});

/// Channel A of the whole image: width × height values, row by row, 0 where nothing is covered.
/// Every pixel is computed by itself. Returns how decisions were made.
TierCounts write_coverage(const CoverageFrame& frame, float* values,
                          const std::function<void()>& part_done = {});

}  // namespace fathom::area
