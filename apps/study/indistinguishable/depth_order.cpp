#include "apps/study/indistinguishable/depth_order.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <mutex>
#include <random>

#include "apps/study/sweeps.h"

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

namespace {

double percent(std::size_t part, std::size_t whole) {
  return 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

PipelineModel model_of(Mapping mapping, double near, double far, const View& view,
                       bool premultiplied, const PipelineRounding& rounding) {
  return {format_between(near, far, mapping, Storage::float32), view.row, premultiplied, rounding};
}

/// The ways without their storage: what is computed once and then stored in every storage.
std::vector<Way> ways_to_the_buffer() {
  std::vector<Way> ways;
  for (const Spacing spacing : {Spacing::linear, Spacing::logarithmic}) {
    for (const Mapping mapping : projections) {
      for (const bool premultiplied : {false, true}) {
        for (const Sources& sources : all_sources()) {
          ways.push_back({spacing, mapping, premultiplied, &sources, std::nullopt});
        }
      }
    }
  }
  return ways;
}

/// One way with every storage, and without.
std::vector<LostOrder> lose_order(Way way, double near, double far,
                                  const std::vector<double>& depths, const View& view) {
  const PipelineModel model =
      model_of(way.mapping, near, far, view, way.premultiplied, way.sources->rounding);
  const std::vector<Ratio> window = window_depths(model, view, *way.sources, depths);
  std::vector<LostOrder> rows{{way, count_order(model, std::nullopt, window)}};
  for (const Storage storage : all_storages) {
    way.storage = storage;
    rows.push_back({way, count_order(model, storage, window)});
  }
  return rows;
}

const Sources& vertices() {
  return all_sources()[5];
}

OrderSpread spread_of(Mapping mapping, bool premultiplied, double near, double far,
                      const std::vector<double>& depths) {
  OrderSpread spread{mapping, premultiplied};
  for (int seed = 1; seed <= random_views; ++seed) {
    const View view = random_view(static_cast<std::uint64_t>(seed), near);
    const PipelineModel model =
        model_of(mapping, near, far, view, premultiplied, vertices().rounding);
    const OrderCount counts =
        count_order(model, Storage::float32, window_depths(model, view, vertices(), depths));
    const double equal = percent_equal(counts), swapped = percent_swapped(counts);
    spread.least_equal = std::min(spread.least_equal, equal);
    spread.greatest_equal = std::max(spread.greatest_equal, equal);
    spread.least_swapped = std::min(spread.least_swapped, swapped);
    spread.greatest_swapped = std::max(spread.greatest_swapped, swapped);
  }
  return spread;
}

}  // namespace

double percent_equal(const OrderCount& counts) {
  return percent(counts.equal, counts.pairs);
}

double percent_swapped(const OrderCount& counts) {
  return percent(counts.swapped, counts.pairs);
}

std::vector<double> depths_of(Spacing spacing, double near, double far, std::uint32_t count) {
  return spacing == Spacing::linear ? linear_samples(near, far, count)
                                    : logarithmic_samples(near, far, count);
}

std::vector<LostOrder> lose_order(double near, double far, std::uint32_t samples, const View& view,
                                  const std::function<void(double)>& tick) {
  const std::vector<double> linear = depths_of(Spacing::linear, near, far, samples),
                            logarithmic = depths_of(Spacing::logarithmic, near, far, samples);
  const std::vector<Way> ways = ways_to_the_buffer();
  std::vector<std::vector<LostOrder>> parts(ways.size());
  std::mutex ticking;
  std::size_t finished = 0;
  tbb::parallel_for(std::size_t{0}, ways.size(), [&](std::size_t i) {
    parts[i] = lose_order(ways[i], near, far,
                          ways[i].spacing == Spacing::linear ? linear : logarithmic, view);
    const std::lock_guard<std::mutex> lock(ticking);
    tick(static_cast<double>(++finished) / static_cast<double>(ways.size()));
  });
  std::vector<LostOrder> rows;
  for (auto& part : parts) std::move(part.begin(), part.end(), std::back_inserter(rows));
  return rows;
}

std::vector<OrderSpread> spread_over_views(double near, double far,
                                           const std::vector<double>& depths) {
  std::vector<OrderSpread> spreads;
  for (const Mapping mapping : projections) {
    for (const bool premultiplied : {false, true}) {
      spreads.push_back(spread_of(mapping, premultiplied, near, far, depths));
    }
  }
  return spreads;
}

}  // namespace fathom::studies
