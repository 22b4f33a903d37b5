#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "fathom/area/areas.h"
#include "fathom/area/plane/plane_areas.h"
#include "fathom/camera/camera.h"
#include "fathom/scene/triangle_source.h"

/// Lights: cameras that see the same triangles, and the parts of triangles that a light sees.
namespace fathom::area {

// Cameras that see the same triangles as a distant light or a lamp. Their poses are not rotations,
// so that nothing is rounded; shares of triangles do not depend on the difference.

/// The camera whose image contains the whole scene along a direction d: with k the axis of the
/// greatest |d_k| and i, j the next two in cyclic order, u and v are x_i·d_k − x_k·d_i and
/// x_j·d_k − x_k·d_j times a power of two, shifted; D is −sign(d_k)·x_k, shifted.
/// Fails    UsageError if the direction is 0 or not finite, or if the power or the shift is not a
///          number of binary64.
Camera camera_of_direction(const TriangleSource& triangles, const std::array<double, 3>& direction);

/// Six cameras of 90° around a point, along the axes.
/// Fails    UsageError if the point is not finite.
std::vector<Camera> cameras_of_point(const std::array<double, 3>& point);

// The parts of triangles that a light sees, as sums with bounds, and as exact numbers on request.
// The caller computes the irrational factors of an area: the length of a direction and the lengths
// of normals.

enum class LightKind : std::uint8_t { direction, point, camera };

/// The part of a triangle that a light sees.
struct SeenTriangle {
  LitSide side = LitSide::edge;
  /// The visible share of the triangle's area, and this share times 3β and 3γ of its centre.
  SurfaceSums sums;
  /// Exact terms of the sums, unless they are still unknown, and of the visible area in pixels from
  /// a camera. The scene keeps them.
  const SurfaceTerms* terms = nullptr;
  bool has_exact_sums = false;
  /// From a camera, in pixels: the area with all other triangles removed.
  Ratio unoccluded;
  ExactVector3 corner, to_second, to_third, normal;
  /// |n·d| of a direction.
  Dyadic facing;

  // Exact sums, which take long. share() and moment() need has_exact_sums.
  [[nodiscard]] Ratio share() const { return sum_of(terms->share); }
  [[nodiscard]] Ratio visible() const { return sum_of(terms->image); }
  /// The share times the centre.
  [[nodiscard]] Ratio moment(std::size_t axis) const;
};

/// The visible parts of all triangles, from the cameras of a light.
class SeenScene {
 public:
  /// `light` is the direction, or the point. A point has six cameras, other lights have one.
  SeenScene(const TriangleSource& triangles, LightKind kind, const std::vector<Camera>& cameras,
            const std::array<double, 3>& light, Cull cull);

  /// Whether nothing is visible of a triangle, for certain.
  [[nodiscard]] bool is_hidden(std::uint32_t number) const {
    return is_exact_zero(sums_[number].share);
  }
  [[nodiscard]] SeenTriangle triangle(std::uint32_t number) const;
  /// Computes the exact terms of the sums of some triangles.
  void find_exact_sums(std::span<const std::uint32_t> numbers);

  /// From a camera, terms whose sum is the area of the image in which something is visible.
  [[nodiscard]] Terms image_terms() const;
  /// Of some triangles, in ascending order, the visible area of each with all triangles but these
  /// removed: share·|n·d| of a direction, pixels of a camera. No area is 0.
  /// Needs    a direction or a camera.
  [[nodiscard]] Terms alone(std::span<const std::uint32_t> numbers) const;

 private:
  /// Triangles as a camera sees them.
  struct View {
    View(const ProjectedScene& scene, const WantedTerms& wanted);
    PlaneMesh mesh;
    PlaneAreas areas;
  };
  void add(View& view, const WantedTerms& wanted);
  void add_image(const ProjectedScene& scene, bool is_mirrored);
  /// The triangle's place and facing; nothing that depends on other triangles.
  [[nodiscard]] SeenTriangle placed(std::uint32_t number) const;
  [[nodiscard]] LitSide side_of(std::uint32_t number, SeenTriangle& seen) const;

  const TriangleSource& triangles_;
  LightKind kind_;
  std::array<double, 3> light_;
  std::deque<ProjectedScene> scenes_;
  std::deque<View> views_;
  std::vector<SurfaceSums> sums_;
  std::vector<SurfaceTerms> terms_;
  std::vector<bool> has_exact_sums_;
  /// From a camera.
  std::vector<Ratio> unoccluded_;
  /// The sign of n·d.
  std::vector<Sign> facings_;
};

}  // namespace fathom::area
