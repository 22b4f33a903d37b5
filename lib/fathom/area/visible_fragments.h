#pragma once

#include <array>
#include <span>
#include <vector>

#include "fathom/area/image_cell.h"

/// Visible surfaces inside a cell of the image (specification, section 8), exactly.
///
/// Weiler and Atherton sort by area: the front polygon cuts all others into an inside and an
/// outside part, and the process continues with both lists until each is one polygon deep. For
/// triangles the same visible areas follow without sorting and without cutting a piece twice. The
/// points that both triangles cover and at which s hides t, D_s < D_t, form a convex polygon,
/// because D_s < D_t is a half-plane on the image; so
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

/// The pieces of a cell, or of a part of a cell, that triangles cover, and the visible part of each
/// piece.
class CellVisibility {
 public:
  explicit CellVisibility(ImageCell& cell) : cell_(&cell), part_(cell.all()) {}

  /// Adds a triangle, in any order. Returns whether it covers a part of the cell; if so, the piece
  /// has the next number.
  bool add(const SurfaceRegion& surface);
  /// Adds many surfaces, in any order, but leaves out most hidden surfaces. Call it before any
  /// piece is added.
  void add_visible(std::span<const SurfaceRegion* const> surfaces);
  [[nodiscard]] std::size_t size() const { return pieces_.size(); }
  [[nodiscard]] const SurfaceRegion& surface(std::size_t piece) const {
    return *pieces_[piece].surface;
  }
  [[nodiscard]] const ConvexPolygon& polygon(std::size_t piece) const {
    return pieces_[piece].polygon;
  }

  /// As add(), unless the triangle hides no part of `piece`, which was added before. Returns the
  /// part that it hides.
  std::optional<ConvexPolygon> add_if_it_hides(const SurfaceRegion& surface, std::size_t piece);
  /// Removes the last piece.
  void drop_last() { pieces_.pop_back(); }
  /// Adds the last piece of another CellVisibility of the same cell.
  void add_last_of(const CellVisibility& other) { pieces_.push_back(other.pieces_.back()); }

  /// Removes pieces that are hidden by a piece that covers the whole part; numbers change.
  void drop_hidden();
  /// For divide(): the pieces in both halves of the part; and the pieces on both sides of an edge
  /// of a piece in front or, if all pieces cover the whole part, of the line where two pieces
  /// change their order. Pieces that are hidden by a piece that covers the whole half are left out.
  [[nodiscard]] std::vector<CellVisibility> halves() const;
  [[nodiscard]] std::vector<CellVisibility> halves_along_edge();

  /// The boundary of the visible part of a piece; empty if it is hidden.
  Boundary visible(std::size_t piece);
  /// The visible part of a piece, in convex polygons.
  std::vector<ConvexPolygon> visible_polygons(std::size_t piece);
  /// The boundary of the area that no piece covers.
  Boundary uncovered();

  /// The part of `polygon`, in the cell and covered by t, where s hides t; nullopt if it has no
  /// area.
  std::optional<ConvexPolygon> hidden_part(const ConvexPolygon& polygon, std::size_t t,
                                           std::size_t s);

  [[nodiscard]] TierCounts& decisions() { return counts_; }

 private:
  /// The parts of a piece that other pieces hide; if they hide all of it, a single polygon that
  /// equals the piece.
  std::vector<ConvexPolygon> hidden_parts(std::size_t piece);
  CellVisibility(ImageCell& cell, CellPart part) : cell_(&cell), part_(std::move(part)) {}

  /// Depths of a triangle's plane at the cell's corners; [−∞, ∞] if unknown.
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
  /// The part of the cell that the pieces lie in.
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
