#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/validate/colour_pairs.h"

namespace fathom::app {

/// A scene and a pair of pictures of it, or why there are none.
struct ColourCase {
  std::string scene;
  const ColourPair* pair = nullptr;
  std::string failure;
  std::optional<validation::GreyPicture> ours, theirs;
  validation::ColourComparison found;
};

/// Prints a line for each case and, where `out` is not empty, writes colours.json and a picture for
/// each case to that folder, which exists: ours on the left, VTK's on the right. Returns the exit
/// status.
int report_colours(const std::vector<ColourCase>& cases, const std::string& out);

}  // namespace fathom::app
