#include "apps/options/channel_list.h"

#include <algorithm>
#include <optional>

#include "apps/shell/values.h"
#include "fathom/numeric/errors.h"
#include "fathom/numeric/unknown_name.h"

namespace fathom::app {

namespace {

std::vector<std::string> every_channel_name() {
  std::vector<std::string> names;
  names.reserve(channel_table.size());
  for (const ChannelDescription& channel : channel_table) names.emplace_back(channel.name);
  return names;
}

}  // namespace

std::vector<Channel> parse_channels(const std::string& list) {
  std::vector<Channel> channels;
  for (const std::string& name : parse_list(list)) {
    const std::optional<Channel> channel = channel_named(name);
    if (!channel) {
      throw UnknownName("there is no channel '" + name + "'; there are " + channel_names(), name,
                        every_channel_name());
    }
    if (std::find(channels.begin(), channels.end(), *channel) != channels.end()) {
      throw UsageError("'" + name + "' is there twice");
    }
    channels.push_back(*channel);
  }
  return channels;
}

std::string text_of(const std::vector<Channel>& channels) {
  std::string text;
  for (const Channel channel : channels) {
    if (!text.empty()) text += ',';
    text += description_of(channel).name;
  }
  return text;
}

std::size_t count_parts(const std::vector<Channel>& channels) {
  std::size_t count = 0;
  for (const Channel channel : channels) {
    count += std::max<std::size_t>(1, description_of(channel).parts.size());
  }
  return count;
}

}  // namespace fathom::app
