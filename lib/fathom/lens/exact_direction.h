#pragma once

#include <array>
#include <optional>
#include <variant>

#include "fathom/lens/direction_words.h"
#include "fathom/lens/polynomial_stage.h"
#include "fathom/lens/root_direction.h"
#include "fathom/lens/sample_plane.h"
#include "fathom/lens/turn_direction.h"
#include "fathom/numeric/certified.h"
#include "fathom/numeric/dyadic.h"
#include "fathom/numeric/exact_polynomial.h"

namespace fathom::lens {

/// A direction with rational components: a ray of the pinhole, of the division model, of a table.
///
/// Exact    d = vector/scale, scale > 0. Signs are those of dyadic numbers.
class RationalDirection {
 public:
  explicit RationalDirection(ExactVector3 vector, Dyadic scale = 1.0);

  /// d, times a positive number.
  [[nodiscard]] const ExactVector3& vector() const { return vector_; }
  [[nodiscard]] Sign sign_of(const ExactVector3& form) const { return dot(form, vector_).sign(); }
  [[nodiscard]] Sign sign_of(const QuadraticForm& form) const { return form.at(vector_).sign(); }
  /// Encloses the components of d, each with a relative precision of about `bits`.
  [[nodiscard]] std::array<DyadicInterval, 3> enclosure(long bits) const;
  /// d times a positive number, in double-words.
  [[nodiscard]] std::optional<DirectionWords> words() const { return words_of(vector_); }
  /// Intervals that contain the components of d.
  [[nodiscard]] const std::array<Interval, 3>& box() const { return box_; }

 private:
  ExactVector3 vector_;
  Dyadic scale_;
  std::array<Interval, 3> box_;
};

/// The preimage m of a point under a stage, as the direction (m, 1). |m|² is the root of a
/// polynomial (elimination.h), and a form at the direction is the value of another polynomial
/// there.
///
/// Exact    signs are found in intervals of more and more bits. A form that 128 bits do not settle
///          is 0 if its polynomial is, or if it is known to be smaller than such a value can be
///          without being 0 (zero_bound_bits()).
class PolynomialDirection {
 public:
  /// The preimage in the disc of y ≠ 0; nullopt if there is none. `stage` must outlive it.
  static std::optional<PolynomialDirection> find(const PolynomialStage& stage,
                                                 const DistortedPoint& y);

  [[nodiscard]] Sign sign_of(const ExactVector3& form) const;
  [[nodiscard]] Sign sign_of(const QuadraticForm& form) const;
  /// Encloses (m, 1) with a relative precision of about `bits`; m relative to |m|.
  [[nodiscard]] std::array<DyadicInterval, 3> enclosure(long bits) const;
  /// (m, 1) times a positive number, in double-words; nullopt if their bounds are too wide.
  [[nodiscard]] std::optional<DirectionWords> words() const;
  /// Binary64 intervals that contain (m, 1).
  [[nodiscard]] const std::array<Interval, 3>& box() const { return box_; }

 private:
  PolynomialDirection(const PolynomialStage& stage, const DistortedPoint& y, DyadicInterval q,
                      const std::array<Interval, 3>& box);

  template <class Form>
  Sign sign_of_form(const Form& form) const;

  const PolynomialStage* stage_;
  DistortedPoint y_;
  /// Contains |m|²; F is negative at the lower end and not negative at the upper one.
  DyadicInterval q_;
  std::array<Interval, 3> box_;
};

/// The direction of a fisheye, whose angle θ to the z axis is |m|: d = (m·sin θ/θ, cos θ), of unit
/// length, 0 < θ < π.
///
/// Exact    m is algebraic and not 0, and so is θ; tan θ is therefore transcendental (Lindemann).
///          A linear form at d, (l_x·m_x + l_y·m_y)·sin θ/θ + l_z·cos θ, is 0 only if both
///          coefficients are. A quadratic form is a polynomial in tan θ, times cos² θ; it is 0 only
///          if its three coefficients are. The coefficients are forms at (m, 1), whose signs are
///          known; all other signs are found in intervals of more and more bits.
class AngleDirection {
 public:
  /// (m, 1), as the stage of the lens has it.
  using PlaneDirection = std::variant<RationalDirection, PolynomialDirection>;

  /// Needs    0 < |m| < π.
  explicit AngleDirection(PlaneDirection m);

  [[nodiscard]] Sign sign_of(const ExactVector3& form) const;
  [[nodiscard]] Sign sign_of(const QuadraticForm& form) const;
  /// Encloses the components of d, with a precision of about `bits` relative to 1, of x and y
  /// relative to the greater of them.
  [[nodiscard]] std::array<DyadicInterval, 3> enclosure(long bits) const;
  /// Binary64 intervals that contain d.
  [[nodiscard]] const std::array<Interval, 3>& box() const { return box_; }

 private:
  PlaneDirection m_;
  std::array<Interval, 3> box_;
};

/// The direction d ≠ 0 of a ray in the camera frame, exactly: the preimage of a sample, never a
/// rounded vector. It belongs to the Preimages that it is from, which must outlive it.
///
/// It answers what a renderer asks: on which side of a plane the ray lies, which of two surfaces
/// is nearer, on which side of a limit or of a midpoint between two numbers a value lies. Each is
/// the sign of a linear or quadratic form at d, which does not depend on a positive factor of d.
/// Not in it: the components as numbers. They are irrational for most lenses.
///
/// Exact    every sign is the true one, and every question ends.
/// Threads  immutable; any number of threads may ask at once.
class ExactDirection {
 public:
  explicit ExactDirection(RationalDirection direction);
  explicit ExactDirection(PolynomialDirection direction);
  explicit ExactDirection(AngleDirection direction);
  explicit ExactDirection(OneRootDirection direction);
  explicit ExactDirection(NestedRootDirection direction);
  explicit ExactDirection(TurnDirection direction);

  /// Binary64 intervals that contain d: the filter that should be asked first. d has z = 1 for
  /// models of the plane, |d| = 1 for fisheyes by the angle and equirectangular panoramas; the
  /// greatest component of a RootDirection is about 1. An end may be infinite.
  [[nodiscard]] const std::array<Interval, 3>& box() const;

  /// The sign of form·d. Does not try the box.
  [[nodiscard]] Sign sign_of(const ExactVector3& form) const;
  /// The sign of a quadratic form at d.
  [[nodiscard]] Sign sign_of(const QuadraticForm& form) const;

  /// Encloses the same d as the box; its widths go to zero as `bits` grows. `bits` is about the
  /// precision relative to d, of x and y relative to the greater of them.
  [[nodiscard]] std::array<DyadicInterval, 3> enclosure(long bits) const;

  /// d times a positive number, in double-words with bounds on the errors; nullopt if the bounds
  /// are too wide.
  [[nodiscard]] std::optional<DirectionWords> words() const;

  /// d times a positive number, if d is known to be rational; otherwise nullptr.
  [[nodiscard]] const ExactVector3* rational() const;

 private:
  std::variant<RationalDirection, PolynomialDirection, AngleDirection, OneRootDirection,
               NestedRootDirection, TurnDirection>
      direction_;
};

}  // namespace fathom::lens
