#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fathom/image/depth_map.h"
#include "fathom/image/error_metrics.h"
#include "fathom/image/rgb_image.h"

/// How two maps of the same view differ.
namespace fathom {

/// Column and row of a pixel, from 0 at the top left.
struct PixelPosition {
  std::uint32_t x = 0, y = 0;
  friend bool operator==(PixelPosition, PixelPosition) = default;
};

/// Figures over the compared pixels (ChannelComparison::compared); all 0 if there are none.
/// Percentiles are nearest-rank: the least value that at least p % of the pixels do not exceed.
struct DifferenceSummary {
  double max = 0, mean = 0;
  double p50 = 0, p90 = 0, p99 = 0, p99_9 = 0;
  /// The first pixel, row by row, that has `max`.
  PixelPosition worst;
};

/// One channel of both maps. The rule, pixel by pixel:
///   background in both        counted in `neither`, not compared
///   a surface in one only     counted in `only_truth` or `only_other`, not compared
///   bit patterns are equal    bit_equal, differences 0
///   identifiers               equal or in `different_identifiers`; no differences are measured
///   a NaN, or an infinity     `incommensurable` unless both are the same infinity or both NaN
///   against another value     (difference 0): no difference is measured, no tolerance is met
///   otherwise                 absolute |a − b|; relative |a − b| / max(|a|, |b|), 0 if both are 0;
///                             ulp: steps from one binary32 number to the next between a and b,
///                             −0 and +0 being one (binary64 numbers if both channels are; steps of
///                             the code if both are 16-bit codes of one scale)
/// All differences are computed in binary64; absolute ones have the unit of the channel.
struct ChannelComparison {
  std::string truth_channel, other_channel;
  bool identifiers = false;
  /// Directions and positions: numbers of both signs, among which a count of ulps means little,
  /// since half of all binary32 numbers lie between −1 and 1.
  bool is_around_zero = false;

  std::uint64_t pixels = 0;
  std::uint64_t both = 0, only_truth = 0, only_other = 0, neither = 0;
  /// The first pixel, row by row, where only one has a surface.
  std::optional<PixelPosition> first_coverage_disagreement;

  /// Of the `both` pixels; where numbers are compared, both = compared + incommensurable.
  std::uint64_t compared = 0;
  std::uint64_t bit_equal = 0;
  std::uint64_t incommensurable = 0;
  std::uint64_t different_identifiers = 0;
  /// The first pixel, row by row, with different identifiers or incommensurable values.
  std::optional<PixelPosition> first_mismatch;
  /// `both` pixels farther apart than every tolerance of CompareOptions, incommensurable, or with
  /// different identifiers.
  std::uint64_t beyond_tolerance = 0;

  DifferenceSummary absolute, relative, ulp;
  /// If CompareOptions::metrics requests them, for depth channels: one of the two.
  std::optional<DepthMetrics> depth_metrics;
  std::optional<DisparityMetrics> disparity_metrics;
  /// Notes for the reader, one per line: a guessed background, different types, …
  std::vector<std::string> notes;

  [[nodiscard]] bool within_tolerance() const {
    return only_truth == 0 && only_other == 0 && beyond_tolerance == 0;
  }
};

struct MapComparison {
  std::vector<ChannelComparison> channels;
  /// Channels that the other map does not have; not compared.
  std::vector<std::string> only_in_truth, only_in_other;
  std::vector<std::string> notes;

  /// "Do the maps agree": in every channel compared, coverage agrees and no pixel is beyond the
  /// tolerance.
  [[nodiscard]] bool within_tolerance() const;
};

/// Which figures of benchmarks are computed of channels of depth (error_metrics.h).
enum class Metrics {
  none,
  by_channel,   ///< DisparityMetrics of channels called `disparity`, DepthMetrics of other channels
  of_disparity  ///< DisparityMetrics of all channels, because a PFM does not name its quantity
};

struct CompareOptions {
  /// Two numbers agree if one of three tolerances allows it: a number of ulps, an absolute
  /// difference in the unit of the channel, or a relative difference (ChannelComparison defines
  /// them).
  double tolerance_ulp = 0;
  /// Compare this channel only; empty: all that both have. If they have no name in common, a depth
  /// channel of each is compared (`ViewLayer.Depth.Z`), with a note.
  std::string channel;
  /// Its name in the other map, if that differs.
  std::string other_channel;
  /// The value of the background in depth channels, in addition to NaN and infinities. If empty,
  /// the value that the map declares (declared_background()), or else the detected value
  /// (surface.h), with a note.
  std::optional<double> truth_background, other_background;
  double tolerance_absolute = 0;
  double tolerance_relative = 0;
  Metrics metrics = Metrics::none;
};

/// Compares the channels of two maps, pixel by pixel.
/// Fails    InputError if a map has a fault (find_fault), the sizes differ or there is nothing in
///          common to compare; UsageError if a channel that was asked for is missing, or for a
///          tolerance that is negative or NaN.
MapComparison compare_maps(const DepthMap& truth, const DepthMap& other,
                           const CompareOptions& options = {});

/// Measure for the colours of draw_differences(); ChannelComparison defines each.
enum class DifferenceMeasure { absolute, relative, ulp };

/// A picture of the differences in one channel (empty: among the compared channels Z, else the
/// first depth channel, else the first): equal pixels are dark, different pixels are coloured by
/// the logarithm of their difference. Surfaces in only one map and values that cannot be compared
/// have separate colours. In the legend, the colours of absolute and relative differences begin at
/// a millionth of the greatest difference.
/// Fails    as compare_maps(); OutputError if the font is missing.
RgbImage draw_differences(const DepthMap& truth, const DepthMap& other,
                          const CompareOptions& options = {},
                          DifferenceMeasure by = DifferenceMeasure::absolute);

}  // namespace fathom
