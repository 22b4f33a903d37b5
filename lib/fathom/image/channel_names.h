#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/failures/unknown_name.h"
#include "fathom/image/channel_table.h"
#include "fathom/image/depth_map.h"

/// Other names of channels, as in "depth" for Z, and errors about names of channels.
namespace fathom {

/// A name for a channel that those who make data sets know, or for a mask.
struct ContentsName {
  std::string_view name;
  /// The channel that is meant, or that the mask is made from.
  Channel channel;
  bool is_mask;
};

/// The names besides the channels' own: help, completion, messages, parsers and Python take them
/// from here.
inline constexpr auto contents_table = std::to_array<ContentsName>({
    {"depth", Channel::Z, false},
    {"normal", Channel::N, false},
    {"camera-normal", Channel::Nc, false},
    {"segmentation", Channel::object, false},
    {"mask", Channel::id, true},
});

/// nullptr if it is no name of the table.
const ContentsName* contents_named(std::string_view name);

/// The name that a channel has in a map: "Z" for "depth". A mask, a name that the map itself has
/// and a name that is not in the table are returned unchanged.
std::string own_channel_name(const DepthMap& map, const std::string& name);

// Errors contain the existing names and suggest the intended one, also for words of other programs
// ("range" for distance).

/// The error of a name that is not in `names`, by default those that channel_named() knows: "there
/// is no channel 'depth'; there are Z, A, …; did you mean 'Z'?"
UnknownName unknown_channel(const std::string& name,
                            const std::vector<std::string>& names = names_of_channels());

/// The same, of a name that contents_named() does not know either: it has these names, too.
UnknownName unknown_contents(const std::string& name);

/// What one of Fathom's channels means, in a few words: "planar depth" of Z; also of the channels
/// of a depth buffer. Empty for other names.
std::string meaning_of(const std::string& channel);

/// The channels of a map as users name them: N where N.X, N.Y and N.Z are there, each once.
std::vector<std::string> names_of_channels(const DepthMap& map);

/// "Z, N"
std::string list_of_channels(const DepthMap& map);

/// "N is N.X, N.Y, N.Z" where the map holds N in parts; else empty.
std::string text_of_parts(const DepthMap& map, const std::string& name);

/// The error of a name that no single channel of the map has: "the map has no channel 'z', only Z,
/// N; did you mean 'Z'?", or "N is N.X, N.Y, N.Z; name one"; `which` is the map, "the map".
UsageError missing_channel(const DepthMap& map, const std::string& name,
                           const std::string& which = "the map");

/// Error about an ambiguous setting `channel`, with the channels to choose from: "this format holds
/// one channel, and the map has Z, N; name the one to write". `refusal` is its beginning.
UsageError ambiguous_channel(const std::vector<std::string>& names, const std::string& refusal,
                             const std::string& use);

}  // namespace fathom
