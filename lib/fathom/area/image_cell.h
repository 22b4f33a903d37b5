#pragma once

#include <algorithm>
#include <array>
#include <deque>
#include <optional>
#include <vector>

#include "fathom/area/convex_union.h"
#include "fathom/triangle/projected_triangle.h"

namespace fathom::area {

/// Where on the image the points of a triangle with D > 0 and near ≤ D ≤ far project to: where no
/// form is negative. It is a convex polygon, perhaps unbounded; nullopt if there is nothing.
/// Exact    except for the boundary, which has no area.
///
/// The points of the triangle with W > 0 project to where no edge function is negative, with signs
/// as in section 4 of the specification: s = Σ (eᵢ/Δ)·cornerᵢ has the weight 1. D = n/w with w > 0
/// there, so D ≥ near ⇔ n − near·w ≥ 0.
std::optional<std::vector<ImageForm>> covered_region(const triangle::ProjectedTriangle& t,
                                                     const Camera& camera);

/// The homogeneous image point of a corner, exactly, and an enclosure of it.
struct SurfaceCorner {
  ExactVector3 point;
  std::array<Interval, 3> enclosure;
};

/// A triangle as areas on the image need it: where it is seen, and D = depth_numerator / weight.
struct SurfaceRegion {
  std::uint32_t number = 0;
  /// From covered_region(): first the edge functions, each positive at the corner of its number.
  std::vector<ImageForm> region;
  ImageForm depth_numerator, weight;
  std::array<SurfaceCorner, 3> corners;
};
std::optional<SurfaceRegion> surface_region(const triangle::ProjectedTriangle& t,
                                            const Camera& camera);

/// A rectangle of the image in the coordinates of a cell: the cell or a part of it.
struct CellPart {
  ConvexPolygon outline;
  /// In coordinates of the image.
  double left, top, right, bottom;

  /// Corner 0 to 3, in coordinates of the image.
  [[nodiscard]] ImagePoint corner(std::size_t k) const {
    return {k % 2 == 0 ? left : right, k < 2 ? top : bottom};
  }
  /// Whether a half-plane is that of one of its sides.
  [[nodiscard]] bool is_side(const HalfPlane* edge) const {
    return std::find(outline.edges().begin(), outline.edges().end(), edge) != outline.edges().end();
  }
  /// Whether a polygon in it is all of it.
  [[nodiscard]] bool is_all(const ConvexPolygon& polygon) const {
    return std::all_of(polygon.edges().begin(), polygon.edges().end(),
                       [&](const HalfPlane* edge) { return is_side(edge); });
  }
  /// The sign of the form if it is certainly the same in the whole part (0 allowed on the rim).
  [[nodiscard]] std::optional<Sign> sign_of(const ImageForm& form) const;
};

/// A rectangle of the image whose corners are integers, for instance a pixel, and the convex pieces
/// of it that triangles project to. Its coordinates begin at its own top left corner, so that
/// numbers are small.
class ImageCell {
 public:
  ImageCell(std::uint32_t column, std::uint32_t row, std::uint32_t width = 1,
            std::uint32_t height = 1);
  ImageCell(const ImageCell&) = delete;
  ImageCell& operator=(const ImageCell&) = delete;

  /// The cell itself.
  [[nodiscard]] const CellPart& all() const { return *all_; }
  [[nodiscard]] const ConvexPolygon& whole() const { return all_->outline; }
  /// Whether a half-plane is that of one of the cell's own sides.
  [[nodiscard]] bool is_side(const HalfPlane* edge) const { return all_->is_side(edge); }
  /// The halves of a part, cut across its longer side, and for each its half-plane at the cut. The
  /// part must have been made by few cuts, so that the middle is a binary64 number.
  struct Half {
    CellPart part;
    const HalfPlane* side;
  };
  std::array<Half, 2> halves(const CellPart& part);

  struct Piece {
    ConvexPolygon polygon;
    /// Whether the piece is the whole cell.
    bool is_whole = false;
  };
  /// The part of the cell in which no form is negative, if it has an area.
  std::optional<Piece> clip(const std::vector<ImageForm>& region, TierCounts& counts);
  /// The part of a polygon in which a form is not negative, if it has an area. The polygon lies in
  /// a part of this cell, the whole unless given.
  std::optional<ConvexPolygon> clip(const ConvexPolygon& polygon, const ImageForm& form,
                                    TierCounts& counts) {
    return clip(polygon, form, all(), counts);
  }
  std::optional<ConvexPolygon> clip(const ConvexPolygon& polygon, const ImageForm& form,
                                    const CellPart& part, TierCounts& counts);

  [[nodiscard]] std::optional<Sign> sign_in_cell(const ImageForm& form) const {
    return all_->sign_of(form);
  }

  /// The coefficients of a form in the cell's coordinates.
  [[nodiscard]] ExactVector3 localised(const ImageForm& form) const;

 private:
  /// A deque, because it leaves its elements where they are.
  std::deque<HalfPlane> half_planes_;
  std::optional<CellPart> all_;
};

/// The area of the union of what the regions cover of a cell.
class CellCoverage {
 public:
  explicit CellCoverage(ImageCell& cell) : cell_(cell) {}
  void add(const std::vector<ImageForm>& region);
  /// Whether the whole cell is covered: what is added then changes nothing.
  [[nodiscard]] bool is_complete() const { return complete_; }
  [[nodiscard]] Ratio area();
  /// The area, rounded once.
  [[nodiscard]] float rounded_area();
  [[nodiscard]] const TierCounts& decisions() const { return counts_; }

 private:
  [[nodiscard]] Boundary boundary();

  ImageCell& cell_;
  std::vector<ConvexPolygon> pieces_;
  bool complete_ = false;
  TierCounts counts_;
};

}  // namespace fathom::area
