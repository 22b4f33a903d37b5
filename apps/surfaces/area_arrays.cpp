#include "apps/surfaces/area_arrays.h"

#include <algorithm>
#include <limits>
#include <string_view>
#include <utility>

#include "apps/surfaces/light_columns.h"
#include "fathom/text/printable.h"

namespace fathom::app {
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
    for (const char32_t c : each) put(bytes, static_cast<std::uint32_t>(c));
  }
  add_other(name, "<U" + std::to_string(longest), 4 * longest, {texts.size()}, std::move(bytes));
}

void AreaArrays::add_items(const AreaItems& items) {
  std::vector<std::string> names;
  files::Bytes numbers, objects, faces;
  for (const AreaItem& item : items.items) {
    names.push_back(item.name);
    put(numbers, item.number);
    if (item.object) put(objects, *item.object);
    if (item.face) put(faces, *item.face);
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
    for (const double number : light.numbers) put(numbers, number);
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
    put(projected, or_nan(area.projected));
    put(visible, or_nan(area.visible));
    put(fraction, or_nan(area.fraction));
    put(lit, area.lit);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      put(centroid, area.centroid ? (*area.centroid)[axis] : or_nan({}));
    }
    if (has_sides_) put(side, sign_of(area.side.value_or(LitSide::edge)));
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
