#pragma once

#include <limits>
#include <span>
#include <vector>

#include "fathom/attribution/fragment.h"
#include "fathom/mesh/mesh.h"

namespace fathom::attribution {

/// The allowed values of a sample with these fragments.
struct PixelVerdict {
  /// Nothing farther than this can be stored; infinite where nothing need be covered.
  double cap = std::numeric_limits<double>::infinity();
  /// Some surface is certain to be seen.
  bool must = false;
  /// Some surface would be seen if no sample between two triangles were missed.
  bool must_if_watertight = false;
};

/// `triangles` and `numbers` of the mesh. If a renderer is watertight, fragments that share all
/// edges that the model leaves open together count as certain (docs/validation.md, "Together").
PixelVerdict verdict_of(std::span<const Fragment> fragments, bool watertight,
                        std::span<const CornerIndices> triangles,
                        const std::vector<std::uint32_t>& numbers);

}  // namespace fathom::attribution
