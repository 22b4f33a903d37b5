#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "apps/study/indistinguishable/depth_order.h"
#include "fathom/depth_format/depth_format.h"

/// Which neighbours of many depths come out of a pipeline as equal or swapped: every way through
/// it.
namespace fathom::studies {

inline constexpr Mapping projections[] = {Mapping::standard, Mapping::infinite, Mapping::reversed,
                                          Mapping::reversed_infinite, Mapping::opengl};

enum class Spacing { linear, logarithmic };

/// `count` depths from near to far.
std::vector<double> depths_of(Spacing spacing, double near, double far, std::uint32_t count);

/// A way through a pipeline.
struct Way {
  Spacing spacing;
  Mapping mapping;
  bool premultiplied;
  const Sources* sources;          ///< of rounding
  std::optional<Storage> storage;  ///< none: the window depths themselves
};
/// What becomes of the depths on it.
struct LostOrder {
  Way way;
  OrderCount counts;
};

/// Every way, seen from `view`.
std::vector<LostOrder> lose_order(double near, double far, std::uint32_t samples, const View& view,
                                  const std::function<void(double)>& tick);

/// In percent of the neighbours, the least and the greatest over random views.
struct OrderSpread {
  Mapping mapping;
  bool premultiplied;
  double least_equal = 100, greatest_equal = 0, least_swapped = 100, greatest_swapped = 0;
};
inline constexpr int random_views = 20;
/// Of vertices in float32, for each projection and way to apply the matrices.
std::vector<OrderSpread> spread_over_views(double near, double far,
                                           const std::vector<double>& depths);

double percent_equal(const OrderCount& counts);
double percent_swapped(const OrderCount& counts);

}  // namespace fathom::studies
