#include "fathom/image/map_formats.h"

#include <algorithm>
#include <vector>

#include "fathom/failures/errors.h"
#include "fathom/failures/unknown_name.h"
#include "fathom/text/ascii.h"

namespace fathom {
namespace {

constexpr bool is_in_order() {
  for (std::size_t i = 0; i < map_format_table.size(); ++i)
    if (static_cast<std::size_t>(map_format_table[i].format) != i) return false;
  return true;
}
static_assert(is_in_order(), "description_of() counts on it");

/// Of the formats for which `is_meant` is true, `name` of each.
template <class Meant, class Name>
std::vector<std::string> listed(const Meant& is_meant, const Name& name) {
  std::vector<std::string> names;
  for (const MapFormatDescription& format : map_format_table)
    if (is_meant(format)) names.emplace_back(name(format));
  return names;
}

std::string_view suffix_of(const MapFormatDescription& format) {
  return format.suffixes[0];
}

}  // namespace

std::optional<MapFormat> map_format_of(const std::filesystem::path& path) {
  const std::string suffix = text::in_small_letters(path.extension().string());
  if (suffix.empty()) return std::nullopt;
  for (const MapFormatDescription& format : map_format_table)
    if (std::ranges::count(format.suffixes, suffix) > 0) return format.format;
  return std::nullopt;
}

MapFormat require_map_format(const std::filesystem::path& path) {
  if (const auto format = map_format_of(path)) return *format;
  throw UsageError(path.string() + ": expected a name that ends in " + suffixes_of_maps());
}

std::string suffixes_of_maps(std::string_view last) {
  return joined(listed([](const auto&) { return true; }, suffix_of), last);
}

std::string suffixes_of_float_maps() {
  return joined(listed([](const auto& format) { return format.holds_floats; }, suffix_of), " or ");
}

std::string suffixes_of_complete_maps(std::string_view last) {
  return joined(
      listed([](const auto& format) { return keeps_all_channels(format.format); }, suffix_of),
      last);
}

std::string suffixes_for_any_channel() {
  return joined(
      listed([](const auto& format) { return holds_any_channel(format.format); }, suffix_of),
      " or ");
}

std::string names_of_readable_maps() {
  return joined(listed([](const auto& format) { return format.is_read; },
                       [](const auto& format) { return format.name; }),
                " or ");
}

void require_size(MapFormat format, std::uint32_t width, std::uint32_t height,
                  const std::string& name) {
  const MapFormatDescription& held = description_of(format);
  if (std::max(width, height) > held.greatest_side ||
      std::uint64_t{width} * height >= held.pixels_beyond) {
    throw OutputError(name + ": " + std::string(held.limit));
  }
}

}  // namespace fathom
