#include "fathom/area/image_cell.h"

#include <array>
#include <cmath>
#include <limits>

#include "fathom/area/cell_division.h"
#include "fathom/numeric/rounding.h"

namespace fathom::area {
using namespace triangle;

namespace {

/// n − limit·w
ImageForm above(const ImageForm& n, const Dyadic& limit, const ImageForm& w) {
  ExactVector3 l;
  for (std::size_t k = 0; k < 3; ++k) l[k] = n.coefficients()[k] - limit * w.coefficients()[k];
  return ImageForm(l);
}

bool is_constant(const ImageForm& form) {
  return form.coefficients()[0].is_zero() && form.coefficients()[1].is_zero();
}

}  // namespace

std::optional<std::vector<ImageForm>> covered_region(const ProjectedTriangle& t,
                                                     const Camera& camera) {
  if (t.orientation == Sign::zero) return std::nullopt;
  std::vector<ImageForm> region(t.edges.begin(), t.edges.end());
  // D > 0: if D is 0 everywhere, nothing is left.
  const ImageForm& depth = t.depth_numerator;
  if (!is_constant(depth)) {
    region.push_back(depth);
  } else if (depth.coefficients()[2].sign() != Sign::positive) {
    return std::nullopt;
  }
  const auto add = [&](ImageForm form) {
    if (is_constant(form)) return form.coefficients()[2].sign() != Sign::negative;
    region.push_back(std::move(form));
    return true;
  };
  if (camera.near > 0 && !add(above(depth, camera.near, t.weight))) return std::nullopt;
  if (std::isfinite(camera.far) && !add(-above(depth, camera.far, t.weight))) {
    return std::nullopt;
  }
  return region;
}

std::optional<SurfaceRegion> surface_region(const ProjectedTriangle& t, const Camera& camera) {
  auto region = covered_region(t, camera);
  if (!region) return std::nullopt;
  SurfaceRegion surface{t.number, std::move(*region), t.depth_numerator, t.weight, {}};
  for (std::size_t i = 0; i < 3; ++i) {
    auto [U, V, W] = to_image(camera, t.camera[i]);
    const std::array<Interval, 3> enclosure{enclose(U), enclose(V), enclose(W)};
    surface.corners[i] = {{std::move(U), std::move(V), std::move(W)}, enclosure};
  }
  return surface;
}

ImageCell::ImageCell(std::uint32_t column, std::uint32_t row, std::uint32_t width,
                     std::uint32_t height) {
  // u ≥ 0, v ≥ 0, u ≤ width, v ≤ height: each turns left from the one before.
  const std::array<ExactVector3, 4> sides{{{1.0, 0.0, 0.0},
                                           {0.0, 1.0, 0.0},
                                           {-1.0, 0.0, static_cast<double>(width)},
                                           {0.0, -1.0, static_cast<double>(height)}}};
  std::vector<const HalfPlane*> edges;
  edges.reserve(sides.size());
  for (const ExactVector3& side : sides) edges.push_back(&half_planes_.emplace_back(side));
  const double left = column, top = row;
  all_.emplace(CellPart{ConvexPolygon(std::move(edges)), left, top, left + width, top + height});
}

std::optional<Sign> CellPart::sign_of(const ImageForm& form) const {
  // The form is affine: the signs at the corners decide.
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto [u, v] = corner(k);
    const Interval value = form.enclose_at(u, v);
    if (!(value.lower <= value.upper)) return std::nullopt;
    least = std::min(least, value.lower);
    greatest = std::max(greatest, value.upper);
  }
  if (least >= 0) return Sign::positive;
  if (greatest <= 0) return Sign::negative;
  return std::nullopt;
}

std::array<ImageCell::Half, 2> ImageCell::halves(const CellPart& part) {
  const bool across = part.right - part.left >= part.bottom - part.top;
  const double from = across ? part.left : part.top, to = across ? part.right : part.bottom;
  const double middle = from + (to - from) / 2;
  // In the cell's coordinates.
  const double cut = middle - (across ? all_->left : all_->top);
  const auto half = [&](double sign) {
    const HalfPlane& side = half_planes_.emplace_back(
        across ? ExactVector3{-sign, 0.0, sign * cut} : ExactVector3{0.0, -sign, sign * cut});
    CellPart result = part;
    TierCounts counts;
    (void)result.outline.clip(side, counts);
    if (across) {
      (sign > 0 ? result.right : result.left) = middle;
    } else {
      (sign > 0 ? result.bottom : result.top) = middle;
    }
    return Half{std::move(result), &side};
  };
  return {half(1), half(-1)};
}

ExactVector3 ImageCell::localised(const ImageForm& form) const {
  const auto& l = form.coefficients();
  return {l[0], l[1], form.at(all_->left, all_->top)};
}

std::optional<ImageCell::Piece> ImageCell::clip(const std::vector<ImageForm>& region,
                                                TierCounts& counts) {
  std::array<const ImageForm*, 6> undecided{};
  std::size_t count = 0;
  for (const ImageForm& form : region) {
    const std::optional<Sign> sign = sign_in_cell(form);
    if (sign == Sign::negative) return std::nullopt;
    if (!sign) undecided.at(count++) = &form;
  }
  Piece piece{whole()};
  for (std::size_t k = 0; k < count; ++k) {
    if (!piece.polygon.clip(half_planes_.emplace_back(localised(*undecided[k])), counts)) {
      return std::nullopt;
    }
  }
  piece.is_whole = piece.polygon.edges() == whole().edges();
  return piece;
}

std::optional<ConvexPolygon> ImageCell::clip(const ConvexPolygon& polygon, const ImageForm& form,
                                             const CellPart& part, TierCounts& counts) {
  const std::optional<Sign> sign = part.sign_of(form);
  if (sign == Sign::negative) return std::nullopt;
  ConvexPolygon result = polygon;
  if (sign) return result;
  if (!result.clip(half_planes_.emplace_back(localised(form)), counts)) return std::nullopt;
  return result;
}

void CellCoverage::add(const std::vector<ImageForm>& region) {
  if (complete_) return;
  auto piece = cell_.clip(region, counts_);
  if (!piece) return;
  if (piece->is_whole) {
    complete_ = true;
    pieces_.clear();
  }
  pieces_.push_back(std::move(piece->polygon));
}

Boundary CellCoverage::boundary() {
  Boundary boundary;
  for_each_simple_part(cell_, pieces_, counts_, [&](std::span<const ConvexPolygon> pieces) {
    const Boundary more = boundary_of_union(pieces, counts_);
    boundary.insert(boundary.end(), more.begin(), more.end());
  });
  return boundary;
}

Ratio CellCoverage::area() {
  return exact_area(boundary());
}

float CellCoverage::rounded_area() {
  const Boundary found = boundary();
  if (const auto settled = settled_binary32(approximate_area(found))) return *settled;
  return round_to_binary32(exact_area(found));
}

}  // namespace fathom::area
