#include "fathom/area/visible_fragments.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fathom/area/cell_division.h"
#include "fathom/area/disjoint_surfaces.h"
#include "fathom/numeric/rounding.h"

namespace fathom::area {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// a·b, one of which is a constant form.
ExactVector3 product(const ImageForm& a, const ImageForm& b) {
  const bool a_is_constant = a.coefficients()[0].is_zero() && a.coefficients()[1].is_zero();
  const Dyadic& factor = a_is_constant ? a.coefficients()[2] : b.coefficients()[2];
  const auto& l = a_is_constant ? b.coefficients() : a.coefficients();
  return {factor * l[0], factor * l[1], factor * l[2]};
}

}  // namespace

// n_s/w_s < n_t/w_t ⇔ n_t·w_s − n_s·w_t > 0, as both weights are positive where s and t cover. For
// a perspective camera D is the W of the corners, so n is |Δ|, a constant; for an orthographic one
// W = 1, and w is.
ImageForm in_front(const SurfaceRegion& s, const SurfaceRegion& t) {
  const ExactVector3 a = product(t.depth_numerator, s.weight);
  const ExactVector3 b = product(s.depth_numerator, t.weight);
  return ImageForm({a[0] - b[0], a[1] - b[1], a[2] - b[2]});
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

bool CellVisibility::add_if_it_hides(const SurfaceRegion& surface, std::size_t piece) {
  if (quick_order(depths_of(surface), pieces_[piece].depths) == Order::behind) return false;
  if (are_disjoint(surface, *pieces_[piece].surface)) return false;
  if (!add(surface)) return false;
  if (hidden_part(pieces_[piece].polygon, piece, size() - 1)) return true;
  pieces_.pop_back();
  return false;
}

// The form of in_front() is affine: the signs at the corners of the cell decide those inside.
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
  const ImageForm form = area::in_front(*s.surface, *t.surface);
  if (form.is_zero()) return s.surface->number < t.surface->number;
  return part_.sign_of(form) == Sign::positive;
}

void CellVisibility::drop_hidden() {
  for (std::size_t w = 0; w < pieces_.size(); ++w) {
    if (!pieces_[w].is_whole) continue;
    std::size_t kept = 0, place = 0;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      // Those before i have moved up, perhaps the whole one among them.
      const PieceOfSurface& whole = pieces_[i <= w ? w : place];
      if (i != w && is_in_front(whole, pieces_[i])) continue;
      if (i == w) place = kept;
      if (i != kept) pieces_[kept] = std::move(pieces_[i]);
      ++kept;
    }
    pieces_.erase(pieces_.begin() + static_cast<std::ptrdiff_t>(kept), pieces_.end());
    w = place;
  }
}

std::array<CellVisibility, 2> CellVisibility::halves() const {
  const std::array<ImageCell::Half, 2> parts = cell_->halves(part_);
  const auto half = [&](const ImageCell::Half& its) {
    CellVisibility result(*cell_, its.part);
    for (const PieceOfSurface& piece : pieces_) {
      auto polygon = in_half(piece.polygon, its, result.counts_);
      if (!polygon) continue;
      const bool is_whole = its.part.is_all(*polygon);
      result.pieces_.push_back(
          {piece.surface, std::move(*polygon), is_whole, result.depths_of(*piece.surface)});
    }
    result.drop_hidden();
    return result;
  };
  return {half(parts[0]), half(parts[1])};
}

std::optional<ConvexPolygon> CellVisibility::hidden_part(const ConvexPolygon& polygon,
                                                         std::size_t t, std::size_t s) {
  const PieceOfSurface &behind = pieces_[t], &before = pieces_[s];
  if (!polygon.bounds().may_meet(before.polygon.bounds())) return std::nullopt;
  const Order order = quick_order(before.depths, behind.depths);
  if (order == Order::behind) return std::nullopt;
  ConvexPolygon part = polygon;
  for (const HalfPlane* edge : before.polygon.edges()) {
    if (part_.is_side(edge)) continue;
    if (!part.clip(*edge, counts_)) return std::nullopt;
  }
  if (order == Order::in_front) return part;
  const ImageForm form = area::in_front(*before.surface, *behind.surface);
  if (form.is_zero()) {
    if (before.surface->number < behind.surface->number) return part;
    return std::nullopt;
  }
  return cell_->clip(part, form, part_, counts_);
}

Boundary CellVisibility::visible(std::size_t piece,
                                 const std::function<bool(const SurfaceRegion&)>& counts) {
  const ConvexPolygon& polygon = pieces_[piece].polygon;
  std::vector<ConvexPolygon> hidden;
  for (std::size_t s = 0; s < pieces_.size(); ++s) {
    if (s == piece || (counts && !counts(*pieces_[s].surface))) continue;
    auto part = hidden_part(polygon, piece, s);
    if (!part) continue;
    if (part->edges() == polygon.edges()) return {};
    hidden.push_back(std::move(*part));
  }
  return boundary_of_difference(polygon, hidden, counts_);
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
