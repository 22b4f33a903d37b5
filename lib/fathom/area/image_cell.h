#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "fathom/area/convex_polygon.h"
#include "fathom/area/convex_union.h"
#include "fathom/triangle/projected_triangle.h"

namespace fathom::area {

/// The part of the image to which the points of a triangle with D > 0 and near ≤ D ≤ far project:
/// it consists of the places where no form is negative. It is a convex polygon, perhaps unbounded;
/// nullopt if it is empty.
/// Exact    except for the boundary, which has no area.
///
/// The points of the triangle with W > 0 project to where no edge function is negative, with signs
/// as in section 4 of the specification: s = Σ (eᵢ/Δ)·cornerᵢ has the weight 1. D = n/w with w > 0
/// there, so D ≥ near ⇔ n − near·w ≥ 0.
std::optional<std::vector<LinearForm>> covered_region(const triangle::ProjectedTriangle& t,
                                                      const Camera& camera);

/// The homogeneous image point of a corner, exactly, and an enclosure of it.
struct SurfaceCorner {
  ExactVector3 point;
  std::array<Interval, 3> enclosure;
};

/// A triangle as needed for areas on the image: its region of the image, and D = depth_numerator /
/// weight.
struct SurfaceRegion {
  std::uint32_t number = 0;
  /// From covered_region(): first the edge functions, each positive at the corner of its number.
  std::vector<LinearForm> region;
  LinearForm depth_numerator, weight;
  std::array<SurfaceCorner, 3> corners;
  /// An interval that contains D at every point of the triangle.
  Interval depths;
};
/// Compares surfaces by their nearest points, then by their numbers.
inline bool is_nearer(const SurfaceRegion& a, const SurfaceRegion& b) {
  return std::pair(a.depths.lower, a.number) < std::pair(b.depths.lower, b.number);
}
std::optional<SurfaceRegion> surface_region(const triangle::ProjectedTriangle& t,
                                            const Camera& camera);

/// A cell or a convex part of it.
struct CellPart {
  /// In the coordinates of the cell.
  ConvexPolygon outline;
  /// A rectangle around the part, in coordinates of the image.
  double left, top, right, bottom;

  /// Corner 0 to 3 of that rectangle.
  [[nodiscard]] ImagePoint corner(std::size_t k) const {
    return {k % 2 == 0 ? left : right, k < 2 ? top : bottom};
  }
  /// Whether a half-plane is the object that bounds one of its sides.
  [[nodiscard]] bool is_side(const HalfPlane* edge) const {
    return std::find(outline.edges().begin(), outline.edges().end(), edge) != outline.edges().end();
  }
  /// The first edge, of a polygon in the part, that is not a side of the part; null if there is
  /// none.
  [[nodiscard]] const HalfPlane* first_inside(const ConvexPolygon& polygon) const {
    const auto inside = std::find_if_not(polygon.edges().begin(), polygon.edges().end(),
                                         [&](const HalfPlane* edge) { return is_side(edge); });
    return inside == polygon.edges().end() ? nullptr : *inside;
  }
  /// Whether a polygon in the part is the whole part.
  [[nodiscard]] bool is_all(const ConvexPolygon& polygon) const { return !first_inside(polygon); }
  /// Clips a polygon in the part at the edges of another polygon in the part. Returns false, and
  /// leaves an unusable polygon, if they have no area in common.
  [[nodiscard]] bool clip(ConvexPolygon& polygon, const ConvexPolygon& by,
                          TierCounts& counts) const {
    return polygon.bounds().may_meet(by.bounds()) &&
           std::all_of(by.edges().begin(), by.edges().end(), [&](const HalfPlane* edge) {
             return is_side(edge) || polygon.clip(*edge, counts);
           });
  }
  /// The sign of the form if it is certainly the same in the whole part (0 allowed on the rim).
  [[nodiscard]] std::optional<Sign> sign_of(const LinearForm& form) const;
};

/// Where a cell is on the image.
struct CellRectangle {
  double left, top, right, bottom;
};

/// A rectangle of the image, for instance a pixel, and the convex pieces of it that triangles
/// project to. Its coordinates begin at its own top left corner, so that numbers are small.
class ImageCell {
 public:
  explicit ImageCell(const CellRectangle& rectangle);
  ImageCell(std::uint32_t column, std::uint32_t row, std::uint32_t width = 1,
            std::uint32_t height = 1);
  ImageCell(const ImageCell&) = delete;
  ImageCell& operator=(const ImageCell&) = delete;

  /// The cell itself.
  [[nodiscard]] const CellPart& all() const { return *all_; }
  [[nodiscard]] const ConvexPolygon& whole() const { return all_->outline; }
  /// Whether a half-plane is the half-plane of one of the cell's own sides.
  [[nodiscard]] bool is_side(const HalfPlane* edge) const { return all_->is_side(edge); }
  /// A part of a part, on the inside of a line.
  struct Half {
    CellPart part;
    const HalfPlane* side;
  };
  /// The halves of a part, cut across the longer side of the rectangle around it; a single half if
  /// this cut misses the part.
  std::vector<Half> halves(const CellPart& part);
  /// The parts on the inside and the outside of a line; a single part if the line misses the
  /// interior of the part.
  std::vector<Half> halves_along(const CellPart& part, const HalfPlane& line);

  /// After the first call, sides of halves are merged too.
  MergedLines& merged_lines() {
    merges_ = true;
    return merged_lines_;
  }

  struct Piece {
    ConvexPolygon polygon;
    /// Whether the piece is the whole cell.
    bool is_whole = false;
  };
  /// The part of the cell in which no form is negative, if it has an area.
  std::optional<Piece> clip(const std::vector<LinearForm>& region, TierCounts& counts);
  /// The part of a polygon in which a form is not negative, if it has an area. The polygon lies in
  /// a part of this cell, by default the whole cell.
  std::optional<ConvexPolygon> clip(const ConvexPolygon& polygon, const LinearForm& form,
                                    TierCounts& counts) {
    return clip(polygon, form, all(), counts);
  }
  std::optional<ConvexPolygon> clip(const ConvexPolygon& polygon, const LinearForm& form,
                                    const CellPart& part, TierCounts& counts);

  [[nodiscard]] std::optional<Sign> sign_in_cell(const LinearForm& form) const {
    return all_->sign_of(form);
  }

  /// The half-plane in which a form that is not constant is not negative.
  const HalfPlane& add(const LinearForm& form) { return keep(HalfPlane(localised(form))); }
  /// The half-plane on the other side of a line.
  const HalfPlane& opposite(const HalfPlane& line);
  /// The coefficients of a form in the cell's coordinates.
  [[nodiscard]] ExactVector3 localised(const LinearForm& form) const;

 private:
  const HalfPlane& keep(HalfPlane line);

  /// A deque, because its elements never move.
  std::deque<HalfPlane> half_planes_;
  MergedLines merged_lines_;
  bool merges_ = false;
  std::optional<CellPart> all_;
};

/// Whether one of two surfaces lies outside an edge of the other, so that they have no area in
/// common on the image. Exact; false is inconclusive if one of them reaches behind the camera.
///
/// Every point of s projects to Σ λᵢ·cornerᵢ with λᵢ ≥ 0. So an edge function of t that is positive
/// at no corner of s is positive nowhere in s, wherever its corners are. A corner that both share,
/// as in every mesh, lies on two edges of t; no interval could decide that.
bool are_disjoint(const SurfaceRegion& s, const SurfaceRegion& t);

// Divides a cell until each part has few pieces: the work for a part grows with the cube of the
// number of its pieces, so that thousands of triangles in a pixel would take forever. The areas of
// the parts add up, and their nearest depths are compared.
//
// A part is cut in halves ([War69]) as long as that separates pieces. Halves do not separate
// pieces that cover the same places, such as faces that coincide or edges that lie on each other.
// Then the part is cut along an edge of the piece that hides most. After as many cuts as this
// piece has edges, it is the whole of a part, and only pieces in front of it remain there. Such an
// edge becomes a side of both parts, together with every other edge in the same line.
// Source   [War69], [FKN80]

struct DivisionLimits {
  /// Parts with at most so many pieces are not divided further.
  std::size_t few = 24;
  int cuts = 40;
  /// A cut in halves is in vain if the halves together have many more pieces than the part.
  int cuts_in_vain = 6;
};

template <class State>
std::size_t size_of(const std::vector<State>& parts) {
  std::size_t sum = 0;
  for (const State& part : parts) sum += part.size();
  return sum;
}

/// Calls `visit` with parts of the state, which must have
///   size()                how many pieces there are
///   halves()              the state in the halves of its part
///   halves_along_edge()   the same on both sides of an edge that is not a side of the part;
///                         nothing if there is none
/// It ends, because pieces in a part have fewer edges that are not its sides than before a cut
/// along an edge, and other cuts are limited.
template <class State, class Visit>
void divide(State state, const Visit& visit, DivisionLimits left = {}) {
  if (state.size() <= left.few) {
    visit(state);
    return;
  }
  std::vector<State> parts;
  if (left.cuts > 0) parts = state.halves();
  const bool separate = !parts.empty() && 2 * size_of(parts) <= 3 * state.size();
  bool in_halves = true;
  if (!separate) {
    std::vector<State> along_edge = state.halves_along_edge();
    in_halves = !parts.empty() && left.cuts_in_vain > 0 && size_of(parts) < size_of(along_edge);
    if (!in_halves) parts = std::move(along_edge);
    --left.cuts_in_vain;
  }
  if (in_halves) --left.cuts;
  if (parts.empty()) {
    visit(state);
    return;
  }
  for (State& part : parts) divide(std::move(part), visit, left);
}

/// The part of a polygon in one half of a part of a cell, if it has an area.
inline std::optional<ConvexPolygon> in_half(const ConvexPolygon& polygon,
                                            const ImageCell::Half& half, TierCounts& counts) {
  if (!polygon.bounds().may_meet(half.part.outline.bounds())) return std::nullopt;
  ConvexPolygon result = polygon;
  if (!result.clip(*half.side, counts)) return std::nullopt;
  return result;
}

/// Divides a cell and calls `visit` with the polygons in each part. If a polygon is the whole part,
/// it is the only polygon in the call.
void for_each_simple_part(ImageCell& cell, std::vector<ConvexPolygon> polygons, TierCounts& counts,
                          const std::function<void(std::span<const ConvexPolygon>)>& visit);

}  // namespace fathom::area
