#pragma once

#include <string>
#include <vector>

#include "fathom/attribution/model/window_depth.h"
#include "fathom/attribution/other_map.h"
#include "fathom/attribution/truth.h"

namespace fathom::attribution {

/// A formula that computes the values of another map from the exact depths.
struct DepthRelation {
  /// As of a Finding: `scale` or `decoding`.
  std::string kind, text;
  RecordedDepth recorded;
  /// The quantity that the map holds: the depth, its inverse or its logarithm.
  DepthTerm stored = DepthTerm::depth;
  /// Constants that were estimated.
  int parameters = 0;
  /// The map stores another quantity or another unit, not a slightly wrong depth.
  bool is_gross = false;
  /// Pixels where it holds to 10⁻⁴ of the depth, or to the step of codes.
  std::uint64_t pixels = 0;
};

/// Relations that hold at four fifths of the pixels where both maps show a surface, simplest first.
/// Their constants are estimated, and replaced by round numbers that fit equally well.
std::vector<DepthRelation> depth_relations(const Truth& truth, const OtherMap& other);

/// The map with the depths that its values mean.
OtherMap read_by(const DepthRelation& relation, const OtherMap& other);

}  // namespace fathom::attribution
