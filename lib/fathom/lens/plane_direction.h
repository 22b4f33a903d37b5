#pragma once

#include <array>
#include <optional>
#include <variant>

#include "fathom/lens/direction_words.h"
#include "fathom/lens/polynomial_stage.h"
#include "fathom/lens/sample_plane.h"
#include "fathom/numeric/certified.h"
#include "fathom/numeric/dyadic.h"
#include "fathom/numeric/exact_polynomial.h"

namespace fathom {
class BigInterval;
}

/// Directions (m, 1) of points m of the plane z = 1 that are rational, or roots of a polynomial.
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

/// A homogeneous polynomial in the components of a direction, in the arithmetics that show its
/// sign.
class DirectionPolynomial {
 public:
  virtual ~DirectionPolynomial() = default;
  /// In intervals of so many bits.
  [[nodiscard]] virtual BigInterval at(const std::array<BigInterval, 3>& d, long bits) const = 0;
  [[nodiscard]] virtual ExactPolynomial at(const std::array<ExactPolynomial, 3>& d) const = 0;
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
  [[nodiscard]] Sign sign_of(const DirectionPolynomial& polynomial) const;
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

/// (m, 1), as the stage of a lens has it.
using PlaneDirection = std::variant<RationalDirection, PolynomialDirection>;

}  // namespace fathom::lens
