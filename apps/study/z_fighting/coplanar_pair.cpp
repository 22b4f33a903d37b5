#include "apps/study/z_fighting/coplanar_pair.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

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

}  // namespace fathom::studies
