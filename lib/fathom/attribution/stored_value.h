#pragma once

#include "fathom/attribution/fragment.h"
#include "fathom/attribution/other_map.h"
#include "fathom/attribution/renderer_model.h"

namespace fathom::attribution {

/// What fragments and the other map are compared by: window depths where the other's are known (the
/// nearer the less), else depths.
class StoredValues {
 public:
  StoredValues(const Camera& camera, const OtherMap& other, const RendererModel& model);

  [[nodiscard]] Interval interval(const Fragment& f) const;
  [[nodiscard]] double exact(const Fragment& f) const;
  /// A bound on fragments' values as a bound on what is compared.
  [[nodiscard]] double limit(double value) const;
  [[nodiscard]] double other(std::size_t pixel) const;
  [[nodiscard]] Interval as_depths(const Fragment& f) const;
  /// What the buffer holds where nothing is drawn.
  [[nodiscard]] bool is_cleared(double window) const {
    return window == (window_.reversed() ? 0 : 1);
  }

  /// Whether the other's value is the exact depth's rounded once, or next to it.
  [[nodiscard]] bool is_nearest(std::size_t pixel, double depth) const;
  [[nodiscard]] bool is_neighbour(std::size_t pixel, double depth) const;
  /// Width of an interval in steps of the storage; the other's distance from what
  /// the model expects without any rounding of its own.
  [[nodiscard]] double steps(const Fragment& f, double depth) const;
  [[nodiscard]] double bias_steps(std::size_t pixel, const Fragment& f) const;

 private:
  [[nodiscard]] bool has_windows() const { return !other_.windows.empty(); }
  [[nodiscard]] bool is_raster() const { return model_.kind == RendererModel::Kind::raster; }
  [[nodiscard]] double depth_of(double value) const;
  [[nodiscard]] double window_of(std::size_t pixel) const;

  const OtherMap& other_;
  RendererModel model_;
  WindowDepth window_;
  double sign_ = 1;
};

}  // namespace fathom::attribution
