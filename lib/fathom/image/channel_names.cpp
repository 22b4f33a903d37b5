#include "fathom/image/channel_names.h"

#include <algorithm>
#include <set>

#include "fathom/failures/errors.h"
#include "fathom/failures/unknown_name.h"
#include "fathom/image/channel_table.h"
#include "fathom/image/files/npy_array.h"

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

namespace {

/// What other programs and people call a channel.
constexpr auto other_names = std::to_array<OtherName>({{"depth", "Z"},
                                                       {"depths", "Z"},
                                                       {"planar", "Z"},
                                                       {"alpha", "A"},
                                                       {"coverage", "A"},
                                                       {"range", "distance"},
                                                       {"ray", "distance"},
                                                       {"triangle", "id"},
                                                       {"mask", "object"},
                                                       {"instance", "object"},
                                                       {"segmentation", "object"},
                                                       {"seg", "object"},
                                                       {"semantic", "label"},
                                                       {"semantics", "label"},
                                                       {"normal", "N"},
                                                       {"normals", "N"},
                                                       {"position", "P"},
                                                       {"positions", "P"},
                                                       {"points", "P"},
                                                       {"barycentric", "bary"}});

/// "N" of "N.X" where the map has all parts of N; else the name.
std::string name_for_users(const DepthMap& map, const std::string& name) {
  const std::string stem = name.substr(0, name.rfind('.'));
  const auto channel = channel_named(stem);
  if (stem == name || !channel || description_of(*channel).parts.empty()) return name;
  const std::vector<std::string> parts = part_names(*channel);
  const auto is_there = [&](const std::string& part) { return map.find(part) != nullptr; };
  return std::ranges::all_of(parts, is_there) ? stem : name;
}

}  // namespace

UnknownName unknown_channel(const std::string& name) {
  return unknown_name("there is no channel '" + name + "'; there are " + channel_names(), name,
                      names_of_channels(), other_names);
}

const ContentsName* contents_named(std::string_view name) {
  const auto* const found = std::ranges::find(contents_table, name, &ContentsName::name);
  return found == contents_table.end() ? nullptr : found;
}

std::string own_channel_name(const DepthMap& map, const std::string& name) {
  const ContentsName* const contents = contents_named(name);
  if (contents == nullptr || contents->is_mask || map.find(name) != nullptr) return name;
  return std::string(description_of(contents->channel).name);
}

UnknownName unknown_contents(const std::string& name) {
  std::vector<std::string> names = names_of_channels();
  for (const ContentsName& each : contents_table) names.emplace_back(each.name);
  return unknown_name("there is no channel '" + name + "'; there are " + joined(names), name, names,
                      other_names);
}

std::vector<std::string> names_of_channels(const DepthMap& map) {
  std::vector<std::string> names;
  for (const ImageChannel& channel : map.channels) {
    const std::string name = name_for_users(map, channel.name);
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return names;
}

std::string list_of_channels(const DepthMap& map) {
  return joined(names_of_channels(map), ", ");
}

std::string text_of_parts(const DepthMap& map, const std::string& name) {
  std::vector<std::string> names;
  for (const ImageChannel* part : image::parts_of(map, name)) names.push_back(part->name);
  return names.empty() ? "" : name + " is " + joined(names, ", ");
}

UsageError missing_channel(const DepthMap& map, const std::string& name, const std::string& which) {
  const std::string parts = text_of_parts(map, name);
  if (!parts.empty()) return UsageError(parts + "; name one");
  const std::vector<std::string> names = names_of_channels(map);
  return unknown_name(which + " has no channel '" + name + "', only " + joined(names, ", "), name,
                      names, other_names);
}

UsageError ambiguous_channel(const std::vector<std::string>& names, const std::string& refusal,
                             const std::string& use) {
  return {Setting{"channel"}, refusal + " " + joined(names, ", ") + "; name the one to " + use};
}

}  // namespace fathom
