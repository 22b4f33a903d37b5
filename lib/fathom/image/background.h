#pragma once

#include <optional>
#include <string>

#include "fathom/image/depth_map.h"
#include "fathom/image/map_texts.h"

/// The value that stands for "no surface" in the depth channels of a map.
namespace fathom {

/// What a map says of its own background, in its text background_text (map_texts.h): "0", "nan", or
/// the shortest decimal text of a number, where it is not +∞ (of codes: 0); +∞ is taken too. EXR
/// and NPZ hold the text, PFM and NPY have no place for it.
/// Fails    InputError if the text is neither a number nor "nan" nor "inf".
std::optional<double> declared_background(const DepthMap& map);

/// Sets what a map says of its own background; +∞ needs no text.
void declare_background(DepthMap& map, double value);

/// The map with `value` wherever a depth channel (Z, distance, disparity, Zdecoded, …) shows no
/// surface, and the text that says so (none for +∞). Where there is no surface is as surface_mask()
/// tells it: by identifiers, where the map has them, else by the background that it has: `now`, and
/// that alone, where it is given (of a map that was rendered, +∞), else what background_of() finds.
///   +∞, NaN     any surface keeps its bits; an overflowed depth is +∞ as well, so that with +∞
///               only an identifier channel tells it from background, and with NaN it is told in
///               any case
///   finite      likewise, but no surface may have this value
/// Exact    `value` is rounded to the type of the channel, to nearest even.
/// Fails    UsageError if `value` is −∞, or does not fit the type, or the map has codes (their
///          background is 0); OutputError, naming the pixel, if a surface has that value;
///          InputError if the map has a fault.
DepthMap with_background(DepthMap map, double value, std::optional<double> now = std::nullopt);

}  // namespace fathom
