#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "fathom/area/coverage.h"
#include "fathom/area/image_cell.h"
#include "fathom/geometry/frames.h"
#include "fathom/image/row_share.h"
#include "fathom/scene/triangle_source.h"

namespace fathom::area {

/// Finds triangles with the same three corners, in the same cyclic order, as an earlier triangle.
/// Equal triangles coincide and are culled alike, so only the triangle with the lowest number is
/// ever visible, and the others change no area.
class EqualTriangles {
 public:
  explicit EqualTriangles(const TriangleSource& triangles) : triangles_(triangles) {}

  /// Whether no triangle of an earlier call has the corners of this triangle.
  /// Exact    corners are compared as exact numbers.
  bool is_first(std::uint32_t number);

 private:
  /// The first triangle with some corners, by their hash.
  struct First {
    std::size_t hash;
    std::optional<std::uint32_t> number;
  };

  void grow();
  [[nodiscard]] std::size_t place_of(std::size_t hash) const;

  const TriangleSource& triangles_;
  /// An open table: in one piece, so that it is freed at once. Its size is a power of two.
  std::vector<First> table_ = std::vector<First>(16);
  std::size_t count_ = 0;
};

/// A triangle that may cover a part of the pixels of a box.
struct BoxedTriangle {
  std::uint32_t number = 0;
  PixelBox box;
};

/// The triangles of a scene sorted into bands of rows of the image, in the order of their numbers,
/// without triangles that certainly cover nothing.
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

/// Called for a pixel with the triangles that may cover a part of it, in the order of their
/// numbers; at least one triangle.
using VisitPixel = std::function<void(std::uint32_t column, std::uint32_t row,
                                      std::span<const SurfaceRegion* const> triangles)>;

/// Visits every pixel, in a share of the rows, of which a triangle may cover a part; different
/// pixels at the same time. `part_done`, if set, is called after each band of the share, from any
/// thread.
void for_each_pixel(const CoverageFrame& frame, const VisitPixel& visit,
                    const std::function<void()>& part_done = {}, const RowShare& share = {});

/// Channel A of the whole image: width × height values, row by row from the top left, 0 where
/// nothing is covered. Every pixel is computed by itself. `part_done` as above. Returns how
/// decisions were made.
TierCounts write_coverage(const CoverageFrame& frame, float* values,
                          const std::function<void()>& part_done = {});

}  // namespace fathom::area
