#pragma once

#include <string>
#include <vector>

#include "fathom/attribution/model/recorded_depth.h"
#include "fathom/attribution/other_map.h"
#include "fathom/attribution/truth.h"

namespace fathom::attribution {

/// A formula by which what another map holds follows from the exact depths.
struct DepthRelation {
  /// As of a Finding: `scale` or `decoding`.
  std::string kind, text;
  RecordedDepth recorded;
  /// What is recorded, of what the map holds: itself, its inverse or its logarithm.
  DepthTerm stored = DepthTerm::depth;
  /// Constants that were estimated.
  int parameters = 0;
  /// What is stored is another quantity or in another unit: nothing that is a little off.
  bool is_gross = false;
  /// Pixels where it holds to 10⁻⁴ of the depth, or to the step of codes.
  std::uint64_t pixels = 0;
};

/// Those that hold at four fifths of the pixels where both show a surface, the simplest first;
/// their constants are estimated, and taken for round numbers where they are as good.
std::vector<DepthRelation> depth_relations(const Truth& truth, const OtherMap& other);

/// The map with the depths that its values mean.
OtherMap read_by(const DepthRelation& relation, const OtherMap& other);

}  // namespace fathom::attribution
