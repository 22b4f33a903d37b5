#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "fathom/image/channel_table.h"
#include "fathom/image/deep_map.h"
#include "fathom/image/depth_map.h"

namespace fathom::app {

/// "Z,id,N" as channels. Fails with UsageError where one does not exist or stands twice.
std::vector<Channel> parse_channels(const std::string& list);

/// "Z,id,N" again.
std::string text_of(const std::vector<Channel>& channels);

/// How many channels of a file these are: N and P become three, bary two.
std::size_t count_parts(const std::vector<Channel>& channels);

/// Reads the map that a command was given, within --max-memory; no output may take its place.
/// Fails    InputError.
DepthMap read_map_argument(const std::string& file);
/// The same of a file that has been read already.
DepthMap read_map_argument(std::span<const std::byte> bytes, const std::string& file);
/// A deep map that has been read already, likewise.
DeepMap read_deep_map_argument(std::span<const std::byte> bytes, const std::string& file);
/// A map to be drawn: flat_map() of a deep map; the layers of Cryptomatte as with_matte_names()
/// shows them.
DepthMap read_map_or_flat_map(const std::string& file);

}  // namespace fathom::app
