#include "apps/study/summary.h"

#include <nlohmann/json.hpp>

namespace fathom::studies {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Cell& cell) {
  return std::visit(
      [](const auto& value) -> Json {
        if constexpr (std::is_same_v<decltype(value), const std::monostate&>) {
          return nullptr;
        } else {
          return value;  // numbers that are not finite are written as null
        }
      },
      cell.value);
}

/// The place in an object that a key names: see Column::json.
Json& place_in(Json& object, const std::string& key) {
  if (key.ends_with("[]")) return object[key.substr(0, key.size() - 2)].emplace_back(nullptr);
  const std::size_t point = key.find('.');
  if (point == std::string::npos) return object[key];
  return object[key.substr(0, point)][key.substr(point + 1)];
}

Json json_of(const Table& table) {
  Json list = Json::array();
  for (const std::vector<Cell>& row : table.rows()) {
    Json object = Json::object();
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string& key = table.columns()[i].json_key;
      if (!key.empty()) place_in(object, key) = json_of(row[i]);
    }
    list.push_back(std::move(object));
  }
  return list;
}

}  // namespace

std::string json_of(const Summary& summary) {
  Json json = Json::object();
  for (const auto& [key, content] : summary) {
    place_in(json, key) = std::visit([](const auto& c) { return json_of(c); }, content);
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace fathom::studies
