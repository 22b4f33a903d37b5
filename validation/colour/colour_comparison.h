#pragma once

#include <cstddef>
#include <vector>

#include "validation/colour/expected_colour.h"

namespace fathom::validation {

/// What a renderer drew, and how.
struct Drawn {
  const GreyPicture* picture = nullptr;
  LightModel model{};
  Precision precision;
};

/// A pixel that no bound explains.
struct UnexplainedPixel {
  int x = 0, y = 0;
  int ours = 0, theirs = 0;
  Codes expected_of_ours, expected_of_theirs;
};

struct ColourComparison {
  std::size_t background = 0;   ///< pixels that nothing can touch, black in both
  std::size_t inside = 0;       ///< pixels in which one triangle alone can be seen
  std::size_t edge = 0;         ///< pixels in which one of several, or the background, is seen
  std::size_t equal = 0;        ///< of those inside, with the same code in both
  int greatest_difference = 0;  ///< of codes, inside
  /// Inside, of the difference of the two codes, as the bounds allow it: their mean, and greatest.
  double mean_bound = 0;
  int greatest_bound = 0;
  std::size_t within_one = 0;                 ///< pixels inside whose bound is at most 1
  std::vector<UnexplainedPixel> unexplained;  ///< inside, edge or background
};

/// Holds each pixel of both pictures against what its renderer may draw. A pixel at an edge is
/// explained by any triangle that may be seen there, or by the background if none surely covers it.
ColourComparison compare_colours(const LitScene& scene, const Drawn& ours, const Drawn& theirs);

}  // namespace fathom::validation
