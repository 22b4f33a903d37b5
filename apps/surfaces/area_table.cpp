#include "apps/surfaces/area_table.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "fathom/failures/errors.h"
#include "fathom/text/ascii.h"
#include "fathom/text/csv.h"
#include "fathom/text/printable.h"

namespace fathom::app {
namespace {

using files::put_number;

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
  for (const std::string& column : columns_) line += "," + text::csv_name(column);
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
      "{},{},{},{},{},{},{},{},{},{},{}", light, text::csv_name(item.name), name_of(form_.kind),
      item.number, field_of(item.object), field_of(item.face), area.side ? name_of(*area.side) : "",
      field_of(area.projected), field_of(area.visible), field_of(area.fraction), area.lit);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    line += area.centroid ? fmt::format(",{}", (*area.centroid)[axis]) : ",";
  }
  if (!list_.lights.empty()) {
    for (const std::string& field : list_.lights[light].fields) line += "," + text::csv_name(field);
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

namespace {

std::u32string characters_of(const std::string& text) {
  const std::string shown = text::printable(text);
  std::u32string characters;
  for (std::string_view rest = shown; !rest.empty();) {
    const text::Utf8Character first = text::first_character(rest);
    characters += first.code;
    rest.remove_prefix(first.size);
  }
  return characters;
}

double or_nan(const std::optional<double>& number) {
  return number.value_or(std::numeric_limits<double>::quiet_NaN());
}

std::int8_t sign_of(LitSide side) {
  return side == LitSide::edge ? 0 : side == LitSide::front ? 1 : -1;
}

}  // namespace

AreaArrays::AreaArrays(AreaItemKind kind, const AreaItems& items, const LightList& list,
                       std::size_t light_count)
    : has_sides_(kind == AreaItemKind::triangle) {
  const std::vector<std::uint64_t> shape{light_count, items.items.size()};
  for (const char* name : {"projected", "visible", "fraction", "lit"}) add(name, "<f8", 8, shape);
  add("centroid", "<f8", 8, {shape[0], shape[1], 3});
  if (has_sides_) add("side", "|i1", 1, shape);
  add_items(items);
  add_lights(list);
}

void AreaArrays::add(const std::string& name, const std::string& type, std::size_t bytes,
                     std::vector<std::uint64_t> shape) {
  arrays_.push_back({name, type, bytes, std::move(shape)});
}

void AreaArrays::add_other(const std::string& name, const std::string& type,
                           std::size_t element_bytes, std::vector<std::uint64_t> shape,
                           files::Bytes bytes) {
  add(name, type, element_bytes, std::move(shape));
  others_.push_back(std::move(bytes));
}

void AreaArrays::add_texts(const std::string& name, const std::vector<std::string>& texts) {
  std::vector<std::u32string> characters;
  std::size_t longest = 1;
  for (const std::string& text : texts) {
    longest = std::max(longest, characters.emplace_back(characters_of(text)).size());
  }
  files::Bytes bytes;
  for (std::u32string& each : characters) {
    each.resize(longest);
    for (const char32_t c : each) put_number(bytes, static_cast<std::uint32_t>(c));
  }
  add_other(name, "<U" + std::to_string(longest), 4 * longest, {texts.size()}, std::move(bytes));
}

void AreaArrays::add_items(const AreaItems& items) {
  std::vector<std::string> names;
  files::Bytes numbers, objects, faces;
  for (const AreaItem& item : items.items) {
    names.push_back(item.name);
    put_number(numbers, item.number);
    if (item.object) put_number(objects, *item.object);
    if (item.face) put_number(faces, *item.face);
  }
  const std::uint64_t count = names.size();
  add_texts("names", names);
  add_other("number", "<u8", 8, {count}, std::move(numbers));
  if (objects.empty()) return;
  add_other("object", "<u4", 4, {count}, std::move(objects));
  add_other("face", "<u4", 4, {count}, std::move(faces));
}

void AreaArrays::add_lights(const LightList& list) {
  if (list.lights.empty()) return;
  files::Bytes numbers;
  for (const LightList::Light& light : list.lights) {
    for (const double number : light.numbers) put_number(numbers, number);
  }
  add_other("lights", "<f8", 8, {list.lights.size(), 3}, std::move(numbers));
  std::vector<std::string> taken;
  for (const NpzRows::Array& array : arrays_) taken.push_back(array.name);
  const std::vector<std::string> names = free_names(list.headings, taken);
  for (std::size_t k = 0; k < names.size(); ++k) {
    std::vector<std::string> texts;
    for (const LightList::Light& light : list.lights) texts.push_back(light.fields[k]);
    add_texts(names[k], texts);
  }
}

std::vector<files::Bytes> AreaArrays::rows(const std::vector<LitArea>& areas) const {
  files::Bytes projected, visible, fraction, lit, centroid, side;
  for (const LitArea& area : areas) {
    put_number(projected, or_nan(area.projected));
    put_number(visible, or_nan(area.visible));
    put_number(fraction, or_nan(area.fraction));
    put_number(lit, area.lit);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      put_number(centroid, area.centroid ? (*area.centroid)[axis] : or_nan({}));
    }
    if (has_sides_) put_number(side, sign_of(area.side.value_or(LitSide::edge)));
  }
  std::vector<files::Bytes> rows;
  for (files::Bytes* bytes : {&projected, &visible, &fraction, &lit, &centroid}) {
    rows.push_back(std::move(*bytes));
  }
  if (has_sides_) rows.push_back(std::move(side));
  return rows;
}

void AreaArrays::append_others(NpzRows& file) const {
  const std::size_t first = arrays_.size() - others_.size();
  for (std::size_t k = 0; k < others_.size(); ++k) file.append(first + k, others_[k]);
}

}  // namespace fathom::app
