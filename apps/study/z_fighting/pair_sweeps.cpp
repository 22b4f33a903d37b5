#include "apps/study/z_fighting/pair_sweeps.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <numbers>

#include "apps/study/sweeps.h"
#include "apps/study/z_fighting/coplanar_pair.h"

namespace fathom::studies {
namespace {

constexpr double tilt = 0.57735026918962573;  // tan 30°

FightByDistance measure(const DepthFormat& format, const SurfacePair& surfaces, double distance) {
  const CoplanarPair pair{distance, surfaces.separation, tilt};
  const View view = default_view(surfaces.near);
  const auto in_pipeline = [&](bool premultiplied) -> std::optional<double> {
    if (!is_projection(format.mapping)) return std::nullopt;
    const PipelineModel model{format, view.row, premultiplied, {}};
    return fighting_share_in_pipeline(model, view, pair, surfaces.samples);
  };
  return {format,
          distance,
          fighting_share(format, pair, surfaces.samples),
          in_pipeline(false),
          in_pipeline(true),
          least_safe_separation(format, pair, surfaces.samples),
          predicted_safe_separation(format, pair)};
}

constexpr double degrees[] = {0, 5, 10, 15, 20, 25, 30, 35, 40, 45, 50, 55};
constexpr std::pair<Mapping, Storage> swept[] = {{Mapping::standard, Storage::unorm16},
                                                 {Mapping::standard, Storage::unorm24},
                                                 {Mapping::log, Storage::unorm24},
                                                 {Mapping::reversed, Storage::float32}};

FightByAngle measure(const AngleSweep& sweep, const DepthFormat& format, double angle,
                     double distance) {
  const CoplanarPair pair{distance, sweep.separation, std::tan(angle * std::numbers::pi / 180)};
  std::optional<double> premultiplied;
  if (is_projection(format.mapping)) {
    const View view = default_view(sweep.near);
    premultiplied =
        fighting_share_in_pipeline({format, view.row, true, {}}, view, pair, sweep.samples);
  }
  return {format,
          angle,
          distance,
          fighting_share(format, pair, sweep.samples),
          premultiplied,
          least_safe_separation(format, pair, sweep.samples),
          predicted_safe_separation(format, pair)};
}

}  // namespace

std::vector<FightByDistance> fights_by_distance(const SurfacePair& surfaces,
                                                const std::vector<double>& distances,
                                                const std::function<void(double)>& tick) {
  constexpr std::size_t formats = std::size(all_mappings) * std::size(all_storages);
  std::vector<FightByDistance> fights;
  for (const Mapping mapping : all_mappings) {
    for (const Storage storage : all_storages) {
      const DepthFormat format = format_between(surfaces.near, surfaces.far, mapping, storage);
      const std::size_t first = fights.size();
      fights.resize(first + distances.size());
      tbb::parallel_for(std::size_t{0}, distances.size(), [&](std::size_t i) {
        fights[first + i] = measure(format, surfaces, distances[i]);
      });
      tick(static_cast<double>(fights.size()) / static_cast<double>(formats * distances.size()));
    }
  }
  return fights;
}

FightsByDistanceAndSeparation fights_by_distance_and_separation(const DepthFormat& format,
                                                                const SurfacePair& surfaces) {
  constexpr int cells = 36;
  FightsByDistanceAndSeparation fights{{}, {}, std::vector<double>(cells * cells)};
  const double from = std::log10(2 * surfaces.near), to = std::log10(surfaces.far / 2);
  for (int i = 0; i < cells; ++i) {
    fights.log_distances.push_back(from + (to - from) * i / (cells - 1));
    fights.log_separations.push_back(-8 + 8.0 * i / (cells - 1));
  }
  tbb::parallel_for(std::size_t{0}, fights.shares.size(), [&](std::size_t cell) {
    const double distance = std::pow(10, fights.log_distances[cell % cells]);
    const double separation = std::pow(10, fights.log_separations[cell / cells]);
    fights.shares[cell] = fighting_share(format, {distance, separation, tilt}, 32);
  });
  return fights;
}

std::vector<FightByAngle> fights_by_angle(const AngleSweep& sweep) {
  const std::size_t angles = std::size(degrees), distances = sweep.distances.size();
  std::vector<FightByAngle> fights(std::size(swept) * distances * angles);
  tbb::parallel_for(std::size_t{0}, fights.size(), [&](std::size_t i) {
    const auto& [mapping, storage] = swept[i / (angles * distances)];
    fights[i] = measure(sweep, {mapping, storage, sweep.near, sweep.far}, degrees[i % angles],
                        sweep.distances[i / angles % distances]);
  });
  return fights;
}

}  // namespace fathom::studies
