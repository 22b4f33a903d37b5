#include "fathom/evaluation/surface_distances.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "fathom/evaluation/box_tree.h"
#include "fathom/evaluation/placed_points.h"
#include "fathom/evaluation/shape.h"
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
using namespace evaluation;
using namespace files;

namespace {

/// A measured point: its distance from the other shape.
struct Distance {
  /// Rounded; negative where no camera sees the point.
  double length = -1;
  /// How many of the thresholds, from the largest on, are greater.
  std::uint32_t thresholds = 0;
  bool is_outlier = false;

  [[nodiscard]] bool is_seen() const { return length >= 0; }
};

/// The distances of a shape's points, and where they are, if points are kept.
struct Distances {
  std::vector<Distance> list;
  std::vector<std::array<double, 3>> places;
};

std::array<double, 3> rounded(const WorldPoint& p) {
  return {round_to_binary64(Ratio(p.x)), round_to_binary64(Ratio(p.y)),
          round_to_binary64(Ratio(p.z))};
}

/// Compares a distance exactly.
class Limits {
 public:
  explicit Limits(const SurfaceComparisonOptions& options) {
    for (const double within : options.within) squared_.emplace_back(square(within));
    std::sort(squared_.begin(), squared_.end());
    if (options.max_distance) squared_greatest_ = Ratio(square(*options.max_distance));
  }

  [[nodiscard]] Distance of(const Ratio& squared) const {
    Distance distance;
    distance.length = round_sqrt_to_binary64(squared);
    for (const Ratio& limit : squared_) distance.thresholds += squared < limit;
    distance.is_outlier = squared_greatest_ && !(squared < *squared_greatest_);
    return distance;
  }

 private:
  static Dyadic square(double x) { return Dyadic(x) * Dyadic(x); }

  std::vector<Ratio> squared_;
  std::optional<Ratio> squared_greatest_;
};

constexpr std::uint32_t points_at_once = 256;

std::uint32_t parts_of(const Shape& shape) {
  return shape.points() / points_at_once + (shape.points() % points_at_once != 0);
}

Distances distances_of(const Shape& from, const Shape& to, const SurfaceComparisonOptions& options,
                       Progress& progress) {
  const Limits limits(options);
  Distances distances;
  distances.list.resize(from.points());
  if (options.keep_points) distances.places.resize(from.points());
  parallel_for(std::uint32_t{0}, parts_of(from), [&](std::uint32_t part) {
    const std::uint32_t first = part * points_at_once;
    const std::uint32_t end = first + std::min(from.points() - first, points_at_once);
    std::size_t last_camera = 0;
    for (std::uint32_t place = first; place < end; ++place) {
      const std::uint32_t i = from.number_at(place);
      if (!from.is_seen(i, last_camera)) continue;
      const PlacedPoint p = from.point(i);
      distances.list[i] = limits.of(to.squared_distance(p));
      if (options.keep_points) distances.places[i] = rounded(p.exact);
    }
    progress.part_done();
  });
  return distances;
}

std::vector<MeasuredPoint> measured(const Distances& distances) {
  std::vector<MeasuredPoint> points;
  for (std::size_t i = 0; i < distances.places.size(); ++i) {
    if (distances.list[i].is_seen())
      points.push_back({distances.places[i], distances.list[i].length});
  }
  return points;
}

/// The shares of distances below thresholds. `counts`: how many of all have exactly so many
/// thresholds above them.
std::vector<double> shares_of(const std::vector<std::uint64_t>& counts,
                              const std::vector<double>& within, std::uint64_t all) {
  std::vector<double> shares;
  for (const double threshold : within) {
    const auto greater = static_cast<std::size_t>(
        std::ranges::count_if(within, [&](double other) { return other >= threshold; }));
    std::uint64_t below = 0;
    for (std::size_t k = greater; k < counts.size(); ++k) below += counts[k];
    shares.push_back(all == 0 ? 0 : static_cast<double>(below) / static_cast<double>(all));
  }
  return shares;
}

/// The figures of the lengths, in the order of the points.
void summarize(std::vector<double> lengths, SurfaceDistances& summary) {
  if (lengths.empty()) return;
  double sum = 0, squares = 0;
  for (const double length : lengths) {
    sum += length;
    squares += length * length;
  }
  const auto n = static_cast<double>(lengths.size());
  summary.mean = sum / n;
  summary.rms = std::sqrt(squares / n);
  std::sort(lengths.begin(), lengths.end());
  summary.median = image::nearest_rank(lengths, 500);
  summary.p90 = image::nearest_rank(lengths, 900);
  summary.p99 = image::nearest_rank(lengths, 990);
  summary.max = lengths.back();
}

SurfaceDistances summary_of(const Distances& distances, const SurfaceComparisonOptions& options) {
  SurfaceDistances summary;
  summary.points = distances.list.size();
  std::vector<double> lengths;
  lengths.reserve(distances.list.size());
  std::vector<std::uint64_t> counts(options.within.size() + 1);
  for (const Distance& distance : distances.list) {
    if (!distance.is_seen()) continue;
    ++summary.seen;
    ++counts[distance.thresholds];
    if (distance.is_outlier) {
      ++summary.outliers;
    } else {
      lengths.push_back(distance.length);
    }
  }
  summary.shares = shares_of(counts, options.within, summary.seen);
  summarize(std::move(lengths), summary);
  summary.measured = measured(distances);
  return summary;
}

/// Memory of a point: its distance, and a copy for sorting.
constexpr double bytes_of_point = sizeof(Distance) + sizeof(double);
/// Memory of a kept point, for both shapes, while its list grows.
constexpr double bytes_of_kept_point =
    sizeof(std::array<double, 3>) + 2 * 2 * sizeof(MeasuredPoint);

/// The points that are measured on a shape, at most.
double points_of(const Scene& scene, const SurfaceComparisonOptions& options) {
  return is_cloud(scene) ? static_cast<double>(point_count(scene)) : options.points;
}

void require_room(const Scene& reconstruction, const Scene& truth, bool with_sight,
                  const SurfaceComparisonOptions& options) {
  const double of_made = points_of(reconstruction, options), of_real = points_of(truth, options);
  const double points = std::max(of_made, of_real);
  const double kept = options.keep_points ? (of_made + of_real) * bytes_of_kept_point : 0;
  require_memory("comparing " + text::counted(static_cast<std::uint64_t>(points), "point") +
                     " of each surface",
                 bytes_of_shape(reconstruction, options.density, with_sight, options) +
                     bytes_of_shape(truth, options.truth_density, with_sight, options) +
                     points * bytes_of_point + kept,
                 available_memory());
}

/// Refuses a scene that is neither a surface nor a cloud.
void require_shape(const Scene& scene, const char* name) {
  const bool has_faces = triangle_count(scene) != 0;
  if (!has_faces && point_count(scene) == 0)
    throw InputError(std::string(name) + ": has neither faces nor points");
  const auto is_of_points = [&](const Object& object) {
    const Mesh& mesh = scene.meshes[object.mesh];
    return mesh.triangles.empty() && !mesh.vertices.empty();
  };
  if (has_faces && std::ranges::any_of(scene.objects, is_of_points))
    throw InputError(std::string(name) +
                     ": has meshes and point clouds, expected one or the other");
}

/// Refuses options that are about a shape that is not there.
void require_applicable(const Scene& reconstruction, const Scene& truth,
                        const std::vector<Camera>& cameras,
                        const SurfaceComparisonOptions& options) {
  const bool made = is_cloud(reconstruction), real = is_cloud(truth);
  if (options.density && !made)
    throw UsageError(Setting{"density"}, "thins a point cloud; the reconstruction has faces");
  if (options.truth_density && !real)
    throw UsageError(Setting{"truth_density"}, "thins a point cloud; the truth has faces");
  if (!cameras.empty() && made && real)
    throw UsageError(Setting{"camera"}, "sees surfaces; both sides are point clouds");
}

SurfaceComparison compare_in_arena(const Scene& reconstruction, const Scene& truth,
                                   const std::vector<Camera>& cameras,
                                   const SurfaceComparisonOptions& options,
                                   const std::function<void(double)>& progress) {
  require_room(reconstruction, truth, !cameras.empty(), options);
  const long power = std::max(power_of_unit(reconstruction), power_of_unit(truth));
  const auto made =
      shape_of(reconstruction, "the reconstruction", power, cameras, options.density, options);
  const auto real = shape_of(truth, "the truth", power, cameras, options.truth_density, options);
  Progress done(progress, std::uint64_t{parts_of(*made)} + parts_of(*real));
  const auto measure = [&](const Shape& from, const Shape& to) {
    SurfaceDistances summary = summary_of(distances_of(from, to, options, done), options);
    summary.cloud_points = from.cloud_points();
    return summary;
  };
  SurfaceComparison comparison;
  comparison.accuracy = measure(*made, *real);
  comparison.completeness = measure(*real, *made);
  if (comparison.accuracy.has_figures() && comparison.completeness.has_figures())
    comparison.overall = (comparison.accuracy.mean + comparison.completeness.mean) / 2;
  for (std::size_t i = 0; i < options.within.size(); ++i) {
    const double precision = comparison.accuracy.shares[i];
    const double recall = comparison.completeness.shares[i];
    const double sum = precision + recall;
    comparison.f_scores.push_back(sum == 0 ? 0 : 2 * precision * recall / sum);
  }
  return comparison;
}

}  // namespace

bool is_cloud(const Scene& scene) {
  return triangle_count(scene) == 0 && point_count(scene) != 0;
}

void require_meaningful(const SurfaceComparisonOptions& options) {
  const StandardArithmetic standard;
  if (options.points == 0) throw UsageError(Setting{"points"}, "expected at least 1");
  const auto require_positive = [](double number, const char* setting) {
    if (!(number > 0) || std::isinf(number))
      throw UsageError(Setting{setting}, "expected a positive number");
  };
  for (const double within : options.within) require_positive(within, "within");
  if (options.density) require_positive(*options.density, "density");
  if (options.truth_density) require_positive(*options.truth_density, "truth_density");
  if (options.max_distance) require_positive(*options.max_distance, "max_distance");
  require_thread_count(options.threads);
}

void require_comparable(const Scene& reconstruction, const Scene& truth,
                        const std::vector<Camera>& cameras,
                        const SurfaceComparisonOptions& options) {
  const StandardArithmetic standard;
  for (const Camera& camera : cameras) {
    require_valid(camera);
    require_straight(camera);
  }
  require_shape(reconstruction, "the reconstruction");
  require_shape(truth, "the truth");
  require_applicable(reconstruction, truth, cameras, options);
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
    require_comparable(reconstruction, truth, cameras, options);
    return compare_in_arena(reconstruction, truth, cameras, options, progress);
  });
}

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
