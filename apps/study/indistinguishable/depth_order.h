#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "fathom/depth_format/pipeline_model.h"

/// The experiment behind the study `indistinguishable`: depths that lie in order on a line of sight
/// go through a pipeline; neighbours come out in order, equal or swapped.
namespace fathom::studies {

/// A camera: where the eye is, the direction in which it looks, and the view row that these make.
struct View {
  std::array<double, 3> eye, direction;
  ViewRow row;
};
View view_from(const std::array<double, 3>& eye, const std::array<double, 3>& towards);
/// The view that studies take unless they take others: turned, and moved by 375 times near, so that
/// it is the same experiment at every scale; for near 0.1 the eye is at (10, 20, 30).
View default_view(double near);
/// A view drawn at random: any direction, the eye up to 100 times near from the origin on each
/// axis.
View random_view(std::uint64_t seed, double near);

/// The vertex at a depth along the view's axis, its coordinates rounded to binary32 as in a vertex
/// buffer. Its exact depth is that of the rounded vertex.
Vertex vertex_at(const View& view, double depth);

/// Which steps round, by the name under which a study shows them.
struct Sources {
  const char* name;
  PipelineRounding rounding;
  /// Samples on surfaces that reach from half to twice their depth, instead of on vertices.
  bool interpolates = false;
};
const std::vector<Sources>& all_sources();

/// The window depths of the samples, in their order.
std::vector<Ratio> window_depths(const PipelineModel& model, const View& view,
                                 const Sources& sources, const std::vector<double>& depths);

struct OrderCount {
  std::size_t pairs = 0, equal = 0, swapped = 0;
};
/// Neighbours of the list that are equal, or not in the order that the mapping gives them; after
/// storage, or of the window depths themselves where there is none.
OrderCount count_order(const PipelineModel& model, std::optional<Storage> storage,
                       const std::vector<Ratio>& window_depths);

/// The same for the exact depths of the vertices: the control.
OrderCount count_vertex_order(const View& view, const std::vector<double>& depths);

}  // namespace fathom::studies
