#include "fathom/area/surface_pairs.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include "fathom/area/coverage_image.h"
#include "fathom/threads/interruption.h"
#include "fathom/threads/threads.h"

namespace fathom::area {
using namespace triangle;

namespace {

bool meet(const PixelBox& a, const PixelBox& b) {
  return a.first_column <= b.last_column && b.first_column <= a.last_column &&
         a.first_row <= b.last_row && b.first_row <= a.last_row;
}

}  // namespace

SurfaceParts::~SurfaceParts() {
  // Work that has been interrupted leaves no sooner than its memory is free.
  const Interruptible never(nullptr);
  try {
    in_parallel(parts_.size(), [&](std::size_t part) { Part().swap(parts_[part]); });
  } catch (...) {
    // No memory for threads: the members free the rest.
  }
}

SceneSurfaces::SceneSurfaces(const CoverageFrame& frame, Progress& progress)
    : columns_((frame.camera.width - 1) / side_of_tile + 1),
      boxes_(frame.triangles.count()),
      surfaces_(frame.triangles.count()),
      tiles_(std::size_t{columns_} * ((frame.camera.height - 1) / side_of_tile + 1)),
      first_(count()),
      first_of_object_(count()) {
  parallel_for(std::uint32_t{0}, surfaces_.size(), [&](std::uint32_t part) {
    surfaces_.make(part, [&](std::uint32_t number) {
      if ((number + 1) % triangles_per_report == 0) progress.part_done();
      return surface_of(frame, number);
    });
  });
  find_equal_triangles(frame.triangles);
  for (std::uint32_t number = 0; number < count(); ++number) {
    check_interruption();
    if (surfaces_[number] == nullptr) continue;
    const PixelBox& box = boxes_[number];
    for (std::uint32_t y = box.first_row / side_of_tile; y <= box.last_row / side_of_tile; ++y) {
      for (std::uint32_t x = box.first_column / side_of_tile; x <= box.last_column / side_of_tile;
           ++x) {
        tiles_[std::size_t{y} * columns_ + x].push_back(number);
      }
    }
  }
}

std::optional<SurfaceRegion> SceneSurfaces::surface_of(const CoverageFrame& frame,
                                                       std::uint32_t number) {
  TierCounts counts;
  const ProjectedTriangle t =
      project(frame.triangles.world_corners(number), number, frame.camera, counts);
  if (t.orientation == Sign::zero || !is_kept(t, frame.cull)) return std::nullopt;
  boxes_[number] = bounding_box(t, frame.camera);
  if (boxes_[number].is_empty()) return std::nullopt;
  return surface_region(t, frame.camera);
}

void SceneSurfaces::find_equal_triangles(const TriangleSource& triangles) {
  EqualTriangles in_scene(triangles);
  std::optional<EqualTriangles> in_object;
  std::optional<std::uint32_t> object;
  for (std::uint32_t number = 0; number < count(); ++number) {
    check_interruption();
    if (surfaces_[number] == nullptr) continue;
    if (const std::uint32_t its = triangles.origin(number).object; its != object) {
      in_object.emplace(triangles);
      object = its;
    }
    first_[number] = in_scene.is_first(number);
    first_of_object_[number] = in_object->is_first(number);
  }
}

// Boxes that meet have a first tile in common, in which the other one is taken.
template <class Take>
void SceneSurfaces::for_each_near(std::uint32_t number, const Take& take) const {
  const PixelBox& box = boxes_[number];
  for (std::uint32_t y = box.first_row / side_of_tile; y <= box.last_row / side_of_tile; ++y) {
    for (std::uint32_t x = box.first_column / side_of_tile; x <= box.last_column / side_of_tile;
         ++x) {
      for (const std::uint32_t other : tiles_[std::size_t{y} * columns_ + x]) {
        const PixelBox& its = boxes_[other];
        if (other == number || !meet(box, its)) continue;
        const bool is_first = std::max(box.first_column, its.first_column) / side_of_tile == x &&
                              std::max(box.first_row, its.first_row) / side_of_tile == y;
        if (is_first) take(other);
      }
    }
  }
}

std::vector<std::uint32_t> SceneSurfaces::near(std::uint32_t number) const {
  std::vector<std::uint32_t> found;
  for_each_near(number, [&](std::uint32_t other) { found.push_back(other); });
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::uint32_t> SceneSurfaces::in_front(std::uint32_t number) const {
  const double farthest = surfaces_[number]->depths.upper;
  std::vector<std::uint32_t> found;
  for_each_near(number, [&](std::uint32_t other) {
    if (surfaces_[other]->depths.lower <= farthest) found.push_back(other);
  });
  std::sort(found.begin(), found.end(), [&](std::uint32_t a, std::uint32_t b) {
    return is_nearer(*surfaces_[a], *surfaces_[b]);
  });
  return found;
}

namespace {

/// The point where two lines cross, homogeneous, with a positive weight.
ExactVector3 crossing(const HalfPlane& a, const HalfPlane& b) {
  ExactVector3 point = cross(a.exact(), b.exact());
  if (point[2].sign() == Sign::negative) {
    for (Dyadic& component : point) component = -component;
  }
  return point;
}

/// Non-negative binary64 numbers, in their order, from integers.
double from_place(std::uint64_t place) {
  return std::bit_cast<double>(place);
}

}  // namespace

struct Separation::Ends {
  // n and w of the triangle in front (t) and of the triangle behind (s), at the first and last
  // point.
  std::array<Dyadic, 2> n_t, w_t, n_s, w_s;
};

Separation::Separation(const ImageCell& cell, const SurfaceRegion& front,
                       const SurfaceRegion& behind)
    : front_numerator_{cell.localised(front.depth_numerator)},
      front_weight_{cell.localised(front.weight)},
      behind_numerator_{cell.localised(behind.depth_numerator)},
      behind_weight_{cell.localised(behind.weight)},
      is_zero_(is_constantly(0.0)) {}

Separation::Ends Separation::ends_of(const BoundarySegment& segment) const {
  Ends ends;
  const HalfPlane* lines[] = {segment.from, segment.to};
  for (std::size_t k = 0; k < 2; ++k) {
    const ExactVector3 point = crossing(*segment.line, *lines[k]);
    ends.n_t[k] = front_numerator_.at(point);
    ends.w_t[k] = front_weight_.at(point);
    ends.n_s[k] = behind_numerator_.at(point);
    ends.w_s[k] = behind_weight_.at(point);
  }
  return ends;
}

// D_s − D_t < δ ⇔ G = n_s·w_t − n_t·w_s − δ·w_s·w_t < 0, as the weights are positive. On the way
// from the first to the last point G is, up to a positive factor, the quadratic polynomial
// (1 − τ)²·G₀ + 2·τ·(1 − τ)·M + τ²·G₁ with the polar form M. If G₀ and G₁ are not negative, its
// least value over 0 < τ < 1 is negative exactly if M < 0 and M² > G₀·G₁; it is at most 0, with
// both ends positive, exactly if M < 0 and M² ≥ G₀·G₁.
bool Separation::reaches(const Ends& e, const Dyadic& limit, bool closed) {
  const auto polar = [&](std::size_t i, std::size_t k) {
    const Dyadic twice = e.n_s[i] * e.w_t[k] + e.n_s[k] * e.w_t[i] - e.n_t[i] * e.w_s[k] -
                         e.n_t[k] * e.w_s[i] - limit * (e.w_s[i] * e.w_t[k] + e.w_s[k] * e.w_t[i]);
    return twice.scaled(-1);
  };
  const Dyadic first = polar(0, 0), last = polar(1, 1);
  for (const Dyadic* end : {&first, &last}) {
    if (end->sign() == Sign::negative || (closed && end->is_zero())) return true;
  }
  const Dyadic middle = polar(0, 1);
  if (middle.sign() != Sign::negative) return false;
  const int order = compare(middle * middle, first * last);
  return closed ? order >= 0 : order > 0;
}

bool Separation::is_below(const Boundary& boundary, const Dyadic& limit) const {
  if (is_zero_) return !boundary.empty() && limit.sign() == Sign::positive;
  for (const BoundarySegment& segment : boundary) {
    if (reaches(ends_of(segment), limit, false)) return true;
  }
  return false;
}

bool Separation::is_at_most(const Boundary& boundary, const Dyadic& limit) const {
  if (is_zero_) return !boundary.empty() && limit.sign() != Sign::negative;
  for (const BoundarySegment& segment : boundary) {
    if (reaches(ends_of(segment), limit, true)) return true;
  }
  return false;
}

// The quadratic form G vanishes if all its six coefficients do.
bool Separation::is_constantly(const Dyadic& limit) const {
  const auto& n_t = front_numerator_.exact;
  const auto& w_t = front_weight_.exact;
  const auto& n_s = behind_numerator_.exact;
  const auto& w_s = behind_weight_.exact;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = i; k < 3; ++k) {
      const Dyadic coefficient = n_s[i] * w_t[k] + n_s[k] * w_t[i] - n_t[i] * w_s[k] -
                                 n_t[k] * w_s[i] - limit * (w_s[i] * w_t[k] + w_s[k] * w_t[i]);
      if (!coefficient.is_zero()) return false;
    }
  }
  return true;
}

// The greatest binary64 number below which the separation never falls, by bisection over the order
// of the numbers; then the next number above it, if the least value lies beyond the middle.
double Separation::least(const Boundary& boundary) const {
  if (is_zero_) return 0;
  std::uint64_t low = 0;  // not above the least value
  std::uint64_t high = std::bit_cast<std::uint64_t>(std::numeric_limits<double>::infinity());
  while (high - low > 1) {
    const std::uint64_t place = low + (high - low) / 2;
    (is_below(boundary, from_place(place)) ? high : low) = place;
  }
  const Dyadic floor(from_place(low));
  if (high == std::bit_cast<std::uint64_t>(std::numeric_limits<double>::infinity())) {
    return from_place(low);
  }
  const Dyadic middle = (floor + Dyadic(from_place(high))).scaled(-1);
  if (is_below(boundary, middle)) return from_place(low);
  const bool tie = is_at_most(boundary, middle);
  return from_place(tie && low % 2 == 0 ? low : high);
}

}  // namespace fathom::area
