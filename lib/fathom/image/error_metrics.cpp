#include "fathom/image/error_metrics.h"

#include <algorithm>
#include <cmath>

#include "fathom/numeric/standard_arithmetic.h"

namespace fathom {

void DepthErrors::add(double truth, double other) {
  // A NaN is not above 0 either.
  if (!(truth > 0 && other > 0) || std::isinf(truth) || std::isinf(other)) {
    ++sums_.left_out;
    return;
  }
  ++sums_.pixels;
  const double difference = other - truth;
  const double logarithms = std::log(other) - std::log(truth);
  const double ratio = std::max(other / truth, truth / other);
  sums_.mae += std::abs(difference);
  sums_.abs_rel += std::abs(difference) / truth;
  sums_.sq_rel += difference * difference / truth;
  sums_.rmse += difference * difference;
  sums_.rmse_log += logarithms * logarithms;
  sums_.delta_1 += ratio < 1.25;
  sums_.delta_2 += ratio < 1.25 * 1.25;
  sums_.delta_3 += ratio < 1.25 * 1.25 * 1.25;
}

DepthMetrics DepthErrors::result() const {
  const StandardArithmetic standard;
  DepthMetrics means = sums_;
  if (means.pixels == 0) return means;
  const auto n = static_cast<double>(means.pixels);
  for (double* sum : {&means.mae, &means.abs_rel, &means.sq_rel, &means.rmse, &means.rmse_log,
                      &means.delta_1, &means.delta_2, &means.delta_3})
    *sum /= n;
  means.rmse = std::sqrt(means.rmse);
  means.rmse_log = std::sqrt(means.rmse_log);
  return means;
}

void DisparityErrors::add(double truth, double other) {
  if (!std::isfinite(truth) || !std::isfinite(other)) {
    ++sums_.left_out;
    return;
  }
  ++sums_.pixels;
  const double error = std::abs(other - truth);
  sums_.epe += error;
  sums_.rmse += error * error;
  sums_.bad_0_5 += error > 0.5;
  sums_.bad_1 += error > 1;
  sums_.bad_2 += error > 2;
}

DisparityMetrics DisparityErrors::result() const {
  const StandardArithmetic standard;
  DisparityMetrics means = sums_;
  if (means.pixels == 0) return means;
  const auto n = static_cast<double>(means.pixels);
  for (double* sum : {&means.epe, &means.rmse, &means.bad_0_5, &means.bad_1, &means.bad_2})
    *sum /= n;
  means.rmse = std::sqrt(means.rmse);
  return means;
}

}  // namespace fathom
