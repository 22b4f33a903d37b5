#include "fathom/image/missing_channel.h"

#include <algorithm>

#include "fathom/image/channel_table.h"
#include "fathom/image/files/npy_array.h"

namespace fathom {
namespace {

/// What other programs and people call a channel.
struct OtherName {
  std::string_view other, name;
};
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
                                                       {"normal", "N"},
                                                       {"normals", "N"},
                                                       {"position", "P"},
                                                       {"positions", "P"},
                                                       {"points", "P"},
                                                       {"barycentric", "bary"}});

std::string in_small_letters(std::string text) {
  for (char& c : text) c = 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

/// "N" of "N.X" where the map has all parts of N; else the name.
std::string name_for_users(const DepthMap& map, const std::string& name) {
  const std::string stem = name.substr(0, name.rfind('.'));
  const auto channel = channel_named(stem);
  if (stem == name || !channel || description_of(*channel).parts.empty()) return name;
  const std::vector<std::string> parts = part_names(*channel);
  const auto is_there = [&](const std::string& part) { return map.find(part) != nullptr; };
  return std::ranges::all_of(parts, is_there) ? stem : name;
}

/// `message`, and behind it the names that may be meant.
UnknownName channel_suggested(const std::string& message, const std::string& name,
                              std::vector<std::string> names) {
  const auto other = std::ranges::find(other_names, in_small_letters(name), &OtherName::other);
  const bool is_meant = nearest_names(name, names).empty() && other != other_names.end() &&
                        std::ranges::find(names, other->name) != names.end();
  const std::string meant =
      is_meant ? "; " + did_you_mean({std::string(other->name)}) : std::string();
  return {message + meant, name, std::move(names)};
}

}  // namespace

UnknownName unknown_channel(const std::string& name) {
  return channel_suggested("there is no channel '" + name + "'; there are " + channel_names(), name,
                           names_of_channels());
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
  return channel_suggested(which + " has no channel '" + name + "', only " + joined(names, ", "),
                           name, names);
}

UsageError ambiguous_channel(const std::vector<std::string>& names, const std::string& refusal,
                             const std::string& use) {
  return {Setting{"channel"}, refusal + " " + joined(names, ", ") + "; name the one to " + use};
}

}  // namespace fathom
