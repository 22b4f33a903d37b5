#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fathom/image/channel_table.h"
#include "fathom/image/depth_map.h"

/// Which pixels of a map show a surface and which are background, and the values of the background.
namespace fathom {

/// The meaning of a channel's values, by its name and type. The last two parts of a layered name
/// count: `ViewLayer.Depth.Z` is a depth, `N.Z` a direction.
ChannelKind kind_of(const ImageChannel& channel);

/// How the values of a channel are drawn, in pictures and on the page of `fathom view`.
enum class ChannelDrawing {
  numbers,      ///< in the colours of a colour map
  errors,       ///< Zerror: numbers in diverging colours, which are white at 0
  identifiers,  ///< each number in its own colour
  fights        ///< Zfight: 0 as "right" and 1 as "wrong", in two colours
};
ChannelDrawing drawing_of(const ImageChannel& channel);

/// The value that means "no surface" in a depth channel of another program: 1e10 (Blender), 0
/// (most 16-bit and simulator maps), NaN (ROS), …
struct BackgroundRule {
  /// Values that are not finite are background, and a finite value given here is, too; with 0, so
  /// are values below it.
  std::optional<double> value;
  /// How it was found, for the user: one line, or empty if nothing was guessed.
  std::string note = {};
  /// Only `value`, which may be NaN, is background: the map declares its background
  /// (declared_background()), and other infinite values are depths that overflowed.
  bool only = false;
};

/// Guesses the rule for a depth channel. The first of these that applies:
///   codes (16 bits): 0;
///   any value that is not finite: those are the background, and no finite value is;
///   the greatest value is 1e10, 65504 or the greatest binary32 number: that value;
///   any value is 0 or below: 0 (and values below 0, but not of disparities, which may be
///   negative); otherwise there is no background.
BackgroundRule detect_background(const ImageChannel& channel);

/// The rule for a depth channel of a map: its declared background, or else the guess.
/// Fails    InputError if the declared background is not a number.
BackgroundRule background_of(const DepthMap& map, const ImageChannel& channel);

/// The values of `id`, `object` or `face`, the first that the map has.
const Samples<std::uint32_t>* identifiers_of(const DepthMap& map);

/// One byte per pixel: 1 if `channel` of `map` shows a surface there. `A` and `valid` show
/// something at every pixel. If the map has an identifier channel, that decides (unless
/// `by_identifiers` is false), which distinguishes a depth that overflowed to +∞ from background.
/// Otherwise the channel's own background decides (the rule for depths: given, or background_of());
/// a channel without one follows the map's `Z`, if there is one; else every pixel counts.
/// Fails    InputError if the map has a fault (find_fault), or declares a background that is not a
///          number.
std::vector<std::uint8_t> surface_mask(const DepthMap& map, const ImageChannel& channel,
                                       const std::optional<BackgroundRule>& rule = std::nullopt,
                                       bool by_identifiers = true);

// The background that a map declares.

/// The background that a map declares in its text background_text (depth_map.h): "0", "nan", or the
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
