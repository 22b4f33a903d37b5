#pragma once

#include <cstdint>
#include <optional>

#include "fathom/depth_format/encode.h"

/// How finely a format distinguishes depths. Depths are in scene units; binary64 results are
/// rounded once from the exact number.
/// Fails    all: InputError if a depth asked about is not between near and far.
namespace fathom {

/// The distances from the depth of D's code to the depths of its neighbouring codes. nullopt if a
/// neighbour does not exist; +∞ if its depth is infinite.
struct Resolution {
  StoredDepth stored;
  std::optional<double> to_nearer, to_farther;
};
Resolution resolution(const DepthFormat& format, const Ratio& depth);

/// The number of different stored values of depths from `nearest` to `farthest`, both included; f
/// is continuous, so every value between the values of the ends occurs.
std::uint64_t codes_between(const DepthFormat& format, const Ratio& nearest, const Ratio& farthest);

/// How far behind D a surface has to be to be distinguished from it: the least s such that every
/// depth beyond D + s, up to far, is stored as a different value than D. nullopt if no depth is.
std::optional<double> separation_behind(const DepthFormat& format, const Ratio& depth);

/// The length of the interval of depths between near and far that are stored like D: depths that
/// differ by more than this from one in it are always distinguished; +∞ if it has no end.
double bin_width(const DepthFormat& format, const Ratio& depth);

}  // namespace fathom
