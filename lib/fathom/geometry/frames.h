#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "fathom/numeric/dyadic.h"

/// A type for each frame of the specification (sections 2 to 4), so that a mix-up does not compile.
/// All coordinates here are exact.
namespace fathom {

/// A point of a mesh in its file's frame and unit, as read: its binary64 numbers are the truth.
struct MeshPoint {
  double x = 0, y = 0, z = 0;
  friend bool operator==(const MeshPoint&, const MeshPoint&) = default;
};

/// A point in the world, in scene units.
struct WorldPoint {
  Dyadic x, y, z;
};

/// A point in the camera frame: x right, y down, z forward; scene units.
struct CameraPoint {
  Dyadic x, y, z;
};

/// A homogeneous image point: its image is (U/W, V/W) in pixels, u right, v down, where W > 0.
struct HomogeneousImagePoint {
  Dyadic U, V, W;
};

/// A sample position in the image in pixels, (0, 0) its top left corner; exact binary fractions.
struct ImagePoint {
  double u = 0, v = 0;
};

/// An exact affine map, 3×4, applied to column vectors: linear part | translation.
template <class Target, class Source>
struct ExactAffine {
  std::array<std::array<Dyadic, 4>, 3> rows{
      {{1.0, 0.0, 0.0, 0.0}, {0.0, 1.0, 0.0, 0.0}, {0.0, 0.0, 1.0, 0.0}}};

  template <class Point>
  [[nodiscard]] Target apply(const Point& p) const {
    const Dyadic x(p.x), y(p.y), z(p.z);
    const auto row = [&](int i) {
      return rows[i][0] * x + rows[i][1] * y + rows[i][2] * z + rows[i][3];
    };
    return {row(0), row(1), row(2)};
  }
  Target operator()(const Source& p) const { return apply(p); }
};

/// The map that applies `second`, then `first`: their product, exactly.
template <class Target, class Source>
ExactAffine<Target, Source> compose(const ExactAffine<Target, Source>& first,
                                    const ExactAffine<Target, Source>& second) {
  ExactAffine<Target, Source> result;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      Dyadic sum = k == 3 ? first.rows[i][3] : Dyadic();
      for (std::size_t j = 0; j < 3; ++j) sum += first.rows[i][j] * second.rows[j][k];
      result.rows[i][k] = std::move(sum);
    }
  }
  return result;
}

using WorldFromMesh = ExactAffine<WorldPoint, MeshPoint>;

/// A box of pixels, from its first to its last column and row; first > last where it is empty.
/// Column 0 is at the left, row 0 at the top.
struct PixelBox {
  std::uint32_t first_column = 1, last_column = 0;
  std::uint32_t first_row = 1, last_row = 0;
  [[nodiscard]] bool contains(std::uint32_t column, std::uint32_t row) const {
    return first_column <= column && column <= last_column && first_row <= row && row <= last_row;
  }
  [[nodiscard]] bool is_empty() const { return first_column > last_column || first_row > last_row; }
};

}  // namespace fathom
