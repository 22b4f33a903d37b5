#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

/// The figures by which depth and stereo benchmarks rank methods: here of one channel of a map
/// against the same of the true one. Sums are computed in binary64, pixel by pixel from the top
/// left.
namespace fathom {

/// Of depths d against true depths t, over the pixels where both maps show a surface and both
/// numbers are finite and above 0.
/// Source   [EPF14] 4.2 for all but `mae`, which KITTI, NYU and others report besides.
struct DepthMetrics {
  std::uint64_t pixels = 0;
  /// Pixels where both show a surface that are not among them.
  std::uint64_t left_out = 0;
  double abs_rel = 0;   ///< mean |d − t| / t
  double sq_rel = 0;    ///< mean (d − t)² / t, in the unit of the depths
  double rmse = 0;      ///< √ mean (d − t)²
  double rmse_log = 0;  ///< √ mean (ln d − ln t)²
  double mae = 0;       ///< mean |d − t|
  /// Shares of the pixels with max(d / t, t / d) < 1.25, 1.25², 1.25³.
  double delta_1 = 0, delta_2 = 0, delta_3 = 0;
};

/// Of disparities d against true ones t, in pixels, where both maps show a surface and both numbers
/// are finite.
/// Source   [SHK14]; `epe`, the end-point error, is their "avgerr".
struct DisparityMetrics {
  std::uint64_t pixels = 0;
  std::uint64_t left_out = 0;
  double epe = 0;   ///< mean |d − t|
  double rmse = 0;  ///< √ mean (d − t)²
  /// Shares of the pixels with |d − t| > 0.5, 1, 2.
  double bad_0_5 = 0, bad_1 = 0, bad_2 = 0;
};

/// Adds up pixels where both maps show a surface; result() is the mean of them, all 0 of none.
class DepthErrors {
 public:
  void add(double truth, double other);
  [[nodiscard]] DepthMetrics result() const;

 private:
  DepthMetrics sums_;
};

class DisparityErrors {
 public:
  void add(double truth, double other);
  [[nodiscard]] DisparityMetrics result() const;

 private:
  DisparityMetrics sums_;
};

}  // namespace fathom

namespace fathom::image {

/// The ⌈n·p⌉-th of n sorted values, the first for p = 0; p in thousandths, so that n·p is a whole
/// number.
/// Needs    one value at least.
inline double nearest_rank(const std::vector<double>& sorted, std::size_t thousandths) {
  const std::size_t rank = (sorted.size() * thousandths + 999) / 1000;
  return sorted[std::max<std::size_t>(rank, 1) - 1];
}

}  // namespace fathom::image
