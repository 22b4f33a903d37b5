#pragma once

#include <utility>
#include <vector>

namespace fathom::checks {

/// A ring by its corners' coordinates.
using Corners = std::vector<std::pair<double, double>>;

}  // namespace fathom::checks
