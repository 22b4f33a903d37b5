#include "apps/study/z_fighting/coplanar_pair.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "apps/study/sweeps.h"
#include "fathom/depth_format/resolution.h"

namespace fathom::studies {
namespace {

const Ratio& one() {
  static const Ratio value = Dyadic(1.0);
  return value;
}

/// One sample in each of `count` equal parts of the patch, at a place drawn at random. Evenly
/// spaced ones would fall on the same place of every bin where the distance between them is a whole
/// number of codes, and show the beat of the two instead of the share.
std::vector<Ratio> samples_of(int count) {
  std::mt19937_64 random(1);
  std::vector<Ratio> shares;
  for (int i = 0; i < count; ++i) {
    const double jitter = std::ldexp(static_cast<double>(random() >> 44), -20);
    shares.emplace_back(Dyadic(i + jitter), Dyadic(static_cast<double>(count)));
  }
  return shares;
}

/// 1/D affine between two depths.
Ratio between(const Ratio& a, const Ratio& b, const Ratio& t) {
  return quotient(a * b, b * (one() - t) + a * t);
}

/// Depth in the middle over depth here: scales a separation here to one in the middle.
double to_the_middle(const CoplanarPair& pair, const Ratio& depth) {
  return pair.distance / round_to_binary64(depth);
}

/// One surface as a pipeline gets it: vertices, window depths of samples between them.
struct Surface {
  Vertex a, b;
  Ratio depth_a, depth_b;
};

Surface surface_of(const PipelineModel& model, const View& view, const Ratio& from,
                   const Ratio& to) {
  const Vertex a = vertex_at(view, round_to_binary64(from));
  const Vertex b = vertex_at(view, round_to_binary64(to));
  return {a, b, exact_depth(model, a), exact_depth(model, b)};
}

}  // namespace

Ratio front_depth(const CoplanarPair& pair, const Ratio& t) {
  const Ratio d = Dyadic(pair.distance), half_tilt = Dyadic(pair.tilt / 2);
  // 1 + τ/2 − t·τ
  return quotient(d, one() + half_tilt - t * Dyadic(pair.tilt));
}

Ratio back_depth(const CoplanarPair& pair, const Ratio& t) {
  return front_depth(pair, t) * (one() + Ratio(Dyadic(pair.separation), Dyadic(pair.distance)));
}

double fighting_share(const DepthFormat& format, const CoplanarPair& pair, int samples) {
  int fights = 0;
  for (const Ratio& t : samples_of(samples)) {
    const StoredDepth front = encode(format, clamp_to_range(format, front_depth(pair, t)));
    const StoredDepth back = encode(format, clamp_to_range(format, back_depth(pair, t)));
    if (!is_nearer(format, front, back)) ++fights;
  }
  return static_cast<double>(fights) / samples;
}

double fighting_share_in_pipeline(const PipelineModel& model, const View& view,
                                  const CoplanarPair& pair, int samples) {
  const Ratio start;
  const Ratio& end = one();
  const Surface front = surface_of(model, view, front_depth(pair, start), front_depth(pair, end));
  const Surface back = surface_of(model, view, back_depth(pair, start), back_depth(pair, end));
  const int sign = is_reversed(model.format.mapping) ? -1 : 1;
  int fights = 0;
  for (const Ratio& t : samples_of(samples)) {
    const bool front_is_nearer = compare(between(front.depth_a, front.depth_b, t),
                                         between(back.depth_a, back.depth_b, t)) < 0;
    const auto stored = [&](const Surface& surface) {
      return stored_number(model, interpolated_window_depth(model, surface.a, surface.b, t));
    };
    // The back surface is drawn first and stays unless the front one is strictly nearer.
    const bool front_wins = sign * compare(stored(front), stored(back)) < 0;
    if (front_wins != front_is_nearer) ++fights;
  }
  return static_cast<double>(fights) / samples;
}

double least_safe_separation(const DepthFormat& format, const CoplanarPair& pair, int samples) {
  double least = 0;
  for (const Ratio& t : samples_of(samples)) {
    const Ratio depth = clamp_to_range(format, front_depth(pair, t));
    const std::optional<double> behind = separation_behind(format, depth);
    if (!behind) return std::numeric_limits<double>::infinity();
    least = std::max(least, *behind * to_the_middle(pair, depth));
  }
  return least;
}

double predicted_safe_separation(const DepthFormat& format, const CoplanarPair& pair) {
  double greatest = 0;
  for (const double t : {0.0, 0.5, 1.0}) {
    const Ratio depth = clamp_to_range(format, front_depth(pair, Dyadic(t)));
    greatest = std::max(greatest, bin_width(format, depth) * to_the_middle(pair, depth));
  }
  return greatest;
}

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
