#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/rendering/options.h"
#include "fathom/scene/scene.h"

namespace fathom {

/// A point of a surface and how far it is from the other one; scene units.
struct MeasuredPoint {
  /// Each coordinate in the world is the exact one rounded once, as the distance is.
  std::array<double, 3> at{};
  double distance = 0;
};

/// The points as a PLY file, binary little endian: x y z and the distance as `quality`, the name
/// that MeshLab and CloudCompare know, all double.
std::vector<std::byte> ply_of(const std::vector<MeasuredPoint>& points);

/// How far the points of one surface are from another, over the points that count.
struct SurfaceDistances {
  /// Points on the surface, and the number of counted points, which a camera sees.
  std::uint64_t points = 0, seen = 0;
  /// Scene units; all 0 if no point counts.
  double mean = 0, rms = 0;
  /// By nearest rank.
  double median = 0, p90 = 0, p99 = 0, max = 0;
  /// For each threshold, the share of the points whose distance is less.
  std::vector<double> shares;
  /// The points that count, in their order, where they are kept (SurfaceComparisonOptions).
  std::vector<MeasuredPoint> measured;
};

struct SurfaceComparisonOptions {
  /// On each of the two surfaces.
  std::uint32_t points = 200000;
  /// Thresholds, in scene units.
  std::vector<double> within;
  /// Of what the cameras see.
  Cull cull = Cull::none;
  /// Keep every point that counts with its distance.
  bool keep_points = false;
  /// Threads to use; 0: all.
  int threads = 0;
};

/// Refuses options that mean nothing.
/// Fails    UsageError for no points, a threshold that is not a positive number, and threads that
///          cannot be asked for.
void require_meaningful(const SurfaceComparisonOptions& options);

/// The figures, in addition to Depth L1, by which reconstructions are ranked.
struct SurfaceComparison {
  /// From the reconstruction to the truth; `shares` are known as precision.
  SurfaceDistances accuracy;
  /// From the truth to the reconstruction; `shares` are known as completion ratio or recall.
  SurfaceDistances completeness;
  /// For each threshold the harmonic mean of precision and recall; 0 where both are.
  std::vector<double> f_scores;
};

/// Compares two surfaces in the same world. Points lie on each surface in proportion to area, and
/// the same surface always gets the same points. A point counts if one of `cameras` sees it on its
/// own surface, regardless of the other surface; without cameras all points count. A distance is
/// measured to the nearest point of the whole other surface, not to points on it.
///
/// Exact    visibility, each distance (rounded once to binary64), and the comparison with a
///          threshold. Means are sums in binary64 in the order of the points. The same on every
///          machine.
/// Fails    InputError if a scene or a camera has a fault (find_fault), a surface has no area, or
///          memory does not hold so many points;
///          UsageError as require_meaningful().
/// Source   [KPZK17] for precision, recall and F-score
SurfaceComparison compare_surfaces(const Scene& reconstruction, const Scene& truth,
                                   const std::vector<Camera>& cameras,
                                   const SurfaceComparisonOptions& options = {},
                                   const std::function<void(double)>& progress = {});

}  // namespace fathom
