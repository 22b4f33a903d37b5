#pragma once

#include <string>
#include <vector>

#include "fathom/rays/ray.h"

namespace fathom::app {

/// Reads rays from a file:
///   CSV   a heading with the columns x, y, z (origin) and dx, dy, dz (direction), in any order,
///         then a line for each ray; each number is rounded once to binary64
///   NPY   an array of shape N×6, of binary64 or binary32: origin and direction in each row
/// "-" is standard input.
/// Fails    InputError "FILE: line N: …" or "FILE: row N: …": another column, a number that is not
///          finite, a direction of 0; no ray.
std::vector<Ray> read_rays(const std::string& file);

}  // namespace fathom::app
