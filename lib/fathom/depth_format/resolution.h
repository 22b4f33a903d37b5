#pragma once

#include <cstdint>
#include <optional>

#include "fathom/depth_format/encode.h"

/// How finely a format tells depths apart. Depths are in scene units; what is returned as binary64
/// is rounded once from the exact number. The depths asked about must be between near and far, else
/// InputError.
namespace fathom {

/// The distances from the depth that the code of D stands for to those of the neighbouring codes.
/// nullopt where there is no such code; +∞ where it stands for infinity.
struct Resolution {
  StoredDepth stored;
  std::optional<double> to_nearer, to_farther;
};
Resolution resolution(const DepthFormat& format, const Ratio& depth);

/// The number of different stored values that depths from `nearest` to `farthest`, both included,
/// are stored as; f is continuous, so none between those of the ends is left out.
std::uint64_t codes_between(const DepthFormat& format, const Ratio& nearest, const Ratio& farthest);

/// How far behind D a surface has to be to be told apart: the least s such that every depth beyond
/// D + s, up to far, is stored as another value than D. nullopt if no depth up to far is.
std::optional<double> separation_behind(const DepthFormat& format, const Ratio& depth);

/// The length of the interval of depths between near and far that are stored as D is: two depths
/// there that differ by more than this are always told apart; +∞ where it has no end.
double bin_width(const DepthFormat& format, const Ratio& depth);

}  // namespace fathom
