#include "fathom/image/channel_table.h"

#include <algorithm>

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

std::vector<std::string> part_names(Channel channel) {
  const ChannelDescription& d = description_of(channel);
  if (d.parts.empty()) return {std::string(d.name)};
  std::vector<std::string> names;
  names.reserve(d.parts.size());
  for (const char part : d.parts) names.push_back(std::string(d.name) + "." + part);
  return names;
}

bool shows_segments(std::string_view channel) {
  return channel == "material" || channel == "group" || channel == "part" || channel == "label";
}

std::string channel_names() {
  std::string names;
  for (std::size_t i = 0; i < channel_table.size(); ++i) {
    if (i > 0) names += i + 1 == channel_table.size() ? " and " : ", ";
    names += channel_table[i].name;
  }
  return names;
}

}  // namespace fathom
