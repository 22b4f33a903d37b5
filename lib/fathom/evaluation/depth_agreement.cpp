#include "fathom/evaluation/depth_agreement.h"

#include <cmath>
#include <stdexcept>

#include "fathom/numeric/standard_arithmetic.h"

namespace fathom {
namespace {

const Samples<float>& depths_of(const DepthMap& map) {
  const Samples<float>* depths = map.values<float>("Z");
  if (!depths) throw std::invalid_argument("a map without Z in binary32");
  return *depths;
}

/// Fewer pixels than that are no view of the truth to neural_slam_eval.
constexpr std::uint64_t few_pixels = 100;

}  // namespace

void DepthAgreementSum::add(const DepthMap& truth, const DepthMap& reconstruction) {
  const StandardArithmetic standard;
  const Samples<float>&true_depths = depths_of(truth), &depths = depths_of(reconstruction);
  if (true_depths.size() != depths.size() || truth.width != reconstruction.width)
    throw std::invalid_argument("maps of different sizes");
  std::uint64_t of_truth = 0;
  double sum = 0, sum_at_truth = 0;
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const bool is_true = std::isfinite(true_depths[i]), is_made = std::isfinite(depths[i]);
    const double t = is_true ? true_depths[i] : 0, d = is_made ? depths[i] : 0;
    sum += std::abs(d - t);
    if (is_true) {
      ++of_truth;
      sum_at_truth += std::abs(d - t);
    }
    if (is_true && is_made) errors_.add(t, d);
    sums_.both += is_true && is_made;
    sums_.only_truth += is_true && !is_made;
    sums_.only_reconstruction += is_made && !is_true;
  }
  ++sums_.views;
  sums_.l1_of_all_pixels += sum / static_cast<double>(depths.size());
  if (of_truth <= few_pixels) return;
  ++sums_.views_of_truth;
  sums_.l1_of_truth_pixels += sum_at_truth / static_cast<double>(of_truth);
}

DepthAgreement DepthAgreementSum::result() const {
  const StandardArithmetic standard;
  DepthAgreement result = sums_;
  result.metrics = errors_.result();
  if (result.views != 0) result.l1_of_all_pixels /= static_cast<double>(result.views);
  if (result.views_of_truth != 0)
    result.l1_of_truth_pixels /= static_cast<double>(result.views_of_truth);
  return result;
}

}  // namespace fathom
