#include "fathom/area/cell_division.h"

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

  [[nodiscard]] std::array<DividedPolygons, 2> halves() const {
    const std::array<ImageCell::Half, 2> parts = cell_->halves(part_);
    const auto half = [&](const ImageCell::Half& its) {
      DividedPolygons result(*cell_, its.part, *counts_);
      for (const ConvexPolygon& polygon : polygons_) {
        if (result.complete_) break;
        if (auto piece = in_half(polygon, its, *counts_)) result.add(std::move(*piece));
      }
      return result;
    };
    return {half(parts[0]), half(parts[1])};
  }

 private:
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
