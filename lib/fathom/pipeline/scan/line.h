#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>

#include "fathom/clipping/points.h"
#include "fathom/pipeline/scan/arithmetic.h"
#include "fathom/pipeline/scan/pixels.h"

/// Lines in an image, where y grows down: the forms of a line, and the pixels that algorithms draw.
namespace fathom::pipeline {

/// y = slope·x + intercept.
template <class Number>
struct ExplicitLine {
  Number slope, intercept;
};

/// The forms of the line through two points P ≠ Q.
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

// Lines between two pixels.
//
// A line steps along the axis of the greater difference (x if they are equal), the major one, from
// its first end to its second, and in every step takes the pixel nearest to the exact line. A tie
// is decided by a rule; all exact algorithms draw the same pixels by the same rule.
//
// Lines are not clipped: `window` limits which pixels are visited, never which line is drawn;
// algorithms that can begin anywhere skip the outside, however long the line.

/// Which of two pixels a line takes that passes half way between their centres.
enum class TieRule {
  greater,  ///< the greater minor coordinate: the same pixels from either end
  even,     ///< the even one, as Python's round() has it: the same pixels from either end
  stay,     ///< no minor step, as the textbooks' Bresenham: reversing a line changes its pixels
};

/// Ends in pixels, with |coordinate| ≤ 2³¹.
struct LineEnds {
  std::int64_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  TieRule ties = TieRule::greater;
};

/// A line in terms of its major and minor axis.
struct LineAxes {
  explicit LineAxes(const LineEnds& ends);

  bool steep;                     ///< y is the major axis
  std::int64_t major0, minor0;    ///< the first end
  std::int64_t d_major, d_minor;  ///< lengths, not negative: d_major ≥ d_minor
  int major_sign, minor_sign;     ///< directions, ±1
  TieRule ties;

  [[nodiscard]] std::int64_t major_at(std::int64_t step) const {
    return major0 + major_sign * step;
  }
  /// Whether a line that passes half way between `minor` and the next minor coordinate steps there.
  [[nodiscard]] bool steps_at_tie(std::int64_t minor) const {
    return ties == TieRule::greater ? minor_sign > 0 : ties == TieRule::even && minor % 2 != 0;
  }
  [[nodiscard]] Pixel pixel(std::int64_t step, std::int64_t minor) const {
    const std::int64_t major = major_at(step);
    return steep ? Pixel{minor, major} : Pixel{major, minor};
  }
  /// The steps whose major coordinate lies in the window: first ≤ step ≤ last.
  struct Steps {
    std::int64_t first, last;
  };
  [[nodiscard]] Steps steps_in(const PixelWindow& window) const;
};

/// A pixel of a line, in drawing order, and the number that decided it. `state` is
///   explicit, dda   the minor coordinate before it was rounded;
///   bresenham       the error before this step;
///   midpoint        the decision variable d from which the next pixel follows.
template <class State>
using VisitLine = std::function<void(const Pixel& pixel, const State& state)>;

/// y = m·(x − x₀) + y₀ in every step: a multiplication, an addition and a rounding.
template <class Number>
void explicit_line(const LineEnds& ends, const PixelWindow& window, const VisitLine<Number>& visit);

/// Digital differential analyser: y grows by m in every step, and is rounded for drawing. In
/// floating point the errors of the sums add up.
template <class Number>
void dda_line(const LineEnds& ends, const PixelWindow& window, const VisitLine<Number>& visit);

/// Bresenham's line: the distance to the exact line, in units of 1/(2·d_major), is carried along in
/// integers.
/// Source   [Bre65]; all eight octants.
void bresenham_line(const LineEnds& ends, const PixelWindow& window,
                    const VisitLine<std::int64_t>& visit);

/// The midpoint algorithm: the sign of d = 2·d_minor − d_major + … is the side of the midpoint
/// between the two next pixels on which the line passes. d > 0: north-east, d += 2(d_minor −
/// d_major); d < 0: east, d += 2·d_minor; d = 0 is a tie.
/// Source   [Van84]
void midpoint_line(const LineEnds& ends, const PixelWindow& window,
                   const VisitLine<std::int64_t>& visit);

}  // namespace fathom::pipeline
