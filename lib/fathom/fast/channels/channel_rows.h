#pragma once

#include <array>
#include <cstdint>

#include "fathom/fast/channels/map_rows.h"
#include "fathom/triangle/double_word_surface.h"
#include "fathom/triangle/stored_quantity.h"

namespace fathom::fast {

/// The visible surfaces of a row: for each sample q and its tag, whose bits as a binary64 number
/// are a bound on the error of q and whose lower half is the triangle's number (see surface_tag()).
/// Samples without a surface may have anything.
struct SurfaceRow {
  const double* q = nullptr;
  const std::uint64_t* tags = nullptr;
  /// Places of the surfaces in the tile.
  const std::uint32_t* places = nullptr;
  /// u of the first sample, v of all.
  double first_u = 0, v = 0;
};

/// Rounded values, and a bit for each sample whose value is settled, that is, the exact one rounded
/// once. The others, and samples without a surface, may have anything.
template <class T>
struct RoundedValues {
  MapRow<T> values;
  std::uint64_t settled = 0;
};

// The binary64 tier of the channels that follow from q alone, for several samples at once, by the
// instructions of the processor. triangle/certified_surface.h and numeric/certified_rounding.h do
// the same for one sample and give the proofs.

/// World x, y, z of the visible points, in scene units.
/// Needs    usable rays of the world.
void round_positions(const SurfaceRow& row, const triangle::Rays& world,
                     const triangle::RaySizes& sizes, bool perspective,
                     std::array<RoundedValues<float>, 3>& rounded);
/// Depth, or ray distance where `distance`; as binary32, or times the factor as codes.
void round_depths(const SurfaceRow& row, const triangle::SceneRays& rays, bool distance,
                  RoundedValues<float>& rounded);
void round_to_codes(const SurfaceRow& row, const triangle::SceneRays& rays, bool distance,
                    const triangle::CodeFactor& factor, RoundedValues<std::uint16_t>& rounded);

}  // namespace fathom::fast
