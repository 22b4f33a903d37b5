#pragma once

#include <string>
#include <vector>

#include "fathom/attribution/faults/storage.h"
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

/// Which near and far are wrong, for a decoder that seems to have used `decoder` for the camera's
/// planes: "decoded with … if drawn with …, or drawn with … if decoded with …". A reading with
/// impossible planes is left out.
std::string text_of_decoder(const Camera& camera, const ClipPlanes& decoder);

/// The near and far with which a map may have been drawn if its window depths were decoded with
/// the camera's, most likely first: planes of few digits, then the fitted planes.
/// Method   1/stored is a linear function of 1/depth, whose constants give both planes.
std::vector<ClipPlanes> drawn_planes(const Truth& truth, const OtherMap& other);

/// A map whose window depths were decoded with the camera's planes, decoded with others.
OtherMap decoded_again(const OtherMap& other, const Camera& camera, const ClipPlanes& planes);

}  // namespace fathom::attribution
