#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "fathom/area/convex_union.h"
#include "fathom/area/coverage_image.h"
#include "fathom/area/image_cell.h"
#include "fathom/threads/interruption.h"
#include "fathom/threads/threads.h"

namespace fathom::area {

/// The surfaces of triangles. Each needs about twenty allocations of memory, so they are made and
/// freed in parts, which several threads can do.
class SurfaceParts {
 public:
  using Part = std::vector<std::optional<SurfaceRegion>>;
  static constexpr std::uint32_t triangles_per_part = 4096;

  explicit SurfaceParts(std::uint32_t triangles)
      : triangles_(triangles), parts_(triangles / triangles_per_part + 1) {}
  SurfaceParts(const SurfaceParts&) = delete;
  SurfaceParts& operator=(const SurfaceParts&) = delete;
  ~SurfaceParts();

  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(parts_.size()); }
  /// Sets the surfaces of a part, of each triangle in it to surface_of(its number).
  template <class SurfaceOf>
  void make(std::uint32_t part, const SurfaceOf& surface_of) {
    const std::uint32_t first = part * triangles_per_part;
    parts_[part].resize(std::min(triangles_per_part, triangles_ - first));
    for (std::uint32_t k = 0; k < parts_[part].size(); ++k) {
      check_interruption();
      parts_[part][k] = surface_of(first + k);
    }
  }
  [[nodiscard]] const SurfaceRegion* operator[](std::uint32_t number) const {
    const auto& surface = parts_[number / triangles_per_part][number % triangles_per_part];
    return surface ? &*surface : nullptr;
  }

 private:
  std::uint32_t triangles_;
  std::vector<Part> parts_;
};

/// All triangles of a scene, prepared for areas on the image, with an index by place.
class SceneSurfaces {
 public:
  /// Reports the parts() of its work to `progress`.
  SceneSurfaces(const CoverageFrame& frame, Progress& progress);
  static std::uint64_t parts(std::uint32_t triangles) { return triangles / triangles_per_report; }

  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(boxes_.size()); }
  /// Null if the triangle covers nothing: seen edge on, culled, or outside the image.
  [[nodiscard]] const SurfaceRegion* surface(std::uint32_t number) const {
    return surfaces_[number];
  }
  [[nodiscard]] const PixelBox& box(std::uint32_t number) const { return boxes_[number]; }
  /// Whether no triangle of a lower number, or none of its object, has the same three corners in
  /// the same cyclic order. Further equal triangles hide nothing that the first does not hide, and
  /// the first hides them.
  [[nodiscard]] bool is_first(std::uint32_t number) const { return first_[number]; }
  [[nodiscard]] bool is_first_of_object(std::uint32_t number) const {
    return first_of_object_[number];
  }
  /// Numbers of the triangles whose boxes meet that of `number`, without `number`, in order.
  [[nodiscard]] std::vector<std::uint32_t> near(std::uint32_t number) const;
  /// The triangles among near() that are not wholly farther away than `number`, from front to back:
  /// those that hide most come first.
  [[nodiscard]] std::vector<std::uint32_t> in_front(std::uint32_t number) const;

 private:
  static constexpr std::uint32_t side_of_tile = 16;
  /// As many as users of the surfaces report at once: making a surface takes about as long.
  static constexpr std::uint32_t triangles_per_report = 8;

  template <class Take>
  void for_each_near(std::uint32_t number, const Take& take) const;
  /// Also sets the triangle's box.
  std::optional<SurfaceRegion> surface_of(const CoverageFrame& frame, std::uint32_t number);
  void find_equal_triangles(const TriangleSource& triangles);

  std::uint32_t columns_;
  std::vector<PixelBox> boxes_;
  SurfaceParts surfaces_;
  std::vector<std::vector<std::uint32_t>> tiles_;
  std::vector<bool> first_, first_of_object_;
};

/// The cell of the image that a box covers.
inline ImageCell cell_of(const PixelBox& box) {
  return {box.first_column, box.first_row, box.last_column - box.first_column + 1,
          box.last_row - box.first_row + 1};
}

/// How far one triangle lies behind another, D_behind − D_front in scene units, over a part of a
/// cell where both cover every point and this is not negative.
class Separation {
 public:
  Separation(const ImageCell& cell, const SurfaceRegion& front, const SurfaceRegion& behind);

  /// Whether it is below `limit`, or at most `limit`, at a point of the boundary (closed).
  [[nodiscard]] bool is_below(const Boundary& boundary, const Dyadic& limit) const;
  [[nodiscard]] bool is_at_most(const Boundary& boundary, const Dyadic& limit) const;
  /// Whether it equals the limit everywhere.
  [[nodiscard]] bool is_constantly(const Dyadic& limit) const;

  /// Its least value over a boundary, rounded once to binary64.
  [[nodiscard]] double least(const Boundary& boundary) const;

 private:
  /// An affine form on the cell, at the cell's own scale.
  struct Form {
    ExactVector3 exact;
    [[nodiscard]] Dyadic at(const ExactVector3& point) const { return dot(exact, point); }
  };
  /// The forms at both ends of a segment, each times a positive weight.
  struct Ends;
  [[nodiscard]] Ends ends_of(const BoundarySegment& segment) const;
  [[nodiscard]] static bool reaches(const Ends& ends, const Dyadic& limit, bool closed);

  Form front_numerator_, front_weight_, behind_numerator_, behind_weight_;
  /// Whether both lie in one plane.
  bool is_zero_;
};

}  // namespace fathom::area
