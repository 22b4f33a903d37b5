#pragma once

#include <vector>

namespace fathom::studies {

/// A grating that is sampled once a pixel; frequencies in cycles a pixel.
struct GratingSeen {
  double frequency;
  double apparent;  ///< the strongest in its samples
};

/// Gratings up to 1.5 cycles a pixel.
std::vector<GratingSeen> gratings_seen();

}  // namespace fathom::studies
