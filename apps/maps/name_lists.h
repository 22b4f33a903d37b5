#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <vector>

#include "apps/shell/values.h"
#include "fathom/text/printable.h"

namespace fathom::app {

/// A line of `fathom info` with the first names of a list, and how many more there are; nothing for
/// an empty list.
inline std::string name_line(const std::string& what, const std::vector<std::string>& names) {
  if (names.empty()) return "";
  constexpr std::size_t most = 50;
  const auto end = names.begin() + static_cast<std::ptrdiff_t>(std::min(most, names.size()));
  std::string text =
      fmt::format("  {:<10} {}", what, text::printable(joined({names.begin(), end}, ", ")));
  if (names.size() > most) text += fmt::format(" and {} more", names.size() - most);
  return text + "\n";
}

}  // namespace fathom::app
