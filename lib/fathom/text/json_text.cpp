#include "fathom/text/json_text.h"

#include <nlohmann/json.hpp>

#include "fathom/text/parse_json.h"

namespace fathom::text {

std::string json_string(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string joined_in(char open, const std::vector<std::string>& parts, char close) {
  std::string text(1, open);
  for (const std::string& part : parts) {
    if (text.size() > 1) text += ',';
    text += part;
  }
  return text + close;
}

std::optional<std::vector<std::string>> strings_of_json(std::string_view text) {
  nlohmann::json list;
  try {
    parse_json(text, list);
  } catch (const JsonFault&) {
    return std::nullopt;
  }
  if (!list.is_array()) return std::nullopt;
  std::vector<std::string> strings;
  for (const nlohmann::json& entry : list) {
    if (!entry.is_string()) return std::nullopt;
    strings.push_back(entry.get<std::string>());
  }
  return strings;
}

std::optional<std::vector<std::pair<std::string, std::string>>> string_members_of_json(
    std::string_view text) {
  nlohmann::ordered_json object;
  try {
    parse_json(text, object);
  } catch (const JsonFault&) {
    return std::nullopt;
  }
  if (!object.is_object()) return std::nullopt;
  std::vector<std::pair<std::string, std::string>> members;
  for (const auto& [key, value] : object.items()) {
    if (value.is_string()) members.emplace_back(key, value.get<std::string>());
  }
  return members;
}

}  // namespace fathom::text
