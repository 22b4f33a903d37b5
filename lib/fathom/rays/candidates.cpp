#include "fathom/rays/candidates.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fathom/numeric/interval.h"
#include "fathom/numeric/rounding.h"
#include "fathom/rays/ray_bounds.h"

namespace fathom::rays {
namespace {

Interval enclose(const Ratio& t) {
  const double nearest = round_to_binary64(t);
  return {std::nextafter(nearest, -infinity), std::nextafter(nearest, infinity)};
}

}  // namespace

void Candidates::begin(const Ray& given, const WalkRay& ray) {
  given_ = &given;
  ray_ = &ray;
  exact_ray_.reset();
  hits_.clear();
  // clear() would zero all buckets that an earlier ray needed.
  if (!exact_ts_.empty()) exact_ts_ = {};
  least_upper_ = infinity;
  set_last(ray.last);
}

const ExactRay& Candidates::exact_ray() {
  if (!exact_ray_) exact_ray_.emplace(*given_);
  return *exact_ray_;
}

std::optional<Candidates::Hit> Candidates::settle(const TestedTriangle& triangle) {
  std::optional<ExactHit> hit = meet(exact_ray(), source_.world_corners(triangle.number));
  if (!hit || !is_kept(hit->side, options_.cull) || !counts(hit->t, options_.segment))
    return std::nullopt;
  const Interval s = s_of(*ray_, enclose(hit->t));
  exact_ts_.insert_or_assign(triangle.number, std::move(hit->t));
  return Hit{triangle.number, triangle.number, triangle.place, hit->side, s};
}

bool Candidates::offer(const TestedTriangle& triangle) {
  const Interval s = triangle.s();
  if (s.upper < ray_->segment_first.lower || s.lower > ray_->segment_last.upper) return false;
  if (question_ == Question::nearest && s.lower > least_upper_) return false;
  std::optional<Hit> hit;
  if (triangle.is_met && s.lower > ray_->segment_first.upper &&
      s.upper < ray_->segment_last.lower) {
    const Sign side = triangle.w < 0 ? Sign::negative : Sign::positive;
    if (is_kept(side, options_.cull))
      hit = {triangle.number, triangle.number, triangle.place, side, s};
  } else {
    hit = settle(triangle);
  }
  if (!hit) return false;
  hits_.push_back(*hit);
  if (question_ == Question::all) {
    for (const Repetition& repetition : tree_.repetitions(triangle.number)) {
      hits_.push_back(*hit);
      hits_.back().triangle = repetition.number;
    }
  }
  if (question_ == Question::nearest && hit->s.upper < least_upper_) {
    least_upper_ = hit->s.upper;
    set_last(std::min(last(), round_up(least_upper_) * (1 + bounds::far_room)));
  }
  return question_ == Question::any;
}

const Ratio& Candidates::exact_t(const Hit& hit) {
  const auto known = exact_ts_.find(hit.first);
  if (known != exact_ts_.end()) return known->second;
  Ratio t = require_hit(exact_ray(), source_.world_corners(hit.first)).t;
  return exact_ts_.emplace(hit.first, std::move(t)).first->second;
}

/// Where the intervals do not decide, exact numbers do.
bool Candidates::is_before(const Hit& a, const Hit& b) {
  if (a.s.upper < b.s.lower) return true;
  if (b.s.upper < a.s.lower) return false;
  const int order = a.first == b.first ? 0 : compare(exact_t(a), exact_t(b));
  return order < 0 || (order == 0 && a.triangle < b.triangle);
}

std::optional<Candidates::Hit> Candidates::nearest() {
  const Hit* best = nullptr;
  for (const Hit& hit : hits_)
    if (hit.s.lower <= least_upper_ && (!best || is_before(hit, *best))) best = &hit;
  return best ? std::optional(*best) : std::nullopt;
}

void Candidates::sort() {
  std::ranges::sort(hits_, [&](const Hit& a, const Hit& b) { return is_before(a, b); });
}

}  // namespace fathom::rays
