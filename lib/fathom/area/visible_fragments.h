#pragma once

#include <array>
#include <span>
#include <vector>

#include "fathom/area/image_cell.h"

/// Visible surfaces inside a cell of the image (specification, section 8), exactly.
///
/// Weiler and Atherton sort by area: the polygon that is in front cuts all others into what lies
/// inside it and what lies outside, and the process goes on with both until each list is one
/// polygon deep. For triangles the same visible areas follow without sorting, and without cutting
/// again what has been cut. The points at which s hides t, where both are and D_s < D_t, form a
/// convex polygon, because D_s < D_t is a half-plane on the image; so
///
///   visible(t) = clip(t) without the union over s of t ∩ s ∩ {D_s < D_t}
///
/// for all triangles, even those that penetrate each other or overlap in a cycle. Where D_s and D_t
/// are the same everywhere, the triangle of the lower number hides the other.
/// Source   [WA77]
namespace fathom::area {

/// The form that, at points covered by both triangles, is positive where s is in front of t and
/// zero where they are equally deep.
LinearForm in_front(const SurfaceRegion& s, const SurfaceRegion& t);

/// The pieces of a cell, or of a part of it, that triangles cover, and what of each is visible.
class CellVisibility {
 public:
  explicit CellVisibility(ImageCell& cell) : cell_(&cell), part_(cell.all()) {}

  /// Adds a triangle, in any order. Returns whether it covers a part of the cell; if so, the piece
  /// has the next number.
  bool add(const SurfaceRegion& surface);
  /// Adds many surfaces, in any order, without most of those of which nothing is visible. To be
  /// called before anything else is added.
  void add_visible(std::span<const SurfaceRegion* const> surfaces);
  [[nodiscard]] std::size_t size() const { return pieces_.size(); }
  [[nodiscard]] const SurfaceRegion& surface(std::size_t piece) const {
    return *pieces_[piece].surface;
  }
  [[nodiscard]] const ConvexPolygon& polygon(std::size_t piece) const {
    return pieces_[piece].polygon;
  }

  /// add(), unless the triangle hides nothing of a piece that was added before. Returns what it
  /// hides.
  std::optional<ConvexPolygon> add_if_it_hides(const SurfaceRegion& surface, std::size_t piece);
  /// Removes the last piece.
  void drop_last() { pieces_.pop_back(); }
  /// Adds the last piece of another CellVisibility of the same cell.
  void add_last_of(const CellVisibility& other) { pieces_.push_back(other.pieces_.back()); }

  /// Removes pieces that are hidden by one that is the whole part; numbers change.
  void drop_hidden();
  /// For divide(): the pieces in both halves of the part, and on both sides of an edge of a piece
  /// in front or, where all are the whole part, of the line where two of them change places.
  /// Without those hidden by one that is the whole half.
  [[nodiscard]] std::vector<CellVisibility> halves() const;
  [[nodiscard]] std::vector<CellVisibility> halves_along_edge();

  /// The boundary of the visible part of a piece; empty if it is hidden.
  Boundary visible(std::size_t piece);
  /// The visible part of a piece, in convex polygons.
  std::vector<ConvexPolygon> visible_polygons(std::size_t piece);
  /// The boundary of what no piece covers.
  Boundary uncovered();

  /// The part of `polygon`, in the cell and covered by t, where s hides t; nullopt if it has no
  /// area.
  std::optional<ConvexPolygon> hidden_part(const ConvexPolygon& polygon, std::size_t t,
                                           std::size_t s);

  [[nodiscard]] TierCounts& decisions() { return counts_; }

 private:
  /// What others hide of a piece; one polygon, equal to the piece, if that is all of it.
  std::vector<ConvexPolygon> hidden_parts(std::size_t piece);
  CellVisibility(ImageCell& cell, CellPart part) : cell_(&cell), part_(std::move(part)) {}

  /// Depths of a triangle's plane at the cell's corners; [−∞, ∞] where that is not known.
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
  void drop_behind(std::size_t whole);
  [[nodiscard]] std::vector<CellVisibility> divided(
      const std::vector<ImageCell::Half>& halves) const;
  void merge_lines();
  [[nodiscard]] const HalfPlane* edge_in_front() const;

  ImageCell* cell_;
  /// The part of the cell that this is about.
  CellPart part_;
  /// Whether edges that lie in one line are one object.
  bool is_merged_ = false;
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
  /// The least and the greatest depth within a boundary that is not empty, each rounded once. D is
  /// monotone along every line, so both are found at ends of segments.
  [[nodiscard]] Extent extent(const Boundary& boundary) const;

  /// D at the point where two lines cross.
  [[nodiscard]] Ratio at(const HalfPlane& a, const HalfPlane& b) const;
  [[nodiscard]] Interval enclose_at(const HalfPlane& a, const HalfPlane& b) const;

 private:
  HalfPlane numerator_, weight_;
};

}  // namespace fathom::area
