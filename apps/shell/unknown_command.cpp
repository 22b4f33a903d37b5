#include "apps/shell/unknown_command.h"

#include <fmt/core.h>

#include <algorithm>
#include <numeric>
#include <string_view>

#include "apps/shell/values.h"

namespace fathom::app {
namespace {

/// Levenshtein's distance: the least number of letters to insert, remove or replace.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
      diagonal = above;
    }
  }
  return row.back();
}

}  // namespace

std::string unknown_command(const std::string& name, const std::vector<std::string>& existing) {
  const auto nearest = std::min_element(existing.begin(), existing.end(),
                                        [&](const std::string& a, const std::string& b) {
                                          return edit_distance(name, a) < edit_distance(name, b);
                                        });
  const bool near = nearest != existing.end() && edit_distance(name, *nearest) <= 2;
  return fmt::format("there is no command '{}'{}; the commands are {}", name,
                     near ? fmt::format(": did you mean '{}'?", *nearest) : "", joined(existing));
}

}  // namespace fathom::app
