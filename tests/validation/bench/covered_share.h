#pragma once

#include <algorithm>
#include <cmath>

#include "fathom/render.h"
#include "validation/scenes/scenes.h"

namespace fathom::checks {

/// The share of a bench scene's pixels that show a surface.
inline double covered_share(const bench::BenchScene& bench) {
  const DepthMap map = render(bench.scene, bench.camera, {.engine = Engine::fast}).map;
  const Samples<float>& Z = *map.values<float>("Z");
  const auto covered = std::count_if(Z.begin(), Z.end(), [](float z) { return std::isfinite(z); });
  return static_cast<double>(covered) / static_cast<double>(Z.size());
}

}  // namespace fathom::checks
