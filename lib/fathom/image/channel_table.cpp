#include "fathom/image/channel_table.h"

#include <algorithm>

#include "fathom/failures/unknown_name.h"

namespace fathom {
namespace {

constexpr bool is_in_order() {
  for (std::size_t i = 0; i < channel_table.size(); ++i) {
    if (static_cast<std::size_t>(channel_table[i].channel) != i) return false;
  }
  return true;
}
static_assert(is_in_order(), "description_of() counts on it");

}  // namespace

std::optional<Channel> channel_named(std::string_view name) {
  const auto found = std::find_if(channel_table.begin(), channel_table.end(),
                                  [&](const ChannelDescription& d) { return d.name == name; });
  if (found == channel_table.end()) return std::nullopt;
  return found->channel;
}

const AddedChannel* added_channel_named(std::string_view name) {
  const auto* const found = std::ranges::find(added_channels, name, &AddedChannel::name);
  return found == added_channels.end() ? nullptr : found;
}

std::vector<std::string> part_names(Channel channel) {
  const ChannelDescription& d = description_of(channel);
  if (d.parts.empty()) return {std::string(d.name)};
  std::vector<std::string> names;
  names.reserve(d.parts.size());
  for (const char part : d.parts) names.push_back(std::string(d.name) + "." + part);
  return names;
}

bool shows_segments(std::string_view channel) {
  return std::ranges::any_of(segment_channels,
                             [&](Channel c) { return description_of(c).name == channel; });
}

std::vector<std::string> names_of_channels() {
  std::vector<std::string> names;
  names.reserve(channel_table.size());
  for (const ChannelDescription& channel : channel_table) names.emplace_back(channel.name);
  return names;
}

std::string channel_names() {
  return joined(names_of_channels());
}

}  // namespace fathom
