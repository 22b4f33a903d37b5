#include "apps/surfaces/area_table.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/surfaces/csv_field.h"
#include "apps/surfaces/light_columns.h"
#include "fathom/failures/errors.h"
#include "fathom/text/printable.h"
#include "fathom/text/small_letters.h"

namespace fathom::app {
namespace {

using Json = nlohmann::ordered_json;

const std::vector<std::string>& own_columns() {
  static const std::vector<std::string> columns{
      "direction", "name",    "kind",     "number", "object", "face", "side",
      "projected", "visible", "fraction", "lit",    "x",      "y",    "z"};
  return columns;
}

const char* name_of(LitSide side) {
  switch (side) {
    case LitSide::front:
      return "front";
    case LitSide::back:
      return "back";
    case LitSide::edge:
      break;
  }
  return "edge";
}

template <class Number>
std::string field_of(const std::optional<Number>& number) {
  return number ? fmt::format("{}", *number) : "";
}

/// JSON has no infinity, and null is a value that is not defined.
Json json_of(double number) {
  return std::isfinite(number) ? Json(number) : Json(fmt::format("{}", number));
}
Json json_of(std::uint32_t number) {
  return number;
}
template <class Number>
Json json_of(const std::optional<Number>& number) {
  return number ? json_of(*number) : Json(nullptr);
}

}  // namespace

TableFormat table_format_of(const std::string& file, bool wants_json) {
  const std::string suffix =
      text::in_small_letters(std::filesystem::path(file).extension().string());
  if (suffix == ".json") return TableFormat::json;
  if (suffix != ".csv" && suffix != ".npz" && !suffix.empty()) {
    throw UsageError("'" + file + "' does not end in .csv, .npz or .json");
  }
  if (!suffix.empty() && wants_json) {
    throw UsageError("'" + file + "' is a name of " + (suffix == ".csv" ? "CSV" : "NPZ") +
                     ", and --json asks for JSON");
  }
  if (suffix == ".npz") return TableFormat::npz;
  return wants_json ? TableFormat::json : TableFormat::csv;
}

AreaTable::AreaTable(const Form& form, const AreaItems& items, const LightList& list)
    : form_(form), items_(items), list_(list), columns_(free_names(list.headings, own_columns())) {}

std::string AreaTable::beginning() const {
  if (form_.format == TableFormat::json) return "[";
  std::string line;
  for (const std::string& key : own_columns()) line += (line.empty() ? "" : ",") + key;
  for (const std::string& column : columns_) line += "," + quoted(column);
  return line + "\n";
}

std::string AreaTable::rows(std::size_t light, const std::vector<LitArea>& areas) const {
  std::string text;
  for (std::size_t k = 0; k < areas.size(); ++k) {
    // What is visible has a centroid, also if its area rounds to 0.
    if (form_.nonzero && !areas[k].centroid) continue;
    text += form_.format == TableFormat::json ? as_json(light, items_.items[k], areas[k])
                                              : as_csv(light, items_.items[k], areas[k]);
  }
  return text;
}

std::string_view AreaTable::after(std::string_view rows, bool is_first) const {
  const bool has_comma = form_.format == TableFormat::json && !rows.empty();
  return rows.substr(has_comma && is_first ? 1 : 0);
}

std::string AreaTable::end() const {
  return form_.format == TableFormat::json ? "\n]\n" : "";
}

std::string AreaTable::as_csv(std::size_t light, const AreaItem& item, const LitArea& area) const {
  std::string line = fmt::format(
      "{},{},{},{},{},{},{},{},{},{},{}", light, quoted(item.name), name_of(form_.kind),
      item.number, field_of(item.object), field_of(item.face), area.side ? name_of(*area.side) : "",
      field_of(area.projected), field_of(area.visible), field_of(area.fraction), area.lit);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    line += area.centroid ? fmt::format(",{}", (*area.centroid)[axis]) : ",";
  }
  if (!list_.lights.empty()) {
    for (const std::string& field : list_.lights[light].fields) line += "," + quoted(field);
  }
  return line + "\n";
}

std::string AreaTable::as_json(std::size_t light, const AreaItem& item, const LitArea& area) const {
  Json row{{"direction", light},
           {"name", text::printable(item.name)},
           {"kind", name_of(form_.kind)},
           {"number", item.number},
           {"object", json_of(item.object)},
           {"face", json_of(item.face)},
           {"side", area.side ? Json(name_of(*area.side)) : Json(nullptr)},
           {"projected", json_of(area.projected)},
           {"visible", json_of(area.visible)},
           {"fraction", json_of(area.fraction)},
           {"lit", json_of(area.lit)}};
  constexpr std::array axes{"x", "y", "z"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    row[axes[axis]] = area.centroid ? json_of((*area.centroid)[axis]) : Json(nullptr);
  }
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    row[columns_[k]] = text::printable(list_.lights[light].fields[k]);
  }
  return ",\n" + row.dump();
}

}  // namespace fathom::app
