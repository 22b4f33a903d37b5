#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "fathom/area/convex_union.h"
#include "fathom/area/plane/part_lines.h"
#include "fathom/area/plane/sheets.h"
#include "fathom/area/plane/triangle_words.h"

namespace fathom::area {

/// Visibility among the triangles of a small part, along each line that bounds a triangle, a side
/// of the part, or the area where two triangles change their order in depth. Between its crossings
/// with other such lines, a line has a single visible triangle on either side. Where these
/// triangles differ, the line is a part of the boundary of both visible regions. No polygons are
/// cut, and surfaces that cross, touch or coincide need no special cases.
/// Exact    always. Cost: lines × (triangles + lines·log lines).
class LineSweep {
 public:
  /// More lines take longer than dividing the part along one of them.
  static constexpr std::uint32_t most_lines = 192;
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  /// `limit` is the greatest number of lines.
  LineSweep(const PlaneMesh& mesh, const PlanePart& part,
            const std::vector<std::uint32_t>& triangles, std::uint32_t limit = most_lines);
  LineSweep(const LineSweep&) = delete;
  LineSweep& operator=(const LineSweep&) = delete;

  /// Whether there are at most `limit` lines; if not, spans() and boundaries() must not be called.
  [[nodiscard]] bool is_simple() const { return lines_.size() <= limit_; }

  /// A side of a span: the visible piece, and which of its half-planes the line bounds, as their
  /// order in the surface's region or corners. Both may be `none`.
  struct Side {
    std::uint32_t piece = none, edge = none;
  };
  /// A part of a line with different visible pieces on its two sides. `along`, `from` and `to` are
  /// lines of lines(); the walk has the inside of `along` on its left.
  struct Span {
    std::uint32_t along, from, to;
    Side left, right;
  };
  /// All spans of all lines. Outside the part nothing is visible.
  [[nodiscard]] std::vector<Span> spans();
  /// Of each triangle of the list, whether something of it is hidden in the part. False also if it
  /// has no area in the part.
  [[nodiscard]] std::vector<bool> hidden_somewhere(const std::vector<Span>& spans) const;
  [[nodiscard]] const PartLines& lines() const { return lines_; }
  /// The lines u = 0, v = 0, u = width and v = height of the part.
  [[nodiscard]] const LinePolygon& sides() const { return sides_; }
  /// Whether two pieces are equally deep along the whole stretch of a side of the part that both
  /// cover.
  [[nodiscard]] bool pieces_meet_at_side(std::size_t side) const { return meets_at_side_[side]; }
  /// The boundaries of the visible part of each triangle, in the coordinates of the part, which
  /// begin at its top left corner. Their lines do not move during the lifetime of this object.
  [[nodiscard]] std::vector<Boundary> boundaries(const std::vector<Span>& spans) const;
  /// The exact forms of a triangle of the list.
  [[nodiscard]] const SurfaceRegion& surface(std::size_t piece);
  [[nodiscard]] const TierCounts& decisions() const { return lines_.decisions(); }

 private:
  struct Piece {
    std::uint32_t triangle;
    /// Of a regular triangle.
    std::optional<PlaneBox> box;
    /// Its half-planes, and its polygon within the part; no edges if there is no area.
    std::vector<OrientedLine> region;
    LinePolygon polygon;
    Interval depths;
    std::optional<DepthPlane> depth_plane;
    std::optional<SurfaceRegion> surface;
  };
  /// The order of two pieces where they overlap: the same everywhere, or different on the two sides
  /// of a line.
  struct Order {
    Sign sign = Sign::zero;  // positive if the first is in front
    std::optional<OrientedLine> line;
  };
  /// The stretch of a line that a piece covers, by ranks, and the sides on which it lies.
  struct Extent {
    std::uint32_t piece, from, to;
    bool left, right;
    std::uint32_t edge;
  };
  class Walk;

  [[nodiscard]] ExactVector3 localised(const ExactVector3& form) const;
  void add_sides();
  void add_piece(std::uint32_t triangle);
  [[nodiscard]] bool are_mates(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] bool are_apart(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] const DepthPlane& depth_plane(std::uint32_t piece);
  [[nodiscard]] Order order_of(std::uint32_t s, std::uint32_t t);
  [[nodiscard]] bool meet_at_corner(std::uint32_t a, std::uint32_t b, std::uint32_t e,
                                    std::uint32_t f) const;
  [[nodiscard]] bool meet_on_line(std::uint32_t a, std::uint32_t b, std::uint32_t line) const;
  [[nodiscard]] std::vector<Sign> certain_signs(std::uint32_t s, std::uint32_t t,
                                                const LinePolygon& common);
  [[nodiscard]] ExactVector3 in_front_here(std::uint32_t s, std::uint32_t t);
  [[nodiscard]] Order& order(std::uint32_t s, std::uint32_t t) {
    return orders_[std::size_t{s} * pieces_.size() + t];
  }
  void find_orders();
  void find_meetings(const LinePolygon& common, const std::vector<Sign>& signs);
  [[nodiscard]] bool meets_part(std::uint32_t line) const;

  const PlaneMesh& mesh_;
  PlanePart part_;
  std::uint32_t limit_;
  PartLines lines_;
  LinePolygon sides_;
  std::array<bool, 4> meets_at_side_{};
  std::vector<Piece> pieces_;
  /// Of the pieces s < t, at s·size + t.
  std::vector<Order> orders_;
  /// The lines of changes of order.
  std::vector<std::uint32_t> changes_;
};

}  // namespace fathom::area
