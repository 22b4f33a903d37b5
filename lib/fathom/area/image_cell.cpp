#include "fathom/area/image_cell.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fathom/threads/interruption.h"

namespace fathom::area {
using namespace triangle;

namespace {

/// n − limit·w
LinearForm above(const LinearForm& n, const Dyadic& limit, const LinearForm& w) {
  ExactVector3 l;
  for (std::size_t k = 0; k < 3; ++k) l[k] = n.coefficients()[k] - limit * w.coefficients()[k];
  return LinearForm(l);
}

bool is_constant(const LinearForm& form) {
  return form.coefficients()[0].is_zero() && form.coefficients()[1].is_zero();
}

}  // namespace

std::optional<std::vector<LinearForm>> covered_region(const ProjectedTriangle& t,
                                                      const Camera& camera) {
  if (t.orientation == Sign::zero) return std::nullopt;
  std::vector<LinearForm> region(t.edges.begin(), t.edges.end());
  // D > 0: if D is 0 everywhere, nothing is left.
  const LinearForm& depth = t.depth_numerator;
  if (!is_constant(depth)) {
    region.push_back(depth);
  } else if (depth.coefficients()[2].sign() != Sign::positive) {
    return std::nullopt;
  }
  const auto add = [&](LinearForm form) {
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
  SurfaceRegion surface{t.number, std::move(*region), t.depth_numerator, t.weight, {}, {}};
  constexpr double infinity = std::numeric_limits<double>::infinity();
  surface.depths = {infinity, -infinity};
  for (std::size_t i = 0; i < 3; ++i) {
    const Interval depth = enclose(t.camera[i].z);
    surface.depths.lower = std::min(surface.depths.lower, depth.lower);
    surface.depths.upper = std::max(surface.depths.upper, depth.upper);
    auto [U, V, W] = to_image(camera.projection, t.camera[i]);
    const std::array<Interval, 3> enclosure{enclose(U), enclose(V), enclose(W)};
    surface.corners[i] = {{std::move(U), std::move(V), std::move(W)}, enclosure};
  }
  return surface;
}

ImageCell::ImageCell(std::uint32_t column, std::uint32_t row, std::uint32_t width,
                     std::uint32_t height)
    : ImageCell(CellRectangle{static_cast<double>(column), static_cast<double>(row),
                              static_cast<double>(column) + width,
                              static_cast<double>(row) + height}) {}

ImageCell::ImageCell(const CellRectangle& rectangle) {
  const auto& [left, top, right, bottom] = rectangle;
  // u ≥ 0, v ≥ 0, u ≤ width, v ≤ height: each turns left from the one before.
  const std::array<ExactVector3, 4> sides{{{1.0, 0.0, 0.0},
                                           {0.0, 1.0, 0.0},
                                           {-1.0, 0.0, Dyadic(right) - Dyadic(left)},
                                           {0.0, -1.0, Dyadic(bottom) - Dyadic(top)}}};
  std::vector<const HalfPlane*> edges;
  edges.reserve(sides.size());
  for (const ExactVector3& side : sides) edges.push_back(&half_planes_.emplace_back(side));
  all_.emplace(CellPart{ConvexPolygon(std::move(edges)), left, top, right, bottom});
}

std::optional<Sign> CellPart::sign_of(const LinearForm& form) const {
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

const HalfPlane& ImageCell::keep(HalfPlane line) {
  const HalfPlane& kept = half_planes_.emplace_back(std::move(line));
  return merges_ ? merged_lines_.of(kept) : kept;
}

const HalfPlane& ImageCell::opposite(const HalfPlane& line) {
  const ExactVector3& l = line.exact();
  return half_planes_.emplace_back(ExactVector3{-l[0], -l[1], -l[2]});
}

std::vector<ImageCell::Half> ImageCell::halves(const CellPart& part) {
  const bool across = part.right - part.left >= part.bottom - part.top;
  const double from = across ? part.left : part.top, to = across ? part.right : part.bottom;
  const double middle = from + (to - from) / 2;
  // In the cell's coordinates.
  const double origin = across ? all_->left : all_->top;
  const double cut = middle - origin;
  // Where that is; the middle, unless the difference was rounded.
  const Interval place = enclose(Dyadic(cut) + Dyadic(origin));
  std::vector<Half> result;
  for (const double sign : {1.0, -1.0}) {
    Half half{part, &keep(HalfPlane(across ? ExactVector3{-sign, 0.0, sign * cut}
                                           : ExactVector3{0.0, -sign, sign * cut}))};
    TierCounts counts;
    if (!half.part.outline.clip(*half.side, counts)) continue;
    if (across) {
      (sign > 0 ? half.part.right : half.part.left) = sign > 0 ? place.upper : place.lower;
    } else {
      (sign > 0 ? half.part.bottom : half.part.top) = sign > 0 ? place.upper : place.lower;
    }
    result.push_back(std::move(half));
  }
  return result;
}

std::vector<ImageCell::Half> ImageCell::halves_along(const CellPart& part, const HalfPlane& line) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  // Not where a bound is NaN.
  const auto narrow = [](double& low, double& high, const Interval& range, double origin) {
    const double least = std::nextafter(origin + range.lower, -infinity);
    const double greatest = std::nextafter(origin + range.upper, infinity);
    if (least > low) low = least;
    if (greatest < high) high = greatest;
  };
  std::vector<Half> result;
  for (const HalfPlane* side : {&merged_lines_.of(line), &merged_lines_.opposite(line)}) {
    Half half{part, side};
    TierCounts counts;
    if (!half.part.outline.clip(*side, counts)) continue;
    const BoundingRectangle& bounds = half.part.outline.bounds();
    narrow(half.part.left, half.part.right, bounds.u, all_->left);
    narrow(half.part.top, half.part.bottom, bounds.v, all_->top);
    result.push_back(std::move(half));
  }
  return result;
}

ExactVector3 ImageCell::localised(const LinearForm& form) const {
  const auto& l = form.coefficients();
  return {l[0], l[1], form.at(all_->left, all_->top)};
}

std::optional<ImageCell::Piece> ImageCell::clip(const std::vector<LinearForm>& region,
                                                TierCounts& counts) {
  std::array<const LinearForm*, 6> undecided{};
  std::size_t count = 0;
  for (const LinearForm& form : region) {
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

std::optional<ConvexPolygon> ImageCell::clip(const ConvexPolygon& polygon, const LinearForm& form,
                                             const CellPart& part, TierCounts& counts) {
  const std::optional<Sign> sign = part.sign_of(form);
  if (sign == Sign::negative) return std::nullopt;
  ConvexPolygon result = polygon;
  if (sign) return result;
  if (!result.clip(half_planes_.emplace_back(localised(form)), counts)) return std::nullopt;
  return result;
}

namespace {

bool are_same(const Interval& a, const Interval& b) {
  return a.lower == b.lower && a.upper == b.upper;
}

/// For neighbours in a mesh; enclosures nearly always differ if the points do.
bool are_same(const SurfaceCorner& a, const SurfaceCorner& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (!are_same(a.enclosure[k], b.enclosure[k])) return false;
  }
  return a.point == b.point;
}

/// Whether no corner of s is inside an edge of t. Edge k is opposite corner k.
bool lies_outside(const SurfaceRegion& s, const SurfaceRegion& t, std::size_t k) {
  const LinearForm& edge = t.region[k];
  return std::all_of(s.corners.begin(), s.corners.end(), [&](const SurfaceCorner& corner) {
    const Interval value = edge.enclose_at(corner.enclosure);
    if (value.upper <= 0) return true;
    if (value.lower > 0) return false;
    if (are_same(corner, t.corners[(k + 1) % 3]) || are_same(corner, t.corners[(k + 2) % 3])) {
      return true;
    }
    return dot(edge.coefficients(), corner.point).sign() != Sign::positive;
  });
}

}  // namespace

bool are_disjoint(const SurfaceRegion& s, const SurfaceRegion& t) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (lies_outside(s, t, k) || lies_outside(t, s, k)) return true;
  }
  return false;
}

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

  [[nodiscard]] std::vector<DividedPolygons> halves() const {
    return divided(cell_->halves(part_));
  }

  /// Along an edge of the largest polygon.
  std::vector<DividedPolygons> halves_along_edge() {
    merge_lines();
    const HalfPlane* edge = nullptr;
    double greatest = -1;
    for (const ConvexPolygon& polygon : polygons_) {
      const double size = size_of(polygon.bounds());
      if (!(size > greatest)) continue;
      const HalfPlane* its = part_.first_inside(polygon);
      if (!its) continue;
      edge = its;
      greatest = size;
    }
    if (!edge) return {};
    return divided(cell_->halves_along(part_, *edge));
  }

 private:
  /// Of the box around a polygon.
  static double size_of(const BoundingRectangle& bounds) {
    const double size = (bounds.u.upper - bounds.u.lower) * (bounds.v.upper - bounds.v.lower);
    return size >= 0 ? size : 0;
  }

  void merge_lines() {
    MergedLines& lines = cell_->merged_lines();
    part_.outline = lines.of(part_.outline);
    for (ConvexPolygon& polygon : polygons_) polygon = lines.of(polygon);
  }

  [[nodiscard]] std::vector<DividedPolygons> divided(
      const std::vector<ImageCell::Half>& halves) const {
    std::vector<DividedPolygons> result;
    for (const ImageCell::Half& half : halves) {
      DividedPolygons& inside = result.emplace_back(*cell_, half.part, *counts_);
      for (const ConvexPolygon& polygon : polygons_) {
        check_interruption();
        if (inside.complete_) break;
        if (auto piece = in_half(polygon, half, *counts_)) inside.add(std::move(*piece));
      }
    }
    return result;
  }

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
