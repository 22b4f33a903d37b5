#include "fathom/area/visible_fragments.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fathom/area/cell_coverage.h"
#include "fathom/area/image_cell.h"
#include "fathom/numeric/rounding.h"
#include "fathom/threads/interruption.h"

namespace fathom::area {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// a·b; one of them is a constant form.
ExactVector3 product(const LinearForm& a, const LinearForm& b) {
  const bool a_is_constant = a.coefficients()[0].is_zero() && a.coefficients()[1].is_zero();
  const Dyadic& factor = a_is_constant ? a.coefficients()[2] : b.coefficients()[2];
  const auto& l = a_is_constant ? b.coefficients() : a.coefficients();
  return {factor * l[0], factor * l[1], factor * l[2]};
}

}  // namespace

// n_s/w_s < n_t/w_t ⇔ n_t·w_s − n_s·w_t > 0, as both weights are positive where s and t cover. For
// a perspective camera D is the W of the corners, so n is |Δ|, a constant; for an orthographic one
// W = 1, and w is.
LinearForm in_front(const SurfaceRegion& s, const SurfaceRegion& t) {
  const ExactVector3 a = product(t.depth_numerator, s.weight);
  const ExactVector3 b = product(s.depth_numerator, t.weight);
  return LinearForm({a[0] - b[0], a[1] - b[1], a[2] - b[2]});
}

CellVisibility::CornerDepths CellVisibility::depths_of(const SurfaceRegion& surface) const {
  CornerDepths depths;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto [u, v] = part_.corner(k);
    const Interval weight = surface.weight.enclose_at(u, v);
    depths[k] = weight.lower > 0 ? quotient(surface.depth_numerator.enclose_at(u, v), weight)
                                 : Interval{-infinity, infinity};
  }
  return depths;
}

bool CellVisibility::add(const SurfaceRegion& surface) {
  auto piece = cell_->clip(surface.region, counts_);
  if (!piece) return false;
  pieces_.push_back({&surface, std::move(piece->polygon), piece->is_whole, depths_of(surface)});
  return true;
}

// From front to back. A surface whose nearest point is farther away than all previous surfaces is
// hidden wherever one of these is; so it is not added if they cover all of it.
void CellVisibility::add_visible(std::span<const SurfaceRegion* const> surfaces) {
  // A heap, because usually the first few hide all others.
  std::vector<const SurfaceRegion*> left(surfaces.begin(), surfaces.end());
  const auto is_after = [](const auto* a, const auto* b) { return is_nearer(*b, *a); };
  std::make_heap(left.begin(), left.end(), is_after);
  Remainder uncovered(*cell_, part_.outline);
  double farthest = -infinity;
  std::uint32_t last = 0;
  for (; !left.empty(); left.pop_back()) {
    check_interruption();
    std::pop_heap(left.begin(), left.end(), is_after);
    const SurfaceRegion& surface = *left.back();
    const bool is_behind = surface.depths.lower > farthest ||
                           (surface.depths.lower == farthest && surface.number > last);
    if (is_behind && uncovered.is_empty()) break;
    if (!add(surface)) continue;
    const ConvexPolygon& polygon = pieces_.back().polygon;
    if (is_behind && !uncovered.meets(polygon)) {
      pieces_.pop_back();
      continue;
    }
    farthest = std::max(farthest, surface.depths.upper);
    last = std::max(last, surface.number);
    uncovered.subtract(polygon, Remainder::simple);
  }
}

std::optional<ConvexPolygon> CellVisibility::add_if_it_hides(const SurfaceRegion& surface,
                                                             std::size_t piece) {
  if (quick_order(depths_of(surface), pieces_[piece].depths) == Order::behind) return std::nullopt;
  if (are_disjoint(surface, *pieces_[piece].surface)) return std::nullopt;
  if (!add(surface)) return std::nullopt;
  auto hidden = hidden_part(pieces_[piece].polygon, piece, size() - 1);
  if (!hidden) pieces_.pop_back();
  return hidden;
}

// The form of in_front() is affine: the signs at the corners of the cell decide the signs inside.
CellVisibility::Order CellVisibility::quick_order(const CornerDepths& s, const CornerDepths& t) {
  bool in_front = true, behind = true;
  for (std::size_t k = 0; k < 4; ++k) {
    in_front &= s[k].upper < t[k].lower;
    behind &= t[k].upper < s[k].lower;
  }
  return in_front ? Order::in_front : behind ? Order::behind : Order::unknown;
}

bool CellVisibility::is_in_front(const PieceOfSurface& s, const PieceOfSurface& t) const {
  const Order order = quick_order(s.depths, t.depths);
  if (order != Order::unknown) return order == Order::in_front;
  const LinearForm form = area::in_front(*s.surface, *t.surface);
  if (form.is_zero()) return s.surface->number < t.surface->number;
  if (const auto sign = part_.sign_of(form)) return sign == Sign::positive;
  if (!is_merged_) return false;
  // Not settled by the rectangle around the part: the corners of its outline decide.
  const HalfPlane line(cell_->localised(form));
  ConvexPolygon rest = part_.outline;
  TierCounts counts;
  return rest.clip(line, counts) && rest.edges() == part_.outline.edges();
}

/// Removes the pieces behind a piece that covers the whole part.
void CellVisibility::drop_behind(std::size_t whole) {
  const PieceOfSurface hiding = pieces_[whole];
  std::erase_if(pieces_, [&](const PieceOfSurface& piece) {
    return piece.surface != hiding.surface && is_in_front(hiding, piece);
  });
}

// Begins with the nearest piece, which usually hides all others.
void CellVisibility::drop_hidden() {
  std::optional<std::size_t> nearest;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    if (!pieces_[i].is_whole) continue;
    if (!nearest || is_in_front(pieces_[i], pieces_[*nearest])) nearest = i;
  }
  if (!nearest) return;
  drop_behind(*nearest);
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    check_interruption();
    if (!pieces_[i].is_whole) continue;
    const SurfaceRegion* hiding = pieces_[i].surface;
    drop_behind(i);
    while (pieces_[i].surface != hiding) --i;
  }
}

std::vector<CellVisibility> CellVisibility::divided(
    const std::vector<ImageCell::Half>& halves) const {
  std::vector<CellVisibility> result;
  for (const ImageCell::Half& its : halves) {
    check_interruption();
    CellVisibility half(*cell_, its.part);
    half.is_merged_ = is_merged_;
    for (const PieceOfSurface& piece : pieces_) {
      auto polygon = in_half(piece.polygon, its, half.counts_);
      if (!polygon) continue;
      const bool is_whole = its.part.is_all(*polygon);
      half.pieces_.push_back(
          {piece.surface, std::move(*polygon), is_whole, half.depths_of(*piece.surface)});
    }
    half.drop_hidden();
    result.push_back(std::move(half));
  }
  return result;
}

std::vector<CellVisibility> CellVisibility::halves() const {
  return divided(cell_->halves(part_));
}

void CellVisibility::merge_lines() {
  MergedLines& lines = cell_->merged_lines();
  part_.outline = lines.of(part_.outline);
  for (PieceOfSurface& piece : pieces_) {
    piece.polygon = lines.of(piece.polygon);
    piece.is_whole = part_.is_all(piece.polygon);
  }
  is_merged_ = true;
}

/// An edge that is not a side of the part, of the piece whose plane is nearest at its middle.
const HalfPlane* CellVisibility::edge_in_front() const {
  const HalfPlane* edge = nullptr;
  double nearest = infinity;
  std::uint32_t number = 0;
  for (const PieceOfSurface& piece : pieces_) {
    if (piece.is_whole) continue;
    double depth = 0;
    for (const Interval& at_corner : piece.depths) depth += at_corner.lower / 4;
    // An unknown depth is −∞ and comes last.
    if (!(depth > -infinity)) depth = std::numeric_limits<double>::max();
    const bool is_nearer = depth < nearest || (depth == nearest && piece.surface->number < number);
    if (edge && !is_nearer) continue;
    edge = part_.first_inside(piece.polygon);
    nearest = depth;
    number = piece.surface->number;
  }
  return edge;
}

std::vector<CellVisibility> CellVisibility::halves_along_edge() {
  merge_lines();
  drop_hidden();
  if (const HalfPlane* edge = edge_in_front()) return divided(cell_->halves_along(part_, *edge));
  if (pieces_.size() < 2) return {};
  const LinearForm form = area::in_front(*pieces_[0].surface, *pieces_[1].surface);
  return divided(cell_->halves_along(part_, cell_->add(form)));
}

std::optional<ConvexPolygon> CellVisibility::hidden_part(const ConvexPolygon& polygon,
                                                         std::size_t t, std::size_t s) {
  const PieceOfSurface &behind = pieces_[t], &before = pieces_[s];
  const Order order = quick_order(before.depths, behind.depths);
  if (order == Order::behind) return std::nullopt;
  ConvexPolygon part = polygon;
  if (!part_.clip(part, before.polygon, counts_)) return std::nullopt;
  if (order == Order::in_front) return part;
  const LinearForm form = area::in_front(*before.surface, *behind.surface);
  if (form.is_zero()) {
    if (before.surface->number < behind.surface->number) return part;
    return std::nullopt;
  }
  return cell_->clip(part, form, part_, counts_);
}

std::vector<ConvexPolygon> CellVisibility::hidden_parts(std::size_t piece) {
  const ConvexPolygon& polygon = pieces_[piece].polygon;
  std::vector<ConvexPolygon> hidden;
  for (std::size_t s = 0; s < pieces_.size(); ++s) {
    check_interruption();
    if (s == piece) continue;
    auto part = hidden_part(polygon, piece, s);
    if (!part) continue;
    const bool is_all = part->edges() == polygon.edges();
    if (is_all) hidden.clear();
    hidden.push_back(std::move(*part));
    if (is_all) break;
  }
  return hidden;
}

Boundary CellVisibility::visible(std::size_t piece) {
  const ConvexPolygon& polygon = pieces_[piece].polygon;
  const std::vector<ConvexPolygon> hidden = hidden_parts(piece);
  if (hidden.size() == 1 && hidden[0].edges() == polygon.edges()) return {};
  return boundary_of_difference(polygon, hidden, counts_);
}

std::vector<ConvexPolygon> CellVisibility::visible_polygons(std::size_t piece) {
  Remainder rest(*cell_, pieces_[piece].polygon);
  for (const ConvexPolygon& hidden : hidden_parts(piece)) rest.subtract(hidden);
  return rest.parts();
}

Boundary CellVisibility::uncovered() {
  std::vector<ConvexPolygon> covered;
  for (const PieceOfSurface& piece : pieces_) {
    if (piece.is_whole) return {};
    covered.push_back(piece.polygon);
  }
  return boundary_of_difference(part_.outline, covered, counts_);
}

// At the point a × b, of weight turn(a, b), the form n has the value det(n, a, b) / turn(a, b).
Ratio CellDepths::at(const HalfPlane& a, const HalfPlane& b) const {
  return {determinant(numerator_, a, b).scaled(numerator_.exponent()),
          determinant(weight_, a, b).scaled(weight_.exponent())};
}

Interval CellDepths::enclose_at(const HalfPlane& a, const HalfPlane& b) const {
  // Scaling by a power of two is exact as long as the result is a normal number.
  constexpr long greatest = 500;
  const long exponent = numerator_.exponent() - weight_.exponent();
  const Interval unscaled =
      enclose(approximate_determinant(numerator_, a, b) / approximate_determinant(weight_, a, b));
  const bool scalable =
      std::abs(exponent) < greatest && unscaled.lower > 0x1p-500 && unscaled.upper < 0x1p500;
  if (!scalable) return {-infinity, infinity};
  return {std::ldexp(unscaled.lower, static_cast<int>(exponent)),
          std::ldexp(unscaled.upper, static_cast<int>(exponent))};
}

CellDepths::Extent CellDepths::extent(const Boundary& boundary) const {
  Interval nearest{infinity, infinity}, farthest{-infinity, -infinity};
  for (const BoundarySegment& s : boundary) {
    for (const HalfPlane* end : {s.from, s.to}) {
      const Interval depth = enclose_at(*s.line, *end);
      nearest = {std::min(nearest.lower, depth.lower), std::min(nearest.upper, depth.upper)};
      farthest = {std::max(farthest.lower, depth.lower), std::max(farthest.upper, depth.upper)};
    }
  }
  Extent extent{static_cast<float>(nearest.lower), static_cast<float>(farthest.lower)};
  const bool settled = extent.nearest == static_cast<float>(nearest.upper) &&
                       extent.farthest == static_cast<float>(farthest.upper);
  if (settled) return extent;
  std::optional<Ratio> least, greatest;
  for (const BoundarySegment& s : boundary) {
    for (const HalfPlane* end : {s.from, s.to}) {
      const Interval around = enclose_at(*s.line, *end);
      if (around.lower > nearest.upper && around.upper < farthest.lower) continue;
      Ratio depth = at(*s.line, *end);
      if (!least || depth < *least) least = depth;
      if (!greatest || *greatest < depth) greatest = std::move(depth);
    }
  }
  return {round_to_binary32(*least), round_to_binary32(*greatest)};
}

}  // namespace fathom::area
