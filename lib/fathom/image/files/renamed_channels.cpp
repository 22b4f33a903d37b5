#include "fathom/image/files/renamed_channels.h"

#include <algorithm>
#include <set>

#include "fathom/failures/errors.h"
#include "fathom/image/channel_names.h"

namespace fathom {
namespace {

bool is_name(const std::string& name) {
  return !name.empty() && name.find_first_of(std::string(",=\0", 3)) == std::string::npos;
}

/// "Z=Y,distance=D" as pairs; empty for a text of another form.
std::vector<ChannelName> names_in(const std::string& text) {
  std::vector<ChannelName> names;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string part = text.substr(begin, end - begin);
    const std::size_t middle = std::min(part.find('='), part.size());
    ChannelName name{part.substr(0, middle), part.substr(std::min(middle + 1, part.size()))};
    if (!is_name(name.channel) || !is_name(name.in_file)) return {};
    names.push_back(std::move(name));
    begin = end + 1;
  }
  return names;
}

/// The first name that two channels share; empty if all names differ.
std::string name_of_two(const DepthMap& map) {
  std::set<std::string> names;
  for (const ImageChannel& channel : map.channels)
    if (!names.insert(channel.name).second) return channel.name;
  return "";
}

}  // namespace

DepthMap with_channel_names(DepthMap map, const std::vector<ChannelName>& names) {
  require_valid(map);
  // All are found before any is renamed, so that two can change names.
  std::vector<ImageChannel*> found;
  std::string text;
  for (const auto& [channel, in_file] : names) {
    ImageChannel* const one = map.find(channel);
    if (one == nullptr) throw missing_channel(map, channel);
    if (std::find(found.begin(), found.end(), one) != found.end())
      throw UsageError("channel '" + channel + "' is given two names");
    if (!is_name(channel) || !is_name(in_file))
      throw UsageError("'" + in_file +
                       "' is not the name of a channel: expected a word without , and =");
    found.push_back(one);
    text += (text.empty() ? "" : ",") + channel + "=" + in_file;
  }
  for (std::size_t k = 0; k < names.size(); ++k) found[k]->name = names[k].in_file;
  if (const std::string name = name_of_two(map); !name.empty())
    throw UsageError("two channels would be called '" + name + "'");
  if (!text.empty()) map.texts[channel_names_text] = text;
  return map;
}

DepthMap with_own_channel_names(DepthMap map) {
  const auto text = map.texts.find(channel_names_text);
  if (text == map.texts.end()) return map;
  const std::vector<ChannelName> renamed = names_in(text->second);
  if (renamed.empty()) return map;
  std::vector<std::string> names;
  for (const ImageChannel& channel : map.channels) names.push_back(channel.name);
  for (const auto& [own, in_file] : renamed) {
    const ImageChannel* const channel = map.find(in_file);
    if (channel == nullptr) return map;
    names[static_cast<std::size_t>(channel - map.channels.data())] = own;
  }
  if (std::set<std::string>(names.begin(), names.end()).size() != names.size()) return map;
  for (std::size_t k = 0; k < names.size(); ++k) map.channels[k].name = names[k];
  map.texts.erase(text);
  return map;
}

}  // namespace fathom
