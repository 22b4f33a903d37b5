#pragma once

#include <array>
#include <functional>
#include <vector>

#include "fathom/area/image_cell.h"

/// Visible surfaces inside a cell of the image (specification, section 8), exactly.
///
/// Weiler and Atherton sort by area: the polygon that is in front cuts all others into what lies
/// inside of it and outside, and the process goes on with both until each list is one polygon deep.
/// For triangles the same visible areas follow without sorting and without cutting what is cut
/// already. The points at which s hides t, both there and D_s < D_t, form a convex polygon, because
/// D_s < D_t is a half-plane on the image; so
///
///   visible(t) = clip(t) without the union over s of t ∩ s ∩ {D_s < D_t}
///
/// for all triangles, those that penetrate each other or overlap in a cycle included. Where D_s and
/// D_t are the same all over, the triangle of the lower number hides the other.
/// Source   Kevin Weiler and Peter Atherton, Hidden surface removal using polygon area sorting,
///          SIGGRAPH 1977.
namespace fathom::area {

/// The form that is positive where s, of two triangles that both cover a point, is in front of t,
/// and zero where they are equally deep.
ImageForm in_front(const SurfaceRegion& s, const SurfaceRegion& t);

/// The pieces of a cell, or of a part of it, that triangles cover, and what of each is visible.
class CellVisibility {
 public:
  explicit CellVisibility(ImageCell& cell) : cell_(&cell), part_(cell.all()) {}

  /// Adds a triangle, in any order. Returns whether it covers a part of the cell; if so, the piece
  /// has the next number.
  bool add(const SurfaceRegion& surface);
  [[nodiscard]] std::size_t size() const { return pieces_.size(); }
  [[nodiscard]] const SurfaceRegion& surface(std::size_t piece) const {
    return *pieces_[piece].surface;
  }
  [[nodiscard]] const ConvexPolygon& polygon(std::size_t piece) const {
    return pieces_[piece].polygon;
  }

  /// The same, unless it certainly hides nothing of a piece that is there.
  bool add_if_it_hides(const SurfaceRegion& surface, std::size_t piece);
  /// Adds the last piece of another one about the same cell.
  void add_last_of(const CellVisibility& other) { pieces_.push_back(other.pieces_.back()); }

  /// Leaves out pieces that one that is the whole cell hides; numbers change.
  void drop_hidden();
  /// The pieces in each half of the cell, those that one that is the whole half hides left out.
  [[nodiscard]] std::array<CellVisibility, 2> halves() const;

  /// The boundary of the visible part of a piece; empty where it is hidden. Only triangles that
  /// `counts` accepts, where given, hide it.
  Boundary visible(std::size_t piece, const std::function<bool(const SurfaceRegion&)>& counts = {});
  /// The boundary of what no piece covers.
  Boundary uncovered();

  /// The part of `polygon`, in the cell and covered by t, where s hides t; nullopt if it has no
  /// area.
  std::optional<ConvexPolygon> hidden_part(const ConvexPolygon& polygon, std::size_t t,
                                           std::size_t s);

  [[nodiscard]] TierCounts& decisions() { return counts_; }

 private:
  CellVisibility(ImageCell& cell, CellPart part) : cell_(&cell), part_(std::move(part)) {}

  /// Of a triangle's plane at the cell's corners; [−∞, ∞] where that is not known.
  using CornerDepths = std::array<Interval, 4>;
  struct PieceOfSurface {
    const SurfaceRegion* surface;
    ConvexPolygon polygon;
    bool is_whole;
    CornerDepths depths;
  };
  enum class Order { in_front, behind, unknown };
  [[nodiscard]] static Order quick_order(const CornerDepths& s, const CornerDepths& t);
  [[nodiscard]] CornerDepths depths_of(const SurfaceRegion& surface) const;
  [[nodiscard]] bool is_in_front(const PieceOfSurface& s, const PieceOfSurface& t) const;

  ImageCell* cell_;
  /// What of the cell this is about.
  CellPart part_;
  std::vector<PieceOfSurface> pieces_;
  TierCounts counts_;
};

/// The depths of a triangle's plane at points of a cell.
class CellDepths {
 public:
  CellDepths(const ImageCell& cell, const SurfaceRegion& surface)
      : numerator_(cell.localised(surface.depth_numerator)),
        weight_(cell.localised(surface.weight)) {}

  struct Extent {
    float nearest, farthest;
  };
  /// The least and the greatest depth within a boundary, each rounded once; the boundary is not
  /// empty. D is monotone along every line, so that both are those of ends of segments.
  [[nodiscard]] Extent extent(const Boundary& boundary) const;

  /// D at the point where two lines cross.
  [[nodiscard]] Ratio at(const HalfPlane& a, const HalfPlane& b) const;
  [[nodiscard]] Interval enclose_at(const HalfPlane& a, const HalfPlane& b) const;

 private:
  HalfPlane numerator_, weight_;
};

}  // namespace fathom::area
