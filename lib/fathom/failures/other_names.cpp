#include "fathom/failures/other_names.h"

#include <algorithm>
#include <utility>

namespace fathom {
namespace {

/// A to Z as a to z, without hyphens, underscores, blanks and the prefix of a graphics interface.
std::string plain(std::string_view name) {
  for (const std::string_view prefix : {"GL_", "VK_FORMAT_", "DXGI_FORMAT_"})
    if (name.starts_with(prefix)) name.remove_prefix(prefix.size());
  std::string letters;
  for (const char c : name) {
    if (c == '-' || c == '_' || c == ' ') continue;
    letters += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return letters;
}

}  // namespace

std::optional<std::string_view> name_meant_by(std::string_view name,
                                              std::span<const OtherName> others) {
  std::optional<std::string_view> meant;
  for (const OtherName& each : others) {
    if (each.other != plain(name)) continue;
    if (meant) return std::nullopt;
    meant = each.name;
  }
  return meant;
}

UnknownName unknown_name(const std::string& message, const std::string& name,
                         std::vector<std::string> names, std::span<const OtherName> others) {
  std::vector<std::string> meant;
  if (nearest_names(name, names).empty()) {
    for (const OtherName& each : others) {
      const bool exists = std::ranges::find(names, each.name) != names.end();
      if (exists && each.other == plain(name)) meant.emplace_back(each.name);
    }
  }
  return {meant.empty() ? message : message + "; " + did_you_mean(meant), name, std::move(names)};
}

}  // namespace fathom
