#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "fathom/camera/lens.h"
#include "fathom/geometry/frames.h"
#include "fathom/lens/angle_polynomial.h"
#include "fathom/lens/exact_direction.h"
#include "fathom/lens/sample_plane.h"

namespace fathom::lens {

/// The k of d = (x_d, y_d, 1 + k·r²), of a lens by division or of the stereographic fisheye.
double division_term(const Lens& lens);

/// The same direction, times a power of two that brings its greatest component between ½ and 1:
/// binary64 intervals contain it closely whatever its length is.
ExactVector3 scaled_to_one(ExactVector3 direction);

/// A lens in front of a camera: which direction each sample of its image sees (specification,
/// section 2).
///
/// Threads  immutable; any number of threads may ask at once.
class Preimages {
 public:
  /// Of a valid perspective projection and a valid lens. Finds the disc on which the lens is used,
  /// which may take milliseconds.
  Preimages(const Projection& projection, const Lens& lens);

  /// The direction that the sample (u, v) sees; nullopt if it sees none. u and v in pixels from
  /// the top left corner of the image: the centre of the top left pixel is (½, ½), whatever the
  /// camera's pixel_centre is.
  /// Fails    UsageError of a table, which has directions of pixels only: of_pixel() finds them.
  [[nodiscard]] std::optional<ExactDirection> of(const Dyadic& u, const Dyadic& v) const;
  [[nodiscard]] std::optional<ExactDirection> of(const ImagePoint& sample) const {
    return of(sample.u, sample.v);
  }

  /// The direction that a pixel's sample sees, its centre; nullopt if it sees none.
  /// Needs    of a table, a pixel that it has.
  [[nodiscard]] std::optional<ExactDirection> of_pixel(std::uint32_t column,
                                                       std::uint32_t row) const;

  [[nodiscard]] const Lens& lens() const { return lens_; }

  /// The stage S and its disc, of a lens that has one; nullptr of other lenses. A sample sees by
  /// the m in the disc with S(m) = y, where y is the point that plane_map() makes of the sample.
  [[nodiscard]] const PolynomialStage* stage() const {
    return has_stage(lens_.model) || has_stage_before_root(lens_) ? &stage_ : nullptr;
  }
  /// (m, 1) with that m, of a sample as of() takes it; nullopt if there is none in the disc. It is
  /// the direction itself of a model of the plane; of a fisheye, |m| is the angle to the z axis.
  /// Needs    a lens that has a stage.
  [[nodiscard]] std::optional<ExactDirection> before_stage(const Dyadic& u, const Dyadic& v) const;
  /// The rows of the matrix that takes (u, v, 1) to a positive multiple of (y, 1), exactly; where
  /// the third component is not positive, the sample sees nothing.
  [[nodiscard]] std::array<ExactVector3, 3> plane_map() const;

  /// The angle of FTHETA; nullptr of other models.
  [[nodiscard]] const AnglePolynomial* angle() const { return angle_ ? &*angle_ : nullptr; }

  /// An interval that contains cos(max_radius), of a model whose max_radius is an angle that leaves
  /// rays out.
  [[nodiscard]] std::optional<Interval> cosine_of_end() const;

  /// Q: rays of a model with a stage have |m|² ≤ Q, and max_radius may narrow that. +∞ if there is
  /// no bound, or no stage.
  [[nodiscard]] double disc() const { return stage_.disc; }

 private:
  [[nodiscard]] std::optional<PlaneDirection> find_before_stage(const Dyadic& u,
                                                                const Dyadic& v) const;
  [[nodiscard]] ExactDirection lifted(PlaneDirection m) const;
  [[nodiscard]] std::optional<ExactDirection> by_root(const DistortedPoint& y) const;
  [[nodiscard]] std::optional<ExactDirection> by_root_before_stage(const Dyadic& u,
                                                                   const Dyadic& v) const;
  [[nodiscard]] std::optional<ExactDirection> by_field_of_view(const DistortedPoint& y) const;
  [[nodiscard]] std::optional<ExactDirection> by_angle(const DistortedPoint& y) const;
  [[nodiscard]] std::optional<ExactDirection> by_turns(const DistortedPoint& sample) const;

  SamplePlane plane_;
  Lens lens_;
  std::optional<Tilt> tilt_;
  PolynomialStage stage_;
  std::optional<AnyRootFormula<Dyadic>> roots_;
  std::optional<AnglePolynomial> angle_;
};

}  // namespace fathom::lens
