#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/other_map.h"
#include "fathom/attribution/truth.h"

namespace fathom::attribution {

/// Pixels that touch, corners counting, as indices row by row from the top left; in the order of
/// their first pixels.
std::vector<std::vector<std::size_t>> pixel_groups(std::uint32_t width, std::uint32_t height,
                                                   const std::function<bool(std::size_t)>& is_one);

/// A finding about some pixels; `explained` is 1 for each unexplained pixel that it explains.
struct PixelFinding {
  Finding finding;
  std::vector<std::uint8_t> explained;
};

// Each function returns a finding that explains nine tenths of the unexplained pixels, or nullopt.

/// `clipped`: all surfaces nearer than some depth are missing, or all that are farther.
std::optional<PixelFinding> clipped(const Truth& truth, const OtherMap& other,
                                    const Attribution& found);

/// `lost-rows`, `lost-columns`: whole rows or columns do not show the surfaces that they should.
std::optional<PixelFinding> lost_lines(const Truth& truth, const OtherMap& other,
                                       const Attribution& found);

/// `mixed`: pixels at silhouettes hold depths between their neighbours' depths, as after a filter
/// that mixes pixels.
std::optional<PixelFinding> mixed(const Truth& truth, const OtherMap& other,
                                  const Attribution& found);

/// `isolated-pixels`: a few pixels, each by itself.
std::optional<PixelFinding> isolated(const Truth& truth, const OtherMap& other,
                                     const Attribution& found);

/// Faults of single triangles: missing triangles, all back faces missing, ties between equal
/// triangles. A triangle is missing if its absence explains at least three touching pixels and it
/// is visible nowhere; one or two pixels may be chance. `found`: result of attribute().
std::vector<Finding> triangles_at_fault(const Truth& truth, const OtherMap& other,
                                        const Attribution& found);

}  // namespace fathom::attribution
