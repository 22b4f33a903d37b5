#include "fathom/exact/fast_referee.h"

#include <algorithm>
#include <limits>

namespace fathom {
namespace {

/// About 5 kB each.
constexpr std::size_t most_remembered = 2048;

/// Whether D of both is the same function on the image: n_a·w_b = n_b·w_a as polynomials. Of n and
/// w one is constant, the same for both (|Δ|: w under an orthographic, n under a perspective
/// camera), so three products of coefficients are compared.
bool in_one_plane(const ProjectedTriangle& a, const ProjectedTriangle& b, bool perspective) {
  const auto varying = [&](const ProjectedTriangle& t) -> const ExactVector3& {
    return (perspective ? t.weight : t.depth_numerator).coefficients();
  };
  const auto constant = [&](const ProjectedTriangle& t) -> const Dyadic& {
    return (perspective ? t.depth_numerator : t.weight).coefficients()[2];
  };
  for (std::size_t k = 0; k < 3; ++k) {
    if (compare(varying(a)[k] * constant(b), varying(b)[k] * constant(a)) != 0) return false;
  }
  return true;
}

}  // namespace

void Referee::make_room() {
  if (remembered_.size() + 2 > most_remembered) remembered_.clear();
}

const ProjectedTriangle& Referee::remember(std::uint32_t number) {
  auto& slot = remembered_[number];
  if (!slot) {
    TierCounts counted_before;  // facing is counted when triangles are binned
    slot = std::make_unique<ProjectedTriangle>(
        project(triangles_.world_corners(number), number, camera_, counted_before));
  }
  return *slot;
}

const ProjectedTriangle& Referee::projected(std::uint32_t number) {
  make_room();
  return remember(number);
}

bool Referee::covers(std::uint32_t number, const ImagePoint& s, TierCounts& counts) {
  return fathom::covers(projected(number), s, counts);
}

bool Referee::is_in_range(std::uint32_t number, const ImagePoint& s) {
  const Ratio depth = depth_at(projected(number), s);
  if (depth.sign() != Sign::positive) return false;
  if (compare(depth, Ratio(Dyadic(camera_.near))) < 0) return false;
  return camera_.far == std::numeric_limits<double>::infinity() ||
         compare(depth, Ratio(Dyadic(camera_.far))) <= 0;
}

bool Referee::hides(std::uint32_t a, std::uint32_t b, const ImagePoint& s,
                    RenderStatistics& statistics) {
  ++statistics.visibility.exact;
  make_room();
  const ProjectedTriangle& ta = remember(a);
  const ProjectedTriangle& tb = remember(b);
  if (first_ != std::min(a, b) || second_ != std::max(a, b)) {
    first_ = std::min(a, b);
    second_ = std::max(a, b);
    same_plane_ = in_one_plane(ta, tb, camera_.projection == Projection::perspective);
  }
  if (same_plane_) {
    ++statistics.same_plane;
    return a < b;
  }
  const int order = compare(depth_at(ta, s), depth_at(tb, s));
  return order < 0 || (order == 0 && a < b);
}

}  // namespace fathom
