#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "fathom/area/plane/projected_scene.h"

/// Sheets: connected triangles of a mesh that lie next to each other on the image.
///
/// Count. Let S be triangles, each turned so that its area is positive. If every directed edge of S
/// occurs in the open part C as often as its opposite, almost all points of C lie in the same
/// number of triangles of S: the boundary of the sum of their areas vanishes in C. Cover. If that
/// number is at least 1, a triangle whose least depth in C is greater than the greatest depth of S
/// in C is hidden in C. Simple. If the remaining triangles together have the number 1, each is
/// visible throughout its part of C.
namespace fathom::area {

/// Some triangles of a scene, without duplicates, and their neighbours.
class PlaneMesh {
 public:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  /// From numbers of triangles, in ascending order; absent triangles are left out, and so are
  /// triangles with the corners of a triangle of a lower number, which hides them.
  PlaneMesh(const ProjectedScene& scene, std::span<const std::uint32_t> numbers);

  [[nodiscard]] const ProjectedScene& scene() const { return *scene_; }
  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(numbers_.size()); }
  /// The number in the scene of triangle i.
  [[nodiscard]] std::uint32_t number(std::uint32_t i) const { return numbers_[i]; }
  /// The only other triangle at the edge from corner k to the next, if it lies on the other side.
  [[nodiscard]] std::uint32_t mate(std::uint32_t i, std::size_t k) const { return mates_[i][k]; }

  [[nodiscard]] bool is_regular(std::uint32_t i) const {
    return scene_->kind(numbers_[i]) == TriangleKind::regular;
  }
  [[nodiscard]] const CornerIndices& corners(std::uint32_t i) const {
    return scene_->corners(numbers_[i]);
  }
  [[nodiscard]] const BoundedPoint& point(std::uint32_t i, std::size_t k) const {
    return scene_->point(corners(i)[k % 3]);
  }
  [[nodiscard]] PlaneBox box(std::uint32_t i) const {
    return {point(i, 0), point(i, 1), point(i, 2)};
  }

 private:
  void keep_first_of_equal(std::span<const std::uint32_t> numbers);
  void find_mates();

  const ProjectedScene* scene_;
  std::vector<std::uint32_t> numbers_;
  std::vector<std::array<std::uint32_t, 3>> mates_;
};

/// Whether a triangle of the mesh certainly has no area in a part.
bool misses(const PlaneMesh& mesh, std::uint32_t i, const PlanePart& part);
/// Bounds of its depth.
Interval depth_of(const PlaneMesh& mesh, std::uint32_t i);
/// Bounds of its depth in the part, which takes longer.
Interval depth_in(const PlaneMesh& mesh, std::uint32_t i, const PlanePart& part);

/// Connected triangles in a part, as places in the list of the triangles in it.
struct Sheet {
  std::vector<std::uint32_t> members;
  /// The number of its triangles in which almost every point of the part lies; 0 if unknown, or not
  /// the same everywhere.
  std::uint32_t count = 0;
};

/// Finds the sheets of triangles in a part. Keeps memory for the next part.
class SheetFinder {
 public:
  explicit SheetFinder(const PlaneMesh& mesh) : mesh_(mesh), place_(mesh.size(), 0) {}
  /// The sheets of triangles, none of which may certainly miss the part.
  std::vector<Sheet> sheets(const PlanePart& part, std::span<const std::uint32_t> triangles);

 private:
  [[nodiscard]] bool is_in_list(std::uint32_t triangle,
                                std::span<const std::uint32_t> triangles) const;
  [[nodiscard]] bool is_closed(const PlanePart& part, std::span<const std::uint32_t> triangles,
                               const Sheet& sheet) const;
  [[nodiscard]] std::uint32_t count(const PlanePart& part, std::span<const std::uint32_t> triangles,
                                    const Sheet& sheet) const;

  const PlaneMesh& mesh_;
  /// Where a triangle is in the list of the present part, if it is there at that place.
  std::vector<std::uint32_t> place_;
};

}  // namespace fathom::area
