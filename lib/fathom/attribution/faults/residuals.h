#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/faults/deviation.h"
#include "fathom/attribution/other_map.h"
#include "fathom/attribution/truth.h"

namespace fathom::attribution {

/// Difference of another map's depths from a camera's exact depths, pixel by pixel, in half widths
/// of the model's interval: |r| ≤ 1 is explained.
struct Residuals {
  Eigen::VectorXd r;
  /// Derivatives of the expected depth by each parameter, in the same unit.
  Eigen::Matrix<double, Eigen::Dynamic, parameter_count> slopes;
  std::vector<std::uint32_t> triangles;
  /// Barycentric coordinates of what each pixel shows of its triangle.
  Eigen::Matrix<double, Eigen::Dynamic, 3> corner_parts;

  /// Median of |r|.
  [[nodiscard]] double median() const;
  /// Mean of r² over the four fifths of the pixels where it is least.
  [[nodiscard]] double cost() const;
};

/// Makes residuals of a map for cameras that deviate from the truth's.
class ResidualSource {
 public:
  /// `found`: result of attribute() for the same arguments, with the widths. The arguments outlive
  /// it.
  ResidualSource(const Truth& truth, const OtherMap& other, const RendererModel& model,
                 const Attribution& found);

  /// Whether there are enough pixels for an estimate to rest on.
  [[nodiscard]] bool has_enough(const Residuals& residuals) const;
  /// `seen`: the truth of deviating(camera, deviation).
  [[nodiscard]] Residuals of(const Truth& seen, const Deviation& deviation) const;

 private:
  [[nodiscard]] double relative_width(std::size_t pixel) const;

  const OtherMap& other_;
  const RendererModel& model_;
  const Attribution& found_;
  Camera camera_;
  double typical_width_;  ///< half widths relative to the depth
  std::size_t stride_;
};

}  // namespace fathom::attribution
