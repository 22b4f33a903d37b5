#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fathom/image/channel_table.h"
#include "fathom/image/depth_map.h"

/// Which pixels of a map show a surface and which are background.
namespace fathom {

/// Told by the name (the last two parts of a layered one count: `ViewLayer.Depth.Z` is a depth,
/// `N.Z` a direction) and by the type.
ChannelKind kind_of(const ImageChannel& channel);

/// The value that means "no surface" in a depth channel of another program: 1e10 (Blender), 0
/// (most 16-bit and simulator maps), NaN (ROS), …
struct BackgroundRule {
  /// Every value that is not finite is background already; a finite value here is so as well.
  std::optional<double> value;
  /// How it was found, for the user: one line, or empty where nothing was guessed.
  std::string note;
};

/// Guesses the rule for a depth channel. The first that applies:
///   codes (16 bits): 0;
///   any value that is not finite: those are the background, and no finite value is;
///   the greatest value is 1e10, 65504 or the greatest binary32: that value;
///   any value 0 or below: 0 (values below 0 too);
///   otherwise there is no background.
BackgroundRule detect_background(const ImageChannel& channel);

/// The values of `id`, `object` or `face`, the first that the map has.
const Samples<std::uint32_t>* identifiers_of(const DepthMap& map);

/// One byte a pixel: 1 where `channel` of `map` shows a surface.
/// `A` shows something at every pixel. Where the map has an identifier channel, that one decides
/// (unless `by_identifiers` is false); this tells a depth that overflowed to +∞ from background.
/// Otherwise the channel's own background does (the rule for depths, given or detected); a channel
/// without one follows the map's `Z`, if there is one; else every pixel counts.
std::vector<std::uint8_t> surface_mask(const DepthMap& map, const ImageChannel& channel,
                                       const std::optional<BackgroundRule>& rule = std::nullopt,
                                       bool by_identifiers = true);

}  // namespace fathom
