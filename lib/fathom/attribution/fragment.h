#pragma once

#include <cstdint>

#include "fathom/numeric/interval.h"

namespace fathom::attribution {

/// Whether a renderer of the model covers a sample with a triangle, whatever its roundings are.
enum class Coverage : std::uint8_t { must_not, may, must };

/// In Fragment::open_edges: the edges are not told one by one.
inline constexpr std::uint8_t joins_no_other = 0x80;

/// A triangle at a sample, as a renderer of the model may see it.
struct Fragment {
  std::uint32_t triangle = 0;
  Coverage coverage = Coverage::must_not;
  /// Edges whose side the model leaves open, bit k the edge opposite corner k, and whether the
  /// exact corners put the sample inside; edges are directed so that the inside is on their left.
  std::uint8_t open_edges = 0;
  bool turned = false;  ///< the corners run the other way round in the image
  bool inside = false;
  /// All values that may be stored for the triangle here. Window depths (raster), depths (ray),
  /// in either case so that the nearer is the less: reversed window depths are negated.
  Interval value;
  /// What is stored without any rounding.
  double exact = 0;
};

}  // namespace fathom::attribution
