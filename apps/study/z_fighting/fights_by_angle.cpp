#include "apps/study/z_fighting/fights_by_angle.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <numbers>

#include "apps/study/formats.h"
#include "apps/study/z_fighting/coplanar_pair.h"

namespace fathom::studies {
namespace {

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
