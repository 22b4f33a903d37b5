#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/image/depth_map.h"
#include "fathom/numeric/ratio.h"
#include "fathom/rendering/options.h"
#include "fathom/scene/scene.h"

namespace fathom {

/// Whether a triangle that covers a sample can be visible there (specification, section 5), or the
/// first reason why not. For lenses with rays that need not go forwards, near and far bound the ray
/// distance, and no triangle is `behind`.
enum class Standing : std::uint8_t { counts, behind, before_near, beyond_far, culled };

/// One triangle that covers a sample (specification, sections 4 and 5).
struct CoveringTriangle {
  std::uint32_t number = 0;
  TriangleOrigin origin;
  /// Signs of e_A, e_B, e_C times the sign of Δ: positive inside, zero on the edge.
  std::array<Sign, 3> edge_signs{};
  /// For an edge function that is zero: whether the edge is a left or a top edge.
  std::array<bool, 3> left_or_top{};
  bool front_facing = false;
  /// Whether a CGAL interval settles the sign of Δ, and the signs of the edge functions, as in the
  /// reference engine. Otherwise dyadic numbers decide.
  bool facing_by_interval = false;
  std::array<bool, 3> edge_by_interval{};
  /// The arithmetic that settles the sign of Δ, and the sign of the edge function of corner i
  /// (Deciders).
  [[nodiscard]] std::string_view facing_decided_by() const;
  [[nodiscard]] std::string_view edge_decided_by(std::size_t i) const;
  /// The exact planar depth at the sample, in scene units. Along the ray of a lens the depth may be
  /// irrational: then this number differs from it by at most 2⁻¹⁸⁰ of it.
  Ratio depth;
  bool depth_is_exact = true;
  /// The exact planar depth rounded once to binary32, as in channel Z.
  float stored_depth = 0;
  /// For lenses with rays that need not go forwards: the ray distance rounded once, as in channel
  /// distance.
  std::optional<float> stored_distance;
  Standing standing = Standing::counts;
  /// Whether it is exactly as near as the first triangle of the list.
  bool as_near_as_first = false;
  /// Whether D > 0, near ≤ D ≤ far, and culling keeps the triangle. Only such triangles can be
  /// visible.
  bool counts = false;
};

/// Every triangle that covers the sample at the centre of pixel (x, y), column and row from the top
/// left: nearest first, ties by number; triangles that do not count come last. Empty if a lens
/// gives the sample no ray. `progress` is called as RenderOptions::progress.
///
/// Exact    everything: a bound leaves out only triangles whose corners all lie on one side of the
///          sample's column or row, and none for a lens; exact numbers give the signs of the edges
///          of all other triangles, without a filter.
/// Cost     two bounded products for each vertex, by all threads of with_threads(), and exact
///          numbers for the triangles whose box contains the sample; for a lens, for all triangles.
/// Fails    InputError where scene or camera has a fault (find_fault).
std::vector<CoveringTriangle> probe(const Scene& scene, const Camera& camera, std::uint32_t x,
                                    std::uint32_t y, Cull cull = Cull::none,
                                    const std::function<void(double)>& progress = {});

}  // namespace fathom
