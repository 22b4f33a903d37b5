#pragma once

#include <array>
#include <optional>

#include "fathom/clipping/points.h"
#include "fathom/pipeline/scan/arithmetic.h"

/// The forms of the line through two points P ≠ Q, in an image, where y grows down.
namespace fathom::pipeline {

/// y = slope·x + intercept.
template <class Number>
struct ExplicitLine {
  Number slope, intercept;
};

template <class Number>
class LineForms {
 public:
  using Point = clipping::Point2<Number>;

  LineForms(const Point& P, const Point& Q) : P_(P), dx_(Q.x - P.x), dy_(Q.y - P.y) {}

  [[nodiscard]] bool is_point() const { return dx_ == 0 && dy_ == 0; }

  /// nullopt for a vertical line.
  [[nodiscard]] std::optional<ExplicitLine<Number>> as_explicit() const {
    if (dx_ == 0) return std::nullopt;
    const Number slope = dy_ / dx_;
    return ExplicitLine<Number>{slope, Number(P_.y - slope * P_.x)};
  }

  /// a, b, c of F(x, y) = a·x + b·y + c with a = Δy, b = −Δx, so that F(P) = F(Q) = 0.
  [[nodiscard]] std::array<Number, 3> implicit() const {
    return {dy_, Number(-dx_), Number(dx_ * P_.y - dy_ * P_.x)};
  }
  /// F at a point, from P: positive on the left of the way from P to Q as the image shows it.
  [[nodiscard]] Number value_at(const Point& p) const {
    return dy_ * (p.x - P_.x) - dx_ * (p.y - P_.y);
  }

  /// P + t·(Q − P).
  [[nodiscard]] Point at(const Number& t) const { return {P_.x + t * dx_, P_.y + t * dy_}; }
  /// The t of the point of the line that is nearest to p.
  [[nodiscard]] Number parameter_of(const Point& p) const {
    return ((p.x - P_.x) * dx_ + (p.y - P_.y) * dy_) / (dx_ * dx_ + dy_ * dy_);
  }

 private:
  Point P_;
  Number dx_, dy_;
};

}  // namespace fathom::pipeline
