#pragma once

#include <string>
#include <vector>

#include "fathom/pipeline/scan/pixels.h"

namespace fathom::pipeline {

/// A picture of characters, one per pixel, a string per row; all rows have the same length.
using CharacterGrid = std::vector<std::string>;

enum class Connectivity { four = 4, eight = 8 };

/// The pixels that are connected with the seed through pixels of its own character, in row order;
/// none if the seed is outside. Works on spans with a stack of its own: its memory grows with the
/// outline, and no picture is too large for the machine's stack.
/// Source   [Smi79]
std::vector<Pixel> flood_fill(const CharacterGrid& grid, const Pixel& seed,
                              Connectivity connectivity);

}  // namespace fathom::pipeline
