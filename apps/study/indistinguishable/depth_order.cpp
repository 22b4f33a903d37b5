#include "apps/study/indistinguishable/depth_order.h"

#include <cmath>
#include <random>

namespace fathom::studies {

View view_from(const std::array<double, 3>& eye, const std::array<double, 3>& towards) {
  const auto [x, y, z] = towards;
  const double length = std::sqrt(x * x + y * y + z * z);
  const std::array<double, 3> d{x / length, y / length, z / length};
  return {eye, d, {d[0], d[1], d[2], -(d[0] * eye[0] + d[1] * eye[1] + d[2] * eye[2])}};
}

View default_view(double near) {
  const double scale = near / 0.1;
  return view_from({10 * scale, 20 * scale, 30 * scale}, {1, 2, 3});
}

View random_view(std::uint64_t seed, double near) {
  std::mt19937_64 random(seed);
  // The engine's output is the same everywhere; that of the library's distributions is not.
  const auto between_minus_and_one = [&] {
    return std::ldexp(static_cast<double>(random() >> 11), -52) - 1;
  };
  const auto point = [&](double scale) {
    std::array<double, 3> p{};
    for (double& x : p) x = scale * between_minus_and_one();
    return p;
  };
  for (;;) {
    const std::array<double, 3> d = point(1);
    const double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    if (square > 0.01 && square <= 1) return view_from(point(10 * (near / 0.1)), d);
  }
}

Vertex vertex_at(const View& view, double depth) {
  Vertex vertex{};
  for (int i = 0; i < 3; ++i) {
    vertex[i] = static_cast<float>(view.eye[i] + depth * view.direction[i]);
  }
  return vertex;
}

const std::vector<Sources>& all_sources() {
  constexpr bool on = true, off = false;
  static const std::vector<Sources> sources{{"storage", {off, off, off, off, on}},
                                            {"matrix", {on, off, off, off, on}},
                                            {"transform", {off, on, off, off, on}},
                                            {"division", {off, off, on, off, on}},
                                            {"interpolation", {off, off, off, on, on}, true},
                                            {"vertices", {on, on, on, off, on}},
                                            {"all", {on, on, on, on, on}, true}};
  return sources;
}

std::vector<Ratio> window_depths(const PipelineModel& model, const View& view,
                                 const Sources& sources, const std::vector<double>& depths) {
  // 1/D is affine in the window: 1/D = (1 − t)·2/D + t·1/(2·D) for t = 2/3.
  const Ratio t(Dyadic(2.0), Dyadic(3.0));
  std::vector<Ratio> result;
  result.reserve(depths.size());
  for (const double depth : depths) {
    result.push_back(sources.interpolates
                         ? interpolated_window_depth(model, vertex_at(view, depth / 2),
                                                     vertex_at(view, depth * 2), t)
                         : window_depth(model, vertex_at(view, depth)));
  }
  return result;
}

namespace {

void count(OrderCount& counts, int order) {
  ++counts.pairs;
  if (order == 0) ++counts.equal;
  if (order < 0) ++counts.swapped;
}

}  // namespace

OrderCount count_order(const PipelineModel& model, std::optional<Storage> storage,
                       const std::vector<Ratio>& window_depths) {
  PipelineModel stored = model;
  stored.rounding.storage = storage.has_value();
  stored.format.storage = storage.value_or(Storage::float64);
  const int sign = is_reversed(model.format.mapping) ? -1 : 1;
  OrderCount counts;
  Ratio previous;
  for (std::size_t i = 0; i < window_depths.size(); ++i) {
    Ratio current = storage ? stored_number(stored, window_depths[i]) : window_depths[i];
    if (i > 0) count(counts, sign * compare(current, previous));
    previous = std::move(current);
  }
  return counts;
}

OrderCount count_vertex_order(const View& view, const std::vector<double>& depths) {
  PipelineModel model;
  model.view = view.row;
  OrderCount counts;
  for (std::size_t i = 1; i < depths.size(); ++i) {
    count(counts, compare(exact_depth(model, vertex_at(view, depths[i])),
                          exact_depth(model, vertex_at(view, depths[i - 1]))));
  }
  return counts;
}

}  // namespace fathom::studies
