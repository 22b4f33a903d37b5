#pragma once

#include <array>

#include "fathom/geometry/frames.h"

namespace fathom {

/// One row of an exact affine map in binary64, with a bound on its error.
class ApproximateRow {
 public:
  explicit ApproximateRow(const std::array<Dyadic, 4>& row);
  /// An interval that contains row·(x, y, z, 1); the whole real line where nothing is known.
  [[nodiscard]] Interval at(const MeshPoint& p) const;

 private:
  std::array<double, 4> coefficients_{};
  bool usable_ = true;
};

}  // namespace fathom
