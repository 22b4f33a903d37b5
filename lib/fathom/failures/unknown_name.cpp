#include "fathom/failures/unknown_name.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

namespace fathom {
namespace {

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool differ_by_case_alone(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return lower(x) == lower(y); });
}

/// Optimal string alignment: the least number of letters to insert, remove, replace, or exchange
/// with their neighbour, where no letter is touched twice.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  const std::size_t columns = b.size() + 1;
  std::vector<std::size_t> table((a.size() + 1) * columns);
  const auto at = [&](std::size_t i, std::size_t j) -> std::size_t& {
    return table[i * columns + j];
  };
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        at(i, j) = i + j;
        continue;
      }
      const std::size_t replaced = at(i - 1, j - 1) + (a[i - 1] == b[j - 1] ? 0 : 1);
      at(i, j) = std::min({at(i - 1, j) + 1, at(i, j - 1) + 1, replaced});
      const bool exchanged = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (exchanged) at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 1);
    }
  }
  return table.back();
}

/// The greatest distance of a misspelling from a name. It is below the length of the name, so that
/// a misspelling keeps at least one letter.
std::size_t reach(std::string_view name) {
  if (name.size() < 2) return 0;
  return name.size() < 6 ? 1 : 2;
}

/// The names that begin with `start`, in upper or lower case; none if more than three do or if
/// `start` has less than three letters.
std::vector<std::string> names_that_begin_with(std::string_view start,
                                               const std::vector<std::string>& names) {
  std::vector<std::string> found;
  if (start.size() < 3) return found;
  for (const std::string& each : names)
    if (differ_by_case_alone(start, std::string_view(each).substr(0, start.size())))
      found.push_back(each);
  if (found.size() > 3) found.clear();
  return found;
}

}  // namespace

std::vector<std::string> nearest_names(std::string_view name,
                                       const std::vector<std::string>& names) {
  std::vector<std::string> nearest;
  std::size_t least = std::numeric_limits<std::size_t>::max();
  for (const std::string& each : names) {
    const std::size_t distance = differ_by_case_alone(name, each) ? 0 : edit_distance(name, each);
    if (distance > reach(each) || distance > least) continue;
    if (distance < least) nearest.clear();
    least = distance;
    nearest.push_back(each);
  }
  return nearest;
}

std::string did_you_mean(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names)
    text += (text.empty() ? "did you mean '" : " or '") + name + "'";
  return text.empty() ? text : text + "?";
}

std::string suggestion(std::string_view name, const std::vector<std::string>& names) {
  std::vector<std::string> meant = nearest_names(name, names);
  if (meant.empty()) meant = names_that_begin_with(name, names);
  return meant.empty() ? "" : "; " + did_you_mean(meant);
}

std::string joined(const std::vector<std::string>& names, std::string_view last) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 < names.size() ? ", " : last;
    text += names[i];
  }
  return text;
}

UnknownName::UnknownName(const std::string& message, std::string name,
                         std::vector<std::string> names)
    : UsageError(message.ends_with('?') ? message : message + suggestion(name, names)),
      name_(std::move(name)),
      names_(std::move(names)) {}

namespace {

/// A to Z as a to z, without hyphens, underscores, blanks and the prefix of a graphics interface.
std::string plain(std::string_view name) {
  for (const std::string_view prefix : {"GL_", "VK_FORMAT_", "DXGI_FORMAT_"})
    if (name.starts_with(prefix)) name.remove_prefix(prefix.size());
  std::string letters;
  for (const char c : name) {
    if (c == '-' || c == '_' || c == ' ') continue;
    letters += lower(c);
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
