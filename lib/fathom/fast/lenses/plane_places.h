#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "fathom/camera/projection.h"
#include "fathom/fast/bins/bins.h"
#include "fathom/fast/bins/tile_shape.h"
#include "fathom/fast/lenses/stage_lanes.h"
#include "fathom/fast/lenses/view_axes.h"
#include "fathom/lens/preimages.h"
#include "fathom/numeric/standard_arithmetic.h"

// What the certificates of places compute with.
namespace fathom::fast::place_arithmetic {

inline constexpr double u = unit_roundoff<double>;
using lens::bounds::up;

// Constants of the bounds of places; their derivations are where they are used.
// validation/proofs/lenses/ proves each, in the file that is named beside it.

/// CertifiedPlane: of the terms of a component (lens_plane), and of the quotient where the sensor
/// is tilted (lens_plane_quotient).
inline constexpr double plane_rounding = 6 * u;
inline constexpr double plane_quotient = u;
/// The ball in which a certificate finds a sample: its radius is so much of the greatest coordinate
/// of the places around it. Places are in the disc with so much of |m|² to spare (lens_disc).
inline constexpr double ball_share = 0x1p-28;
inline constexpr double disc_room = 0x1p-20;
/// So many errors of the plane lie between blocks that are beyond the disc and the disc
/// (lens_beyond).
inline constexpr double beyond_room = 8;
/// The direction of a fisheye's m, where |m|² is less than the second (lens_cosine, lens_sine).
inline constexpr double lift_rounding = 68 * u;
inline constexpr double end_of_series = 10;
/// Sines and cosines of the angles of a panorama (lens_turn_cosine, lens_turn_sine).
inline constexpr double turn_rounding = 4 * u;
/// 1 + k·r²: of x² + y², and of both terms (lens_bend).
inline constexpr double square_rounding = 4 * u;
inline constexpr double bend_rounding = 2 * u;
/// The quotient of two components: of the greater coordinate (lens_place). Places that err by more
/// of it than the second are found from the exact direction (lens_range).
inline constexpr double place_rounding = u;
inline constexpr double loose_error = 0x1p-30;
/// The side of max_radius on which a direction lies: of the error of the components, and of the
/// length and 1 (lens_angle).
inline constexpr double angle_of_error = 3;
inline constexpr double angle_rounding = 8 * u;

/// The place of a sample without a ray.
inline constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

inline double greatest_size(double a, double b) {
  return std::max(std::abs(a), std::abs(b));
}

}  // namespace fathom::fast::place_arithmetic

namespace fathom::fast {

/// The map from samples to y in binary64, with a bound on the errors of its components; the error
/// is +∞ where no bound is known.
class CertifiedPlane {
 public:
  /// Without a bound.
  CertifiedPlane() = default;
  CertifiedPlane(const lens::Preimages& preimages, const Projection& projection,
                 std::uint32_t width, std::uint32_t height);

  [[nodiscard]] const PlaneForLanes& lanes() const { return lanes_; }
  [[nodiscard]] double error() const { return error_; }
  [[nodiscard]] std::array<double, 2> at(double column, double row) const {
    const double x = column - lanes_.centre_u, y = row - lanes_.centre_v;
    const auto value = [&](const std::array<double, 3>& g) { return g[0] * x + g[1] * y + g[2]; };
    const double z = lanes_.is_affine ? 1 : value(lanes_.g[2]);
    return {value(lanes_.g[0]) / z, value(lanes_.g[1]) / z};
  }

 private:
  PlaneForLanes lanes_;
  double error_ = std::numeric_limits<double>::infinity();
};

/// Where the places of a tile are written, by TileShape::index().
struct FoundPlaces {
  std::span<double> x, y;
};

/// Finds, for the samples of an image, the points m that the stage of a lens takes to them: in
/// binary64, each with a proved bound. Of a lens of the plane they are the places of the samples;
/// of a fisheye, |m| is the angle of a ray.
///
/// Threads  any number of threads may find tiles at once.
class PlanePlaces {
 public:
  /// Of a model that has a stage. `preimages` and `grid` must outlive it.
  PlanePlaces(const lens::Preimages& preimages, const Projection& projection, const TileGrid& grid);

  struct OfTile {
    /// |x − exact x| and |y − exact y| are at most that.
    double error;
    /// Around the samples that have a ray.
    PlaneBox box;
  };
  /// Writes the points of a tile; both coordinates are NaN where a sample has no ray.
  OfTile find(std::uint32_t tile, FoundPlaces places) const;

 private:
  const lens::Preimages& preimages_;
  const TileGrid& grid_;
  CertifiedPlane plane_;
  /// |y| of a sample that has a ray is at most that.
  double greatest_image_;
};

}  // namespace fathom::fast
