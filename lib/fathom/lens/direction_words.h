#pragma once

#include <array>
#include <optional>

#include "fathom/lens/polynomial_stage.h"
#include "fathom/lens/sample_plane.h"
#include "fathom/numeric/certified.h"
#include "fathom/numeric/certified_value.h"
#include "fathom/numeric/dyadic.h"
#include "fathom/numeric/interval.h"

/// Directions in double-words with proved bounds: about 80 bits, at a hundredth of the time that
/// intervals of so many bits take.
namespace fathom::lens {

/// A positive multiple of a direction.
using DirectionWords = std::array<Certified<WordPair>, 3>;

/// Of an exact direction.
DirectionWords words_of(const ExactVector3& direction);

/// Of a direction that an enclosure contains.
DirectionWords words_within(const std::array<DyadicInterval, 3>& direction);

/// Of the preimage (m, 1) of y ≠ 0 under a stage. `q` is an interval in the disc that contains |m|²
/// between its ends. nullopt if the bounds are too wide, as next to the edge of the disc.
std::optional<DirectionWords> words_of_preimage(const PolynomialStage& stage,
                                                const DistortedPoint& y, const Interval& q);

}  // namespace fathom::lens
