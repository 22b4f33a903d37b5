#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "fathom/fast/bins/bins.h"
#include "fathom/fast/bins/tile_shape.h"
#include "fathom/fast/lenses/plane_places.h"
#include "fathom/fast/lenses/view_axes.h"
#include "fathom/geometry/frames.h"
#include "fathom/lens/preimages.h"
#include "fathom/numeric/certified_value.h"
#include "fathom/numeric/interval.h"

namespace fathom::fast {

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

/// The directions of the samples of a lens whose rays may go to all sides, or FOV: a table, a model
/// of division or with a root, a fisheye, a panorama.
class DirectionModel {
 public:
  DirectionModel(const lens::Preimages& the_preimages, const Projection& projection,
                 const TileGrid& grid);

  struct Sample {
    std::uint32_t column, row;
    ApproximateDirection direction;
  };
  /// The samples of a tile that have a ray.
  [[nodiscard]] std::vector<Sample> of_tile(std::uint32_t tile) const;
  /// From the exact direction: its greatest component is about 1. Nothing where the sample has no
  /// ray.
  [[nodiscard]] std::optional<ApproximateDirection> exactly_at(std::uint32_t column,
                                                               std::uint32_t row) const;
  /// Whether all directions lie in front of the camera.
  [[nodiscard]] bool looks_ahead() const { return is_plane(model_); }

 private:
  [[nodiscard]] std::optional<ApproximateDirection> in_table(std::uint32_t column,
                                                             std::uint32_t row) const;
  [[nodiscard]] std::optional<ApproximateDirection> divided(std::uint32_t column,
                                                            std::uint32_t row) const;
  /// Of the point at which the formula is used, before a stage, with a bound on the errors of its
  /// coordinates.
  [[nodiscard]] std::optional<ApproximateDirection> by_root(const std::array<double, 2>& point,
                                                            double error, std::uint32_t column,
                                                            std::uint32_t row) const;
  [[nodiscard]] std::optional<ApproximateDirection> in_field_of_view(std::uint32_t column,
                                                                     std::uint32_t row) const;
  [[nodiscard]] std::optional<ApproximateDirection> by_angle(std::uint32_t column,
                                                             std::uint32_t row) const;
  [[nodiscard]] std::optional<ApproximateDirection> turned(std::uint32_t column,
                                                           std::uint32_t row) const;
  /// The direction with these components if all of them are known; otherwise from the exact
  /// direction.
  [[nodiscard]] std::optional<ApproximateDirection> kept(
      const std::array<Certified<double>, 3>& bounded, std::uint32_t column,
      std::uint32_t row) const;
  /// The direction if it lies within max_radius; from the exact direction if its error leaves that
  /// open.
  [[nodiscard]] std::optional<ApproximateDirection> kept(const ApproximateDirection& direction,
                                                         std::uint32_t column,
                                                         std::uint32_t row) const;
  /// Of a fisheye, or of a lens with a stage before the root.
  [[nodiscard]] std::vector<Sample> tile_by_stage(std::uint32_t tile) const;
  template <class DirectionAt>
  [[nodiscard]] std::vector<Sample> collected(std::uint32_t tile, const DirectionAt& at) const;

  const lens::Preimages& preimages_;
  const TileGrid& grid_;
  const DirectionTable* table_;
  LensModel model_;
  /// Of a model of division: k of d = (x_d, y_d, 1 + k·r²).
  double k_;
  std::optional<lens::AnyRootFormula<Certified<double>>> roots_;
  /// Of FOV: ω, and tan(ω/2)/(ω/2).
  Certified<double> omega_{0, 0}, stretch_{1, 0};
  /// Of a model of division or with a root, or FOV: the map to (x_d, y_d).
  CertifiedPlane plane_;
  AngleLimit limit_;
  /// Of a lens with a stage: the points before it. Of a fisheye, |m| is the angle.
  std::optional<PlanePlaces> before_stage_;
};

/// The places of a tile in one view.
struct PlacesInView {
  double error = 0;
  PlaneBox box;
  std::uint32_t count = 0;
};

/// Finds the places of a tile: all in one view if they are not far from its middle, the camera's
/// first, or else each in the view along its greatest component. Those of FOV are all in the
/// camera's.
std::array<PlacesInView, all_views.size()> find_places(const DirectionModel& model,
                                                       const TileGrid& grid, std::uint32_t tile,
                                                       const FoundPlaces& places,
                                                       std::span<std::uint8_t> views);

}  // namespace fathom::fast
