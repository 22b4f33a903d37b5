#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <functional>
#include <limits>
#include <string_view>

#include "fathom/camera/camera.h"
#include "fathom/numeric/ratio.h"
#include "fathom/rendering/options.h"
#include "fathom/scene/triangle_source.h"

namespace fathom {

/// Which visible edges are wanted; each choice includes the previous one.
enum class EdgeSelection : std::uint8_t {
  silhouettes,  ///< outlines
  creases,      ///< also edges between triangles that meet at an angle
  all           ///< also edges between triangles that lie in one plane
};

inline constexpr std::array all_edge_selections{EdgeSelection::silhouettes, EdgeSelection::creases,
                                                EdgeSelection::all};
std::string_view name_of(EdgeSelection selection);

struct EdgeOptions {
  EdgeSelection edges = EdgeSelection::creases;
  /// The least angle by which a surface turns at a crease, in degrees from 0 to 180. Its cosine is
  /// rounded once to binary64; every decision with this cosine is exact.
  double crease_angle = 30;
  Cull cull = Cull::none;
  /// 0: all.
  int threads = 0;
};

/// A line of the scene.
struct EdgeName {
  enum class Kind : std::uint8_t {
    edge,     ///< of triangles: a and b are its ends; ends at the same place have the same number
    cut,      ///< where the camera's range, or the plane through the eye, cuts triangle a
    crossing  ///< where triangles a and b cross
  };
  Kind kind = Kind::edge;
  std::uint32_t a = 0, b = 0;
  friend auto operator<=>(const EdgeName&,
                          const EdgeName&) = default;  // NOLINT(modernize-use-nullptr)
};

/// A place on the image, in pixels, y down (specification, section 2).
struct ImagePlace {
  Ratio u, v;
};

/// A visible part of an edge: on its two sides, different triangles or the background are visible.
struct VisibleEdge {
  static constexpr std::uint32_t background = std::numeric_limits<std::uint32_t>::max();

  EdgeName name;
  ImagePlace from, to;
  /// The triangle whose edge it is; if it is an edge of both, or of neither (a crossing), the lower
  /// number.
  std::uint32_t owner = 0;
  /// The triangle that is visible on the other side, or background.
  std::uint32_t other = background;
  /// Whether the surface continues: both triangles belong to the same object and have an edge
  /// there, at the same depth. All other edges are outlines.
  bool joined = false;
};

/// Calls visit(edge) for the visible edges within the image. They do not overlap. Edges of the same
/// name come one after another, in their order along the line, and touch without a gap where
/// nothing hides them. A triangle that is seen edge on has no area and shows no edges; a triangle
/// is visible as in specification, section 8.
/// Exact    every decision and every place.
/// Fails    InputError where scene or camera has a fault (find_fault); UsageError for a camera with
///          a lens that bends rays, or a crease angle outside 0 to 180.
/// Source   [War69]; area/plane/
void visible_edges(const TriangleSource& triangles, const Camera& camera,
                   const EdgeOptions& options, const std::function<void(const VisibleEdge&)>& visit,
                   const std::function<void(double)>& progress = {});

}  // namespace fathom
