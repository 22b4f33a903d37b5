#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "fathom/camera/projection.h"
#include "fathom/fast/lenses/stage_lanes.h"
#include "fathom/lens/preimages.h"

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

}  // namespace fathom::fast
