#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "fathom/lens/exact_direction.h"
#include "fathom/numeric/exact_polynomial.h"
#include "fathom/numeric/real.h"
#include "fathom/rendering/channel_values.h"
#include "fathom/triangle/projected_triangle.h"
#include "fathom/triangle/stored_quantity.h"

/// Values of a surface along the ray of a sample, where a camera bends rays: quotients of forms of
/// the ray's direction, as numbers that round correctly. A direction need not be rational:
/// roundings are decided by enclosures, and by the sign of a form where a value may lie where
/// rounding steps.
namespace fathom::triangle {

/// The numerators of the world point that a ray sees: each is interpolated from the corners'.
std::array<LinearForm, 3> position_forms(const ProjectedTriangle& triangle);

/// numerator(d) / denominator(d).
/// Needs    denominator(d) > 0.
/// Exact    rational() knows the value where rounding to binary32, to binary64 or to an integer
///          steps there.
Real quotient_at(const lens::ExactDirection& d, const LinearForm& numerator,
                 const LinearForm& denominator);

/// quotient_at(), rounded to binary32: in binary64 where its bounds settle that.
float binary32_at(const lens::ExactDirection& d, const LinearForm& numerator,
                  const LinearForm& denominator);

/// Intervals that contain the direction of a ray, as ExactDirection::box().
using RayBox = std::array<Interval, 3>;

/// numerator(d) / denominator(d), rounded to binary32, if binary64 settles that for every ray of
/// the box.
std::optional<float> binary32_in(const RayBox& box, const LinearForm& numerator,
                                 const LinearForm& denominator);
/// The ray distance volume·|d| / weight(d), likewise.
std::optional<float> distance_in(const RayBox& box, const Dyadic& volume, const LinearForm& weight);

/// The quotient of two squares, or sums of squares.
/// Exact    rational() knows the value where rounding of its square root steps there, too.
Real quotient_at(const lens::ExactDirection& d, const QuadraticForm& numerator,
                 const QuadraticForm& denominator);

/// A visible triangle of a camera that bends rays, prepared for many of its pixels: P and bary,
/// distance and Z in binary32 or as codes, as far as binary64 settles them.
class RaySurface {
 public:
  /// The requested channels that it writes; Z if the caller sets `depth`.
  struct Wanted {
    explicit Wanted(const rendering::ChannelValues& values)
        : position(values.position[0] != nullptr),
          barycentric(values.barycentric[0] != nullptr),
          distance(values.distance.binary32 != nullptr || values.distance.codes != nullptr) {}
    [[nodiscard]] bool any() const { return position || barycentric || distance || depth; }

    bool position, barycentric, distance, depth = false;
  };

  RaySurface(const ProjectedTriangle& triangle, const Wanted& wanted);

  /// Writes them at a pixel whose ray lies in the box. False where one of them is not settled: the
  /// pixel then has to be written from exact numbers.
  [[nodiscard]] bool write(std::size_t pixel, const RayBox& box,
                           const rendering::ChannelValues& values, const CodeFactor& codes) const;

 private:
  Wanted wanted_;
  std::array<LinearForm, 3> position_;
  std::array<LinearForm, 2> barycentric_;
  LinearForm depth_, weight_;
  Dyadic volume_;
};

}  // namespace fathom::triangle
