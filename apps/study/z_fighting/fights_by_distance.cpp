#include "apps/study/z_fighting/fights_by_distance.h"

#include <tbb/parallel_for.h>

#include <cmath>

#include "apps/study/formats.h"
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

}  // namespace fathom::studies
