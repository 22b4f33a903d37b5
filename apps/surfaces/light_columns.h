#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "fathom/text/printable.h"

namespace fathom::app {

/// Names for the columns that are copied from a file of lights, none of which is `taken`: those
/// that are begin with "light_".
inline std::vector<std::string> free_names(const std::vector<std::string>& headings,
                                           const std::vector<std::string>& taken) {
  std::vector<std::string> names;
  for (const std::string& heading : headings) names.push_back(text::printable(heading));
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto is_taken = [&](const std::string& name) {
      return std::ranges::find(taken, name) != taken.end() ||
             std::ranges::count(names, name) > (name == names[k] ? 1 : 0);
    };
    std::string name = names[k];
    while (is_taken(name)) name = "light_" + name;
    names[k] = name;
  }
  return names;
}

}  // namespace fathom::app
