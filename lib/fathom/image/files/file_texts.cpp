#include "fathom/image/files/file_texts.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "fathom/failures/errors.h"
#include "fathom/text/json_text.h"

namespace fathom::image {
using namespace text;

double read_scale(const std::string& text, const std::string& name) {
  double scale = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), scale);
  if (error != std::errc() || end != text.data() + text.size() || !(scale > 0) ||
      !std::isfinite(scale)) {
    throw InputError(name + ": its fathom:scale is '" + text.substr(0, 40) +
                     "': expected a positive number");
  }
  return scale;
}

namespace {

constexpr std::array<std::string_view, 4> named_channels{"object", "material", "group", "part"};

std::string text_name_of(std::string_view channel) {
  return "fathom." + std::string(channel) + "s";
}

/// The channel whose names a text lists.
std::optional<std::string_view> channel_of_text(std::string_view text_name) {
  const auto found = std::ranges::find_if(
      named_channels, [&](std::string_view channel) { return text_name_of(channel) == text_name; });
  if (found == named_channels.end()) return std::nullopt;
  return *found;
}

std::string as_json(const std::vector<std::string>& names) {
  std::vector<std::string> strings;
  strings.reserve(names.size());
  for (const std::string& name : names) strings.push_back(json_string(name));
  return joined_in('[', strings, ']');
}

}  // namespace

bool is_name_table(std::string_view text_name) {
  return channel_of_text(text_name).has_value();
}

const std::vector<std::string>* names_of_channel(const DepthMap& map, const std::string& channel) {
  if (channel == "object") return map.object_names.empty() ? nullptr : &map.object_names;
  const auto found = map.tables.find(channel);
  return found == map.tables.end() || found->second.empty() ? nullptr : &found->second;
}

std::map<std::string, std::string> name_tables(const DepthMap& map) {
  std::map<std::string, std::string> texts;
  for (const std::string_view channel : named_channels)
    if (const auto* names = names_of_channel(map, std::string(channel)))
      texts[text_name_of(channel)] = as_json(*names);
  return texts;
}

void take_name_table(const std::string& text_name, const std::string& text, DepthMap& map) {
  const auto channel = channel_of_text(text_name);
  if (!channel) return;
  std::vector<std::string> names = strings_of_json(text).value_or(std::vector<std::string>());
  if (*channel == "object") {
    map.object_names = std::move(names);
  } else if (!names.empty()) {
    map.tables[std::string(*channel)] = std::move(names);
  }
}

}  // namespace fathom::image
