#include "fathom/area/cell_division.h"

#include "fathom/threads/interruption.h"

namespace fathom::area {
namespace {

class DividedPolygons {
 public:
  DividedPolygons(ImageCell& cell, CellPart part, TierCounts& counts)
      : cell_(&cell), part_(std::move(part)), counts_(&counts) {}

  void add(ConvexPolygon polygon) {
    if (complete_) return;
    complete_ = part_.is_all(polygon);
    if (complete_) polygons_.clear();
    polygons_.push_back(std::move(polygon));
  }
  [[nodiscard]] std::size_t size() const { return polygons_.size(); }
  [[nodiscard]] std::span<const ConvexPolygon> polygons() const { return polygons_; }

  [[nodiscard]] std::vector<DividedPolygons> halves() const {
    return divided(cell_->halves(part_));
  }

  /// Along an edge of the largest polygon.
  std::vector<DividedPolygons> halves_along_edge() {
    merge_lines();
    const HalfPlane* edge = nullptr;
    double greatest = -1;
    for (const ConvexPolygon& polygon : polygons_) {
      const double size = size_of(polygon.bounds());
      if (!(size > greatest)) continue;
      const HalfPlane* its = part_.first_inside(polygon);
      if (!its) continue;
      edge = its;
      greatest = size;
    }
    if (!edge) return {};
    return divided(cell_->halves_along(part_, *edge));
  }

 private:
  /// Of the box around a polygon.
  static double size_of(const BoundingRectangle& bounds) {
    const double size = (bounds.u.upper - bounds.u.lower) * (bounds.v.upper - bounds.v.lower);
    return size >= 0 ? size : 0;
  }

  void merge_lines() {
    MergedLines& lines = cell_->merged_lines();
    part_.outline = lines.of(part_.outline);
    for (ConvexPolygon& polygon : polygons_) polygon = lines.of(polygon);
  }

  [[nodiscard]] std::vector<DividedPolygons> divided(
      const std::vector<ImageCell::Half>& halves) const {
    std::vector<DividedPolygons> result;
    for (const ImageCell::Half& half : halves) {
      DividedPolygons& inside = result.emplace_back(*cell_, half.part, *counts_);
      for (const ConvexPolygon& polygon : polygons_) {
        check_interruption();
        if (inside.complete_) break;
        if (auto piece = in_half(polygon, half, *counts_)) inside.add(std::move(*piece));
      }
    }
    return result;
  }

  ImageCell* cell_;
  CellPart part_;
  TierCounts* counts_;
  std::vector<ConvexPolygon> polygons_;
  bool complete_ = false;
};

}  // namespace

void for_each_simple_part(ImageCell& cell, std::vector<ConvexPolygon> polygons, TierCounts& counts,
                          const std::function<void(std::span<const ConvexPolygon>)>& visit) {
  DividedPolygons all(cell, cell.all(), counts);
  for (ConvexPolygon& polygon : polygons) all.add(std::move(polygon));
  divide(std::move(all), [&](const DividedPolygons& part) { visit(part.polygons()); });
}

}  // namespace fathom::area
