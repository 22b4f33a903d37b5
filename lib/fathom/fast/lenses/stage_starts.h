#pragma once

#include <array>
#include <optional>

#include "fathom/fast/bins/tile_shape.h"
#include "fathom/fast/lenses/places.h"
#include "fathom/fast/lenses/view_axes.h"
#include "fathom/lens/preimages.h"
#include "fathom/lens/word_formulas.h"

namespace fathom::fast {

/// Where the search for the preimages of a tile's samples starts: at their places, or for a fisheye
/// at the angles of their directions, with the growth of the stage on each block of samples.
class StageStarts {
 public:
  /// Of any model; without a stage nothing is known, and nothing is needed. `preimages` must
  /// outlive it.
  explicit StageStarts(const lens::Preimages& preimages);

  /// The samples of a tile that a view holds, from now on.
  void start(const Places::OfTile& places, const ViewAxes& axes);
  /// Of a sample that has a ray in the view, by TileShape::index().
  [[nodiscard]] lens::StageStart at(std::size_t i);

 private:
  struct Growth {
    double growth = 0, radius = 0;
  };
  [[nodiscard]] std::array<double, 2> start_of(std::size_t i) const;
  [[nodiscard]] Growth growth_of(std::uint32_t first_column, std::uint32_t first_row) const;

  const lens::PolynomialStage* stage_;
  bool is_plane_;
  /// |m|² in the disc, with room for the circles around places.
  double limit_;
  Places::OfTile places_{};
  ViewAxes axes_ = all_views.front();
  /// By the numbers of blocks; made on first use.
  std::array<std::optional<Growth>, TileShape::blocks> growths_;
};

}  // namespace fathom::fast
