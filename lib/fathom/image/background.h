#pragma once

#include <optional>
#include <string>

#include "fathom/image/depth_map.h"
#include "fathom/image/map_texts.h"

/// The value that stands for "no surface" in the depth channels of a map.
namespace fathom {

/// The background that a map declares in its text background_text (map_texts.h): "0", "nan", or the
/// shortest decimal text of a number, if it is not +∞ (for codes: 0); +∞ is accepted too. EXR and
/// NPZ contain the text, PFM and NPY cannot.
/// Fails    InputError if the text is neither a number nor "nan" nor "inf".
std::optional<double> declared_background(const DepthMap& map);

/// Sets the background that a map declares; +∞ needs no text.
void declare_background(DepthMap& map, double value);

/// The map with `value` wherever a depth channel (Z, distance, disparity, Zdecoded, …) shows no
/// surface, and with the text that declares it (no text for +∞). surface_mask() decides where a
/// surface is: by identifiers if the map has them, else by the current background: only `now` if it
/// is given (+∞ for a rendered map), else the result of background_of().
///   +∞, NaN     any surface keeps its bits. An overflowed depth is +∞ as well, so with +∞ only an
///               identifier channel distinguishes it from background; with NaN it is always
///               distinguishable
///   finite      likewise, but no surface may have this value
/// Exact    `value` is rounded to the type of the channel, to nearest even.
/// Fails    UsageError if `value` is −∞, or does not fit the type, or the map has codes (their
///          background is 0); OutputError, naming the pixel, if a surface has that value;
///          InputError if the map has a fault.
DepthMap with_background(DepthMap map, double value, std::optional<double> now = std::nullopt);

}  // namespace fathom
