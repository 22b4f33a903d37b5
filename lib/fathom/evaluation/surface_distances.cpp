#include "fathom/evaluation/surface_distances.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "fathom/evaluation/nearest_surface.h"
#include "fathom/evaluation/point_sight.h"
#include "fathom/failures/errors.h"
#include "fathom/files/byte_order.h"
#include "fathom/files/file_bytes.h"
#include "fathom/image/error_metrics.h"
#include "fathom/memory/available_memory.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/scene/scene_fault.h"
#include "fathom/text/counted.h"
#include "fathom/threads/threads.h"

namespace fathom {
namespace {

using namespace evaluation;

/// A surface, and what is needed to measure to it and to see points of it.
struct Surface {
  Surface(const TriangleSource& the_source, long power)
      : source(the_source), triangles(source, power), tree(triangles) {}
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;

  const TriangleSource& source;
  PlacedTriangles triangles;
  TriangleTree tree;
};

/// What is known of a point that counts.
struct Distance {
  /// Where it is, if points are kept.
  MeasuredPoint point;
  /// How many of the thresholds, from the largest on, are greater.
  std::size_t thresholds = 0;
};

std::array<double, 3> rounded(const WorldPoint& p) {
  return {round_to_binary64(Ratio(p.x)), round_to_binary64(Ratio(p.y)),
          round_to_binary64(Ratio(p.z))};
}

/// Distances of one surface's points from another surface.
class Measurement {
 public:
  Measurement(const Surface& from, const Surface& to, const std::vector<Camera>& cameras,
              const SurfaceComparisonOptions& options)
      : from_(from), nearest_(to.source, to.triangles, to.tree), keep_points_(options.keep_points) {
    for (const Camera& camera : cameras)
      sights_.emplace_back(from.source, from.triangles, from.tree, camera, options.cull);
    for (const double within : options.within)
      squared_thresholds_.push_back(Dyadic(within) * Dyadic(within));
    std::sort(squared_thresholds_.begin(), squared_thresholds_.end());
  }

  [[nodiscard]] std::optional<Distance> of(const SurfacePoint& point,
                                           std::size_t& last_sight) const {
    const PlacedPoint p = placed(point, from_.source, from_.triangles);
    if (!is_seen(point.triangle, p, last_sight)) return std::nullopt;
    const Ratio squared = nearest_.squared_distance(p);
    Distance distance{{{}, round_sqrt_to_binary64(squared)}};
    if (keep_points_) distance.point.at = rounded(p.exact);
    for (const Dyadic& threshold : squared_thresholds_)
      distance.thresholds += squared < Ratio(threshold);
    return distance;
  }

 private:
  /// Neighbours are mostly seen by the same camera, so the one that saw the last point is asked
  /// first.
  [[nodiscard]] bool is_seen(std::uint32_t triangle, const PlacedPoint& p,
                             std::size_t& last_sight) const {
    if (sights_.empty()) return true;
    for (std::size_t i = 0; i < sights_.size(); ++i) {
      const std::size_t sight = (last_sight + i) % sights_.size();
      if (!sights_[sight].sees(triangle, p)) continue;
      last_sight = sight;
      return true;
    }
    return false;
  }

  const Surface& from_;
  NearestSurface nearest_;
  bool keep_points_;
  std::vector<PointSight> sights_;
  std::vector<Dyadic> squared_thresholds_;
};

constexpr std::size_t points_at_once = 256;

std::size_t parts_of(std::size_t points) {
  return (points + points_at_once - 1) / points_at_once;
}

std::vector<std::optional<Distance>> distances_of(const std::vector<SurfacePoint>& points,
                                                  const Measurement& measurement,
                                                  Progress& progress) {
  std::vector<std::optional<Distance>> distances(points.size());
  parallel_for(std::size_t{0}, parts_of(points.size()), [&](std::size_t part) {
    const std::size_t end = std::min(points.size(), (part + 1) * points_at_once);
    std::size_t last_sight = 0;
    for (std::size_t i = part * points_at_once; i < end; ++i)
      distances[i] = measurement.of(points[i], last_sight);
    progress.part_done();
  });
  return distances;
}

SurfaceDistances summary_of(const std::vector<std::optional<Distance>>& distances,
                            const SurfaceComparisonOptions& options) {
  const std::vector<double>& within = options.within;
  SurfaceDistances summary;
  summary.points = distances.size();
  std::vector<double> values;
  // How many points have exactly so many thresholds above them.
  std::vector<std::uint64_t> counts(within.size() + 1);
  double sum = 0, squares = 0;
  for (const auto& distance : distances) {
    if (!distance) continue;
    values.push_back(distance->point.distance);
    sum += distance->point.distance;
    squares += distance->point.distance * distance->point.distance;
    ++counts[distance->thresholds];
    if (options.keep_points) summary.measured.push_back(distance->point);
  }
  summary.seen = values.size();
  summary.shares.assign(within.size(), 0);
  if (values.empty()) return summary;
  const auto n = static_cast<double>(values.size());
  summary.mean = sum / n;
  summary.rms = std::sqrt(squares / n);
  std::sort(values.begin(), values.end());
  summary.median = image::nearest_rank(values, 500);
  summary.p90 = image::nearest_rank(values, 900);
  summary.p99 = image::nearest_rank(values, 990);
  summary.max = values.back();
  for (std::size_t i = 0; i < within.size(); ++i) {
    const auto greater = static_cast<std::size_t>(
        std::count_if(within.begin(), within.end(), [&](double w) { return w >= within[i]; }));
    std::uint64_t below = 0;
    for (std::size_t k = greater; k < counts.size(); ++k) below += counts[k];
    summary.shares[i] = static_cast<double>(below) / n;
  }
  return summary;
}

std::vector<SurfacePoint> points_on(const Surface& surface, const char* name, std::uint32_t count) {
  try {
    return surface_points(surface.triangles, count);
  } catch (const InputError& error) {
    throw InputError(std::string(name) + ": " + error.what());
  }
}

/// Of a triangle: its corners, its place in the tree's order, at most one node for each, its share
/// of the area.
constexpr double bytes_of_triangle = sizeof(PlacedTriangles::Corners) + sizeof(std::uint32_t) +
                                     sizeof(TriangleTree::Node) + sizeof(double);
/// Of a point: its place on each surface, its distance from one of them, and that once more to be
/// sorted.
constexpr double bytes_of_point =
    2 * sizeof(SurfacePoint) + sizeof(std::optional<Distance>) + sizeof(double);
/// Of a point that is kept, of each surface, while its list grows.
constexpr double bytes_of_kept_point = 2 * 2 * sizeof(MeasuredPoint);

void require_room(const TriangleSource& reconstruction, const TriangleSource& truth,
                  const SurfaceComparisonOptions& options) {
  const std::uint32_t points = options.points;
  const double bytes = bytes_of_point + (options.keep_points ? bytes_of_kept_point : 0);
  const auto triangles = static_cast<double>(reconstruction.count() + truth.count());
  require_memory("comparing " + text::counted(points, "point") + " of each surface",
                 triangles * bytes_of_triangle + points * bytes, available_memory());
}

SurfaceComparison compare_in_arena(const TriangleSource& reconstruction,
                                   const TriangleSource& truth, const std::vector<Camera>& cameras,
                                   const SurfaceComparisonOptions& options,
                                   const std::function<void(double)>& progress) {
  require_room(reconstruction, truth, options);
  const long power = std::max(power_of_unit(reconstruction), power_of_unit(truth));
  const Surface made(reconstruction, power), real(truth, power);
  const std::vector<SurfacePoint> on_made = points_on(made, "the reconstruction", options.points);
  const std::vector<SurfacePoint> on_real = points_on(real, "the truth", options.points);
  Progress done(progress, 2 * parts_of(options.points));
  const auto measure = [&](const Surface& from, const Surface& to,
                           const std::vector<SurfacePoint>& points) {
    return summary_of(distances_of(points, Measurement(from, to, cameras, options), done), options);
  };
  SurfaceComparison comparison{measure(made, real, on_made), measure(real, made, on_real), {}};
  for (std::size_t i = 0; i < options.within.size(); ++i) {
    const double precision = comparison.accuracy.shares[i];
    const double recall = comparison.completeness.shares[i];
    const double sum = precision + recall;
    comparison.f_scores.push_back(sum == 0 ? 0 : 2 * precision * recall / sum);
  }
  return comparison;
}

}  // namespace

void require_meaningful(const SurfaceComparisonOptions& options) {
  const StandardArithmetic standard;
  if (options.points == 0) throw UsageError(Setting{"points"}, "expected at least 1");
  for (const double within : options.within) {
    if (!(within > 0) || std::isinf(within))
      throw UsageError(Setting{"within"}, "expected a positive number");
  }
  require_thread_count(options.threads);
}

SurfaceComparison compare_surfaces(const Scene& reconstruction, const Scene& truth,
                                   const std::vector<Camera>& cameras,
                                   const SurfaceComparisonOptions& options,
                                   const std::function<void(double)>& progress) {
  const StandardArithmetic standard;
  require_meaningful(options);
  return with_threads(options.threads, [&] {
    require_valid(reconstruction);
    require_valid(truth);
    for (const Camera& camera : cameras) require_valid(camera);
    return compare_in_arena(reconstruction, truth, cameras, options, progress);
  });
}

using namespace files;

std::vector<std::byte> ply_of(const std::vector<MeasuredPoint>& points) {
  const StandardArithmetic standard;
  std::string header = "ply\nformat binary_little_endian 1.0\ncomment distances by Fathom\n";
  header += "element vertex " + std::to_string(points.size()) + "\n";
  for (const char* name : {"x", "y", "z", "quality"})
    header += std::string("property double ") + name + "\n";
  header += "end_header\n";
  Bytes file;
  append(file, header);
  std::size_t at = file.size();
  file.resize(at + points.size() * 4 * sizeof(double));
  for (const auto& [place, distance] : points) {
    for (const double number : {place[0], place[1], place[2], distance}) {
      store(&file[at], number, std::endian::little);
      at += sizeof(double);
    }
  }
  return file;
}

}  // namespace fathom
