#pragma once

#include <vector>

#include "fathom/image/pictures/legend.h"
#include "fathom/image/preview.h"

namespace fathom::image {

/// Places values between the ends of a colour bar, from 0 to 1.
class ScaledRange {
 public:
  /// `values` are the finite ones of the surface; only `equalised` needs them.
  /// Fails    UsageError if `log` or `inverse` has an end that is not above 0.
  ScaledRange(ColourScale scale, double low, double high, const std::vector<double>& values);

  /// Values beyond an end lie at that end, or beyond it; 0.5 if the ends are equal.
  [[nodiscard]] double place(double value) const;
  /// The value at this place.
  [[nodiscard]] double value_at(double place) const;
  /// Marks of the bar: both ends, and short numbers between them.
  [[nodiscard]] std::vector<ColourBar::Mark> marks() const;

 private:
  ColourScale scale_;
  double low_, high_;
  /// In ascending order, from low_ to high_.
  std::vector<double> sorted_;
};

}  // namespace fathom::image
