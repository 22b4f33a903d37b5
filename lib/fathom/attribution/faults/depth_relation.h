#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fathom/attribution/attribution.h"
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
  /// No deviation of a camera makes such a map: it stores another quantity or another unit, not a
  /// slightly wrong depth, and few constants are estimated.
  bool excludes_camera = false;
  /// Pixels where it holds to 10⁻⁴ of the depth, or to the step of codes.
  std::uint64_t pixels = 0;
  /// As of a Finding.
  std::vector<Estimate> estimates = {};
};

/// Relations that hold at four fifths of the pixels where both maps show a surface, simplest first.
/// Their constants are estimated, and replaced by round numbers that fit equally well. Depths that
/// are right have no relation. A constant rests on at least 16 pixels, two constants on at least 8
/// different depths.
std::vector<DepthRelation> depth_relations(const Truth& truth, const OtherMap& other);

/// "the map stores a function of the depth, which rises with it, …", if the map's values follow the
/// order of the exact depths, or the opposite order, but are not near them. Search for formulas and
/// for faults of the camera before.
/// Method   of a sample of at most 2000 pixels, the longest subsequence that is in order has at
///          least 95 %. A camera's fault mixes neighbouring depths.
std::optional<std::string> text_of_curve(const Truth& truth, const OtherMap& other);

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
