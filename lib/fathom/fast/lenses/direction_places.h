#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "fathom/fast/bins/bins.h"
#include "fathom/fast/bins/tile_shape.h"
#include "fathom/fast/lenses/certified_plane.h"
#include "fathom/fast/lenses/plane_box.h"
#include "fathom/fast/lenses/view_axes.h"
#include "fathom/geometry/pixel_box.h"
#include "fathom/lens/preimages.h"
#include "fathom/numeric/interval.h"

namespace fathom::fast {

/// Where the places of a tile are written, by TileShape::index().
struct FoundPlaces {
  std::span<double> x, y;
};

/// The direction of a sample, times a positive number: each component errs by at most `error`.
struct ApproximateDirection {
  std::array<double, 3> d;
  double error;
};

/// Which directions a lens keeps whose max_radius is an angle to the z axis.
class AngleLimit {
 public:
  /// An interval that contains cos(max_radius); without it, all are kept.
  explicit AngleLimit(std::optional<Interval> cosine) : cosine_(cosine) {}

  /// Whether it keeps a direction; nullopt if the error of the direction leaves that open.
  [[nodiscard]] std::optional<bool> keeps(const ApproximateDirection& direction) const;

 private:
  std::optional<Interval> cosine_;
};

/// What the directions of a lens with rational rays depend on: a table, or a model of division.
class DirectionModel {
 public:
  DirectionModel(const lens::Preimages& the_preimages, const Projection& projection,
                 const TileGrid& grid);

  /// Nothing where the sample has no ray.
  [[nodiscard]] std::optional<ApproximateDirection> at(std::uint32_t column,
                                                       std::uint32_t row) const;
  /// From the exact direction: its greatest component is between ½ and 1.
  [[nodiscard]] std::optional<ApproximateDirection> exactly_at(std::uint32_t column,
                                                               std::uint32_t row) const;

 private:
  [[nodiscard]] std::optional<ApproximateDirection> in_table(std::uint32_t column,
                                                             std::uint32_t row) const;
  [[nodiscard]] std::optional<ApproximateDirection> divided(std::uint32_t column,
                                                            std::uint32_t row) const;

  const lens::Preimages& preimages_;
  const DirectionTable* table_;
  /// k of d = (x_d, y_d, 1 + k·r²).
  double k_;
  CertifiedPlane plane_;
  AngleLimit limit_;
};

/// The places of a tile in one view.
struct PlacesInView {
  double error = 0;
  PlaneBox box;
  std::uint32_t count = 0;
};

/// Finds the places of a tile: all in one view if they are not far from its middle, the camera's
/// first, or else each in the view along its greatest component.
std::array<PlacesInView, all_views.size()> find_places(const DirectionModel& model,
                                                       const TileGrid& grid, std::uint32_t tile,
                                                       const FoundPlaces& places,
                                                       std::span<std::uint8_t> views);

}  // namespace fathom::fast
