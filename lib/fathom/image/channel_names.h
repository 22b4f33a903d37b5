#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/failures/unknown_name.h"
#include "fathom/image/channel_table.h"
#include "fathom/image/depth_map.h"

/// Names of channels in other programs, and errors about names.
///
/// Channels under the names that other programs expect. OpenCV, for example, shows only the
/// channels R, G, B and Y of an EXR.
namespace fathom {

/// A channel of a map and its name in the file: {"Z", "Y"}.
struct ChannelName {
  std::string channel, in_file;
};

/// The map with these channels called otherwise, and the text channel_names_text (depth_map.h),
/// "Z=Y,distance=D", by which read_map() gives them their own names back. Files of PFM and NPY name
/// no channel.
/// Fails    UsageError if there is no such channel, it is named twice, a name is empty or holds one
///          of ",=" or NUL, or two channels would be called the same; InputError if the map has a
///          fault.
DepthMap with_channel_names(DepthMap map, const std::vector<ChannelName>& names);

/// The map with the names that its channels had before with_channel_names(), and without that text.
/// A text of another form is left unchanged: another program wrote it.
DepthMap with_own_channel_names(DepthMap map);

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

// Errors about names of channels. They contain the existing names and suggest the intended one,
// also for words of other programs ("depth" for Z).

/// The error of a name that channel_named() does not know: "there is no channel 'depth'; there are
/// Z, A, …; did you mean 'Z'?"
UnknownName unknown_channel(const std::string& name);

/// The same, of a name that contents_named() does not know either: it has these names, too.
UnknownName unknown_contents(const std::string& name);

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
