#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "fathom/fast/bins/bins.h"
#include "fathom/fast/bins/tile_shape.h"
#include "fathom/fast/lenses/certified_plane.h"
#include "fathom/fast/lenses/plane_box.h"
#include "fathom/lens/preimages.h"

namespace fathom::fast {

/// Where the places of a tile are written, by TileShape::index().
struct FoundPlaces {
  std::span<double> x, y;
};

/// Finds, for the samples of an image, the points m that the stage of a lens takes to them: in
/// binary64, each with a proved bound. Of a lens of the plane they are the places of the samples;
/// of a fisheye, |m| is the angle of a ray.
///
/// Threads  any number of threads may find tiles at once.
class PlanePlaces {
 public:
  /// Of a model that has a stage. `preimages` and `grid` must outlive it.
  PlanePlaces(const lens::Preimages& preimages, const Projection& projection, const TileGrid& grid);

  struct OfTile {
    /// |x − exact x| and |y − exact y| are at most that.
    double error;
    /// Around the samples that have a ray.
    PlaneBox box;
  };
  /// Writes the points of a tile; both coordinates are NaN where a sample has no ray.
  OfTile find(std::uint32_t tile, FoundPlaces places) const;

 private:
  const lens::Preimages& preimages_;
  const TileGrid& grid_;
  CertifiedPlane plane_;
  /// |y| of a sample that has a ray is at most that.
  double greatest_image_;
};

}  // namespace fathom::fast
