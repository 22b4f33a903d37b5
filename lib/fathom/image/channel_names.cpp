#include "fathom/image/channel_names.h"

#include <algorithm>
#include <utility>

#include "fathom/failures/errors.h"
#include "fathom/failures/unknown_name.h"
#include "fathom/image/channel_table.h"
#include "fathom/image/files/npy_array.h"

namespace fathom {
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

UnknownName unknown_channel(const std::string& name, const std::vector<std::string>& names) {
  return unknown_name("there is no channel '" + name + "'; there are " + joined(names), name, names,
                      other_names);
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
  return unknown_channel(name, names);
}

std::string meaning_of(const std::string& channel) {
  if (const auto ours = channel_named(channel)) return std::string(description_of(*ours).meaning);
  const AddedChannel* const added = added_channel_named(channel);
  return added ? std::string(added->meaning) : std::string();
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
