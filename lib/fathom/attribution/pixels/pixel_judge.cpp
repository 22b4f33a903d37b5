#include "fathom/attribution/pixels/pixel_judge.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

// How to read this file: start with judge() at the end. verdict_of() combines the fragments of a
// sample, explaining() computes the allowed values, classify() the class of the stored value.
namespace fathom::attribution {
namespace {

/// An edge that the model leaves open, directed so that its triangle lies on its left.
struct OpenEdge {
  std::uint32_t from = 0, to = 0;
  std::size_t fragment = 0;
  std::size_t partner = 0;  ///< the fragment on its other side, or itself
};

std::vector<OpenEdge> open_edges(std::span<const Fragment> fragments,
                                 std::span<const CornerIndices> triangles,
                                 const std::vector<std::uint32_t>& numbers) {
  std::vector<OpenEdge> edges;
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    const Fragment& f = fragments[i];
    if (f.coverage != Coverage::may || f.open_edges == joins_no_other) continue;
    const CornerIndices& t = triangles[f.triangle];
    for (std::size_t k = 0; k < 3; ++k) {
      if ((f.open_edges >> k & 1U) == 0) continue;
      OpenEdge edge{numbers[t[(k + 1) % 3]], numbers[t[(k + 2) % 3]], i, i};
      if (f.turned) std::swap(edge.from, edge.to);
      edges.push_back(edge);
    }
  }
  return edges;
}

/// Pairs edges of opposite direction; edges that three triangles share stay unpaired.
void pair(std::vector<OpenEdge>& edges) {
  for (OpenEdge& edge : edges) {
    std::size_t opposite = 0, same = 0;
    for (const OpenEdge& other : edges) {
      if (edge.from == other.to && edge.to == other.from) {
        ++opposite;
        edge.partner = other.fragment;
      } else if (edge.from == other.from && edge.to == other.to) {
        ++same;
      }
    }
    if (opposite != 1 || same != 1) edge.partner = edge.fragment;
  }
}

class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t of(std::size_t i) const {
    while (parent_[i] != i) i = parent_[i];
    return i;
  }
  void join(std::size_t i, std::size_t j) { parent_[of(i)] = of(j); }

 private:
  std::vector<std::size_t> parent_;
};

/// The minimum, over groups that certainly cover the sample, of the group's greatest value. Such a
/// group is closed, has no unpaired open edge, and covers the sample with its exact corners.
double joint_cap(std::span<const Fragment> fragments, std::vector<OpenEdge> edges) {
  pair(edges);
  Groups groups(fragments.size());
  for (const OpenEdge& edge : edges) groups.join(edge.fragment, edge.partner);
  std::vector<bool> closed(fragments.size(), true), covered(fragments.size(), false);
  std::vector<double> greatest(fragments.size(), -std::numeric_limits<double>::infinity());
  for (const OpenEdge& edge : edges) {
    const std::size_t group = groups.of(edge.fragment);
    if (edge.partner == edge.fragment) closed[group] = false;
    const Fragment& f = fragments[edge.fragment];
    if (f.inside) covered[group] = true;
    greatest[group] = std::max(greatest[group], f.value.upper);
  }
  double cap = std::numeric_limits<double>::infinity();
  for (const OpenEdge& edge : edges) {
    const std::size_t group = groups.of(edge.fragment);
    if (closed[group] && covered[group]) cap = std::min(cap, greatest[group]);
  }
  return cap;
}

}  // namespace

PixelVerdict verdict_of(std::span<const Fragment> fragments, bool watertight,
                        std::span<const CornerIndices> triangles,
                        const std::vector<std::uint32_t>& numbers) {
  PixelVerdict verdict;
  bool some_may = false;
  for (const Fragment& f : fragments) {
    if (f.coverage == Coverage::may) some_may = true;
    if (f.coverage != Coverage::must) continue;
    verdict.must = verdict.must_if_watertight = true;
    verdict.cap = std::min(verdict.cap, f.value.upper);
  }
  if (!some_may) return verdict;
  const double together = joint_cap(fragments, open_edges(fragments, triangles, numbers));
  if (together == std::numeric_limits<double>::infinity()) return verdict;
  verdict.must_if_watertight = true;
  if (watertight) {
    verdict.must = true;
    verdict.cap = std::min(verdict.cap, together);
  }
  return verdict;
}

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// How much farther than the visible surface all others have to be, in window depth, for a pixel
/// to count in the mean of stored minus exact.
constexpr double extra_for_bias = 1e-3;

/// Whether the visible triangle is certain to be drawn and nothing else is near it.
bool is_alone(const Fragment& visible, const std::vector<Fragment>& fragments) {
  return visible.coverage == Coverage::must &&
         std::all_of(fragments.begin(), fragments.end(), [&](const Fragment& f) {
           return &f == &visible || f.value.lower > visible.value.upper + extra_for_bias;
         });
}

}  // namespace

PixelJudge::PixelJudge(const Truth& truth, const OtherMap& other, const RendererModel& model)
    : truth_(truth),
      other_(other),
      watertight_(model.watertight),
      equal_depths_(other.triangles.empty() ? std::nullopt : model.equal_depths),
      values_(stored_values(truth, other, model)) {}

PixelJudge::Pixel PixelJudge::pixel(std::size_t index,
                                    const std::vector<Fragment>& fragments) const {
  return {index, fragments,
          verdict_of(fragments, watertight_, truth_.mesh.triangles, truth_.corner_numbers)};
}

/// A triangle with the same corners in the same order is certain to be seen instead.
bool PixelJudge::loses_to_an_equal(const Pixel& p, const Fragment& f) const {
  if (!equal_depths_) return false;
  const bool first_wins = *equal_depths_ == EqualDepths::first_wins;
  const auto corners = [&](std::uint32_t triangle) {
    CornerIndices t = truth_.mesh.triangles[triangle];
    for (std::uint32_t& corner : t) corner = truth_.corner_numbers[corner];
    return t;
  };
  return std::any_of(p.fragments.begin(), p.fragments.end(), [&](const Fragment& g) {
    const bool beats = first_wins ? g.triangle < f.triangle : g.triangle > f.triangle;
    return beats && corners(g.triangle) == corners(f.triangle);
  });
}

/// A fragment that may be visible here: the visible triangle if possible, else the fragment whose
/// exact value is nearest to the stored value.
const Fragment* PixelJudge::explaining(const Pixel& p, double stored) const {
  const double farthest = values_->limit(p.verdict.cap);
  const Fragment* best = nullptr;
  for (const Fragment& f : p.fragments) {
    if (!other_.triangles.empty() && f.triangle != other_.triangles[p.index]) continue;
    const Interval allowed = values_->interval(f);
    if (!(allowed.lower <= stored && stored <= allowed.upper)) continue;
    if (allowed.lower > farthest || stored > farthest) continue;
    if (loses_to_an_equal(p, f)) continue;
    if (&f == p.visible) return &f;
    const auto distance = [&](const Fragment& g) { return std::abs(values_->exact(g) - stored); };
    if (best == nullptr || distance(f) < distance(*best)) best = &f;
  }
  return best;
}

/// The other map shows the background.
PixelClass PixelJudge::class_of_none(const Pixel& p) const {
  if (truth_.triangles[p.index] == no_surface) return PixelClass::equal;
  if (p.verdict.must) return PixelClass::unexplained;
  return p.verdict.must_if_watertight ? PixelClass::missed : PixelClass::edge;
}

/// The other map shows the visible triangle.
PixelClass PixelJudge::class_of_visible(const Pixel& p) const {
  const double depth = truth_.depths[p.index];
  if (values_->is_nearest(p.index, depth)) return PixelClass::equal;
  return values_->is_neighbour(p.index, depth) ? PixelClass::quantization : PixelClass::arithmetic;
}

PixelClass PixelJudge::class_of_another(const Pixel& p, const Fragment& seen) const {
  if (p.visible == nullptr) return PixelClass::edge;
  const bool is_nearest = values_->is_nearest(p.index, truth_.depths[p.index]);
  if (is_nearest && other_.triangles.empty()) return PixelClass::equal;
  if (p.visible->coverage == Coverage::must && seen.coverage == Coverage::must) {
    return PixelClass::z_fight;
  }
  const bool behind = values_->interval(seen).lower > values_->interval(*p.visible).upper;
  if (behind && p.verdict.must_if_watertight && !p.verdict.must) return PixelClass::missed;
  return PixelClass::edge;
}

PixelClass PixelJudge::classify(const Pixel& p) const {
  const double stored = values_->other(p.index);
  const Fragment* const seen = explaining(p, stored);
  if (values_->is_background(p.index)) {
    const PixelClass none = class_of_none(p);
    const bool may_be_a_surface = values_->surfaces_may_look_like_background() && seen != nullptr;
    if (none != PixelClass::unexplained || !may_be_a_surface) return none;
  }
  if (seen == nullptr) return PixelClass::unexplained;
  const bool is_visible = p.visible != nullptr && seen->triangle == p.visible->triangle;
  return is_visible ? class_of_visible(p) : class_of_another(p, *seen);
}

/// Of an unexplained pixel: whether that is because of equal triangles a wrong one is shown.
bool PixelJudge::shows_loser_of_equals(const Pixel& p) const {
  if (!equal_depths_) return false;
  const auto shown = std::find_if(p.fragments.begin(), p.fragments.end(), [&](const Fragment& f) {
    return f.triangle == other_.triangles[p.index];
  });
  return shown != p.fragments.end() && loses_to_an_equal(p, *shown);
}

/// Whether the pixel would be explained if a triangle were not there.
bool PixelJudge::is_explained_without(std::uint32_t triangle, const Pixel& p) const {
  std::vector<Fragment> others;
  for (const Fragment& f : p.fragments) {
    if (f.triangle != triangle) others.push_back(f);
  }
  const Pixel without = pixel(p.index, others);
  const bool shows_none = other_.depths[p.index] == infinity;
  return shows_none ? !without.verdict.must
                    : explaining(without, values_->other(p.index)) != nullptr;
}

/// Codes of a distant surface may span its depth, too, but they are few. A width between infinities
/// is no number, and loose.
bool PixelJudge::is_loose(const Pixel& p) const {
  const double depth = truth_.depths[p.index];
  return std::any_of(p.fragments.begin(), p.fragments.end(), [&](const Fragment& f) {
    constexpr double half_of_sixteen_bits = 0x1p15;
    const Interval allowed = values_->as_depths(f);
    return f.value.lower <= p.verdict.cap && !(allowed.upper - allowed.lower < depth) &&
           !(values_->steps(f, depth) < half_of_sixteen_bits);
  });
}

void PixelJudge::measure(const Pixel& p, PixelResult& result) const {
  result.touched = !p.fragments.empty();
  result.shows_surface = truth_.triangles[p.index] != no_surface;
  result.loose = result.shows_surface && is_loose(p);
  for (const Fragment& f : p.fragments) {
    if (f.coverage == Coverage::may && f.value.lower <= p.verdict.cap) result.may = true;
  }
  if (p.visible == nullptr) return;
  const double depth = truth_.depths[p.index];
  const Interval allowed = values_->as_depths(*p.visible);
  result.visible = {allowed, (allowed.upper - allowed.lower) / depth,
                    values_->steps(*p.visible, depth)};
  result.alone = is_alone(*p.visible, p.fragments);
  if (!(other_.depths[p.index] < infinity)) return;
  if (result.pixel_class <= PixelClass::arithmetic) {  // the same surface
    const double error = std::abs(other_.depths[p.index] - depth);
    result.error = {error, error / depth};
  }
  if (result.alone) result.bias = values_->bias_steps(p.index, *p.visible);
}

PixelResult PixelJudge::judge(std::size_t index, const std::vector<Fragment>& fragments) const {
  Pixel p = pixel(index, fragments);
  const std::uint32_t visible = truth_.triangles[index];
  for (const Fragment& f : fragments) {
    if (f.triangle == visible) p.visible = &f;
  }
  PixelResult result;
  result.pixel_class = classify(p);
  if (result.pixel_class == PixelClass::unexplained) {
    result.wrong_tie = shows_loser_of_equals(p);
    const bool may_be_absent = visible != no_surface && !result.wrong_tie;
    if (may_be_absent && is_explained_without(visible, p)) result.absent = visible;
  }
  measure(p, result);
  return result;
}

}  // namespace fathom::attribution
