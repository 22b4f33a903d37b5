#include "apps/options/channel_list.h"

#include <algorithm>
#include <optional>

#include "apps/shell/values.h"
#include "fathom/failures/errors.h"
#include "fathom/image/missing_channel.h"

namespace fathom::app {

std::vector<Channel> parse_channels(const std::string& list) {
  std::vector<Channel> channels;
  for (const std::string& name : parse_list(list)) {
    const std::optional<Channel> channel = channel_named(name);
    if (!channel) throw unknown_channel(name);
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
