#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "fathom/area/coverage.h"
#include "fathom/area/image_cell.h"
#include "fathom/area/plane/certain_sides.h"
#include "fathom/threads/threads.h"

namespace fathom::area {

/// How the engine of parts treats a triangle.
enum class TriangleKind : std::uint8_t {
  absent,   // seen edge on, culled, or nowhere in front of the camera and within its range
  regular,  // all of it is, and binary64 bounds its corners well enough
  by_forms  // others: only their exact forms count
};

/// Where the area of a triangle certainly is: nowhere in the image, or all of it inside.
enum class TriangleExtent : std::uint8_t { none, within_image, elsewhere };

/// All triangles of a scene on the image plane of a camera without a lens. Vertices at the same
/// exact place are one vertex, so that neighbours know their common edge by two numbers.
///
/// Does not store exact forms of regular triangles, which are computed on demand.
class ProjectedScene {
 public:
  /// Reports the parts() of its work to `progress`.
  ProjectedScene(const CoverageFrame& frame, Progress& progress);
  static std::uint64_t parts(const TriangleSource& triangles);

  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(kinds_.size()); }
  [[nodiscard]] TriangleKind kind(std::uint32_t number) const { return kinds_[number]; }
  /// Numbers of the vertices of a triangle that is not absent. Of a regular triangle they go round
  /// with a positive area, whichever side is seen.
  [[nodiscard]] const CornerIndices& corners(std::uint32_t number) const {
    return corners_[number];
  }
  [[nodiscard]] const BoundedPoint& point(std::uint32_t vertex) const { return points_[vertex]; }
  [[nodiscard]] const Interval& depth(std::uint32_t vertex) const { return depths_[vertex]; }
  [[nodiscard]] const Dyadic& exact_depth(std::uint32_t vertex) const {
    return vertices_[vertex].depth;
  }
  [[nodiscard]] bool has_perspective() const { return is_perspective_; }
  /// The whole image.
  [[nodiscard]] const PlanePart& image() const { return image_; }

  /// The exact forms of a triangle that is not absent.
  [[nodiscard]] SurfaceRegion surface(std::uint32_t number) const;
  /// The line through two vertices with W > 0, with the inside on the left of the way from the
  /// first to the second.
  [[nodiscard]] ExactVector3 line_through(std::uint32_t from, std::uint32_t to) const;
  /// The surface of a triangle of kind by_forms, which is kept.
  [[nodiscard]] const SurfaceRegion& kept_surface(std::uint32_t number) const {
    return by_forms_.at(number);
  }
  /// The exact place of a vertex on the image, in homogeneous coordinates.
  [[nodiscard]] ExactVector3 homogeneous(std::uint32_t vertex) const;
  /// The sign of the triangle's area on the image with its corners as the mesh has them, for
  /// W > 0; zero if it is seen edge on. Negative where the front is seen.
  [[nodiscard]] Sign orientation(std::uint32_t number) const;
  /// Where the area of a triangle is.
  [[nodiscard]] TriangleExtent extent(std::uint32_t number) const;
  /// The whole area of a regular triangle in pixels, also outside the image.
  [[nodiscard]] Ratio own_area(std::uint32_t number) const;

 private:
  struct ExactVertex {
    Dyadic U, V, depth;
  };
  class VertexNumbers;

  void add_part(const CoverageFrame& frame, const TriangleSource::Part& part,
                VertexNumbers& numbers, Progress& progress);
  void classify(const CoverageFrame& frame, std::uint32_t number);
  [[nodiscard]] Sign orientation_of(const CornerIndices& corners) const;

  bool is_perspective_;
  PlanePart image_;
  std::vector<ExactVertex> vertices_;
  std::vector<BoundedPoint> points_;
  std::vector<Interval> depths_;
  std::vector<CornerIndices> corners_;
  std::vector<TriangleKind> kinds_;
  /// Of triangles that are not absent.
  std::vector<Sign> orientations_;
  std::map<std::uint32_t, SurfaceRegion> by_forms_;
};

}  // namespace fathom::area
