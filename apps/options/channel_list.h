#pragma once

#include <string>
#include <vector>

#include "fathom/image/channel_table.h"

namespace fathom::app {

/// "Z,id,N" as channels. Fails with UsageError where one does not exist or stands twice.
std::vector<Channel> parse_channels(const std::string& list);

/// "Z,id,N" again.
std::string text_of(const std::vector<Channel>& channels);

/// How many channels of a file these are: N and P become three, bary two.
std::size_t count_parts(const std::vector<Channel>& channels);

}  // namespace fathom::app
