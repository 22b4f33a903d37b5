#include "apps/study/indistinguishable/lost_order.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <iterator>
#include <mutex>

#include "apps/study/sweeps.h"

namespace fathom::studies {
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
