#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "fathom/depth_format/depth_format.h"
#include "fathom/depth_format/pipeline_model.h"

/// The experiment behind the study `indistinguishable`. Depths that lie in order on a line of sight
/// go through a pipeline, and neighbours are in order, equal or swapped afterwards.
namespace fathom::studies {

/// A camera: its eye, its direction, and the view row computed from both.
struct View {
  std::array<double, 3> eye, direction;
  ViewRow row;
};
View view_from(const std::array<double, 3>& eye, const std::array<double, 3>& towards);
/// The default view of studies: turned, and moved by 375 times near, so that the experiment is the
/// same at every scale. For near 0.1 the eye is at (10, 20, 30).
View default_view(double near);
/// A view drawn at random: any direction, the eye up to 100 times near from the origin on each
/// axis.
View random_view(std::uint64_t seed, double near);

/// The vertex at a depth along the view's axis, its coordinates rounded to binary32 as in a vertex
/// buffer. Its exact depth is that of the rounded vertex.
Vertex vertex_at(const View& view, double depth);

/// The steps that round, with their name in studies.
struct Sources {
  const char* name;
  PipelineRounding rounding;
  /// Takes samples on surfaces that reach from half to twice their depth, instead of on vertices.
  bool interpolates = false;
};
const std::vector<Sources>& all_sources();

/// The window depths of the samples, in their order.
std::vector<Ratio> window_depths(const PipelineModel& model, const View& view,
                                 const Sources& sources, const std::vector<double>& depths);

struct OrderCount {
  std::size_t pairs = 0, equal = 0, swapped = 0;
};
/// Counts neighbours of the list that are equal, or not in the order of the mapping, after storage,
/// or as window depths without a storage.
OrderCount count_order(const PipelineModel& model, std::optional<Storage> storage,
                       const std::vector<Ratio>& window_depths);

/// The same for the exact depths of the vertices: the control.
OrderCount count_vertex_order(const View& view, const std::vector<double>& depths);

// Neighbours among many depths that are equal or swapped after a pipeline, for every way through
// it.

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
  std::optional<Storage> storage;  ///< nullopt: the window depths themselves
};
/// The order of the depths after this way.
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
