#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fathom/area/coverage.h"
#include "fathom/geometry/pixel_box.h"

namespace fathom::area {

/// A triangle that may cover a part of the pixels of a box.
struct BoxedTriangle {
  std::uint32_t number = 0;
  PixelBox box;
};

/// The triangles of a scene sorted into bands of rows of the image, in the order of their numbers,
/// without those that certainly cover nothing.
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

}  // namespace fathom::area
