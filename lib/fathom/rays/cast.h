#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "fathom/rays/ray.h"
#include "fathom/scene/triangle_source.h"

/// Finds the triangles that rays meet, decided exactly (specification, section 11): no ray is lost
/// between triangles that share an edge, and no ray is counted twice there.
namespace fathom {

namespace rays {
class RayTree;
}

/// A scene that is prepared for rays: a tree around its triangles. Immutable, for any number of
/// threads. A view: the scene must outlive it unchanged.
class RayScene {
 public:
  /// Threads    0: all.
  /// Fails    InputError if the scene has a fault (find_fault); UsageError as
  ///          require_thread_count().
  explicit RayScene(const Scene& scene, int threads = 0);
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;
  ~RayScene();

  [[nodiscard]] const TriangleSource& triangles() const { return triangles_; }
  [[nodiscard]] const rays::RayTree& tree() const { return *tree_; }
  /// The size of the tree in memory.
  [[nodiscard]] std::uint64_t bytes() const;

 private:
  TriangleSource triangles_;
  std::unique_ptr<const rays::RayTree> tree_;
};

/// All functions below
/// Exact    every decision; t is rounded once. The answers are in the order of the rays, and do not
///          depend on the number of threads.
/// Fails    InputError if a number of a ray is not finite or a direction is 0; it names the ray by
///          its number. UsageError if t_min > t_max or one of them is NaN, or as
///          require_thread_count().

/// The nearest hit of each ray: the least t, among equals the lowest triangle number.
std::vector<RayHit> cast(const RayScene& scene, std::span<const Ray> rays,
                         const CastOptions& options = {});

/// Whether each ray has a hit.
std::vector<bool> occluded(const RayScene& scene, std::span<const Ray> rays,
                           const CastOptions& options = {});

/// How many hits each ray has.
std::vector<std::uint32_t> count_hits(const RayScene& scene, std::span<const Ray> rays,
                                      const CastOptions& options = {});

/// The hits of ray i are hits[splits[i]], …, hits[splits[i + 1] − 1].
struct RayHitLists {
  std::vector<std::size_t> splits{0};
  std::vector<RayHit> hits;
};
/// Every hit of each ray, by t, then by triangle number.
RayHitLists all_hits(const RayScene& scene, std::span<const Ray> rays,
                     const CastOptions& options = {});

/// How often the surface winds around each point: the sum, over the hits of the ray from it along
/// +x, of 1 for each back face and −1 for each front face. Hits at the point itself do not count.
/// For a closed surface the result is the same along any other direction.
std::vector<std::int64_t> winding_numbers(const RayScene& scene,
                                          std::span<const std::array<double, 3>> points,
                                          int threads = 0);
/// Whether each point is inside: whether its winding number is not 0.
std::vector<bool> contains(const RayScene& scene, std::span<const std::array<double, 3>> points,
                           int threads = 0);

}  // namespace fathom
