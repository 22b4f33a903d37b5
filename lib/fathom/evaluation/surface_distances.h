#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/rendering/options.h"
#include "fathom/scene/scene.h"

namespace fathom {

/// Whether a scene is a point cloud: it has vertices, and no triangles.
/// Fails    InputError if an object names no mesh
bool is_cloud(const Scene& scene);

/// A point of a shape and how far it is from the other one; scene units.
struct MeasuredPoint {
  /// Each coordinate in the world is the exact one rounded once, as the distance is.
  std::array<double, 3> at{};
  double distance = 0;
};

/// The points as a PLY file, binary little endian: x y z and the distance as `quality`, the name
/// that MeshLab and CloudCompare know, all double.
std::vector<std::byte> ply_of(const std::vector<MeasuredPoint>& points);

/// How far the points of one surface or cloud are from another, over the points that count.
struct SurfaceDistances {
  /// Points on the surface or in the thinned cloud, and the number of counted points, which a
  /// camera sees.
  std::uint64_t points = 0, seen = 0;
  /// Points of the cloud before it was thinned; 0 for a surface.
  std::uint64_t cloud_points = 0;
  /// Points that count and are not nearer than SurfaceComparisonOptions::max_distance.
  std::uint64_t outliers = 0;
  /// Whether a point counts that is no outlier. Otherwise the next six are 0.
  [[nodiscard]] bool has_figures() const { return seen > outliers; }
  /// Without the outliers; scene units.
  double mean = 0, rms = 0;
  /// Percentiles by nearest rank.
  double median = 0, p90 = 0, p99 = 0, max = 0;
  /// For each threshold, the share of the points whose distance is less, of all that count.
  std::vector<double> shares;
  /// The points that count, in their order, where they are kept (SurfaceComparisonOptions).
  std::vector<MeasuredPoint> measured;
};

struct SurfaceComparisonOptions {
  /// On each surface. Of a cloud all points are measured.
  std::uint32_t points = 200000;
  /// Thins the reconstruction or the truth, if it is a cloud, before it is compared: in its order,
  /// each point is left out that is nearer than this to a point kept before. Scene units.
  std::optional<double> density, truth_density;
  /// Points that are not nearer than this to the other side, in scene units, are outliers.
  std::optional<double> max_distance;
  /// Thresholds, in scene units.
  std::vector<double> within;
  /// The culling of the cameras' views.
  Cull cull = Cull::none;
  /// Keep every point that counts with its distance.
  bool keep_points = false;
  /// Threads to use; 0: all.
  int threads = 0;
};

/// Refuses options that mean nothing.
/// Fails    UsageError for no points, a threshold, density or greatest distance that is not a
///          positive number, and a number of threads out of range.
void require_meaningful(const SurfaceComparisonOptions& options);

/// Refuses two sides that cannot be compared so, and cameras that see along bent rays.
/// Fails    InputError for a camera with a fault, and a scene that has neither faces nor points, or
///          meshes and point clouds; UsageError for a lens, cameras of two clouds, and the density
///          of a surface.
void require_comparable(const Scene& reconstruction, const Scene& truth,
                        const std::vector<Camera>& cameras,
                        const SurfaceComparisonOptions& options);

/// The figures, in addition to Depth L1, by which reconstructions are ranked.
struct SurfaceComparison {
  /// From the reconstruction to the truth; `shares` are known as precision.
  SurfaceDistances accuracy;
  /// From the truth to the reconstruction; `shares` are known as completion ratio or recall.
  SurfaceDistances completeness;
  /// The mean of the two means, where both exist: what DTU's tables call overall.
  std::optional<double> overall;
  /// For each threshold the harmonic mean of precision and recall; 0 where both are.
  std::vector<double> f_scores;
};

/// Compares two surfaces or point clouds in the same world. A scene without triangles is the cloud
/// of its vertices. Points lie on a surface in proportion to area, and the same surface always gets
/// the same points; all points of a cloud that remain after thinning are measured. A point of a
/// surface counts if one of `cameras` sees it on its own surface, regardless of the other side;
/// without cameras all points count, and points of a cloud always count. A distance is measured to
/// the nearest point of the whole other surface, not to points on it, or to the nearest point of a
/// cloud.
///
/// Exact    visibility, thinning, each distance (rounded once to binary64), and the comparison with
///          a threshold. Means are sums in binary64 in the order of the points. The same on every
///          machine.
/// Fails    InputError if a scene or a camera has a fault (find_fault), a scene has neither area
///          nor points, or memory does not hold so many points;
///          UsageError as require_meaningful() and require_comparable().
/// Source   [KPZK17] for precision, recall and F-score
SurfaceComparison compare_surfaces(const Scene& reconstruction, const Scene& truth,
                                   const std::vector<Camera>& cameras,
                                   const SurfaceComparisonOptions& options = {},
                                   const std::function<void(double)>& progress = {});

}  // namespace fathom
