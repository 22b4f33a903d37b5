#pragma once

#include <string>
#include <vector>

#include "fathom/failures/unknown_name.h"
#include "fathom/image/depth_map.h"

/// Errors about names of channels. They contain the existing names and suggest the intended one,
/// also for words of other programs ("depth" for Z).
namespace fathom {

/// The error of a name that channel_named() does not know: "there is no channel 'depth'; there are
/// Z, A, …; did you mean 'Z'?"
UnknownName unknown_channel(const std::string& name);

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
