#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "fathom/lens/direction_words.h"
#include "fathom/lens/preimages.h"

namespace fathom::lens {

/// An approximate preimage m under a stage S, and what is known of S around it.
struct StageStart {
  double x = 0, y = 0;
  /// (S(a) − S(b))·(a − b) ≥ growth·|a − b|² for all a and b in a convex part of the disc that
  /// contains every point whose coordinates differ from x and y by at most 2·radius each. 0:
  /// nothing is known.
  double growth = 0, radius = 0;
};

/// The directions of a lens in double-words: the formula of each model, evaluated in arithmetic
/// whose operations bound their errors. A model with a stage starts from an approximate preimage.
///
/// Exact    the direction differs from the exact one by at most the bounds; about 95 bits are
///          known of most directions.
/// Cost     0.2 to 2 µs
/// Threads  any number of threads may ask at once.
class WordFormulas {
 public:
  /// `preimages` may go away; a table of directions stays.
  explicit WordFormulas(const Preimages& preimages);

  /// A positive multiple of the direction that a pixel's sample sees; nullopt if its bounds are too
  /// wide, and of lenses without a formula: two stages, a stage before a root, FTHETA.
  /// Needs    a sample that has a ray.
  [[nodiscard]] std::optional<DirectionWords> of_pixel(std::uint32_t column, std::uint32_t row,
                                                       const StageStart& start) const {
    return find_(column, row, start);
  }

 private:
  using Find = std::function<std::optional<DirectionWords>(std::uint32_t column, std::uint32_t row,
                                                           const StageStart& start)>;
  Find find_;
};

}  // namespace fathom::lens
