#include "fathom/area/plane/part_edges.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <mutex>
#include <utility>

#include "fathom/threads/interruption.h"
#include "fathom/threads/threads.h"

namespace fathom::area {
namespace {

/// A visible triangle next to a side, in one of its two parts; places count along the side.
struct SideSpan {
  Ratio from, to;
  EdgeSide visible;
};

/// The visible triangles on the two sides of a line: at smaller and at greater coordinates.
struct LineSpans {
  std::vector<SideSpan> before, after;
};

class SideEdges {
 public:
  SideEdges(const PlaneMesh& mesh, const EdgeRule& rule, const ResolvedParts& resolved,
            const std::vector<PartSide>& sides)
      : mesh_(mesh), rule_(rule), resolved_(resolved) {
    for (const PartSide& side : sides) lines_[side];
  }

  /// Adds the visible triangles at the sides of a part.
  void add_part(const PlanePart& part, const std::vector<std::uint32_t>& triangles) {
    std::array<LineSpans*, 4> lines{};
    for (std::size_t k = 0; k < 4; ++k) {
      const auto line = lines_.find(side_of(part, k));
      if (line != lines_.end()) lines[k] = &line->second;
    }
    if (std::ranges::count(lines, nullptr) == 4) return;
    check_interruption();
    LineSweep sweep(mesh_, part, triangles, LineSweep::none);
    for (const LineSweep::Span& span : sweep.spans()) {
      const auto side = std::ranges::find(sweep.sides(), span.along, &OrientedLine::line);
      if (side == sweep.sides().end()) continue;
      const auto k = static_cast<std::size_t>(side - sweep.sides().begin());
      if (lines[k]) add(*lines[k], k, span_of(sweep, part, span, triangles, k));
    }
  }

  [[nodiscard]] std::vector<VisibleEdge> edges() {
    std::vector<VisibleEdge> found;
    for (auto& [side, spans] : lines_) add_edges(side, spans, found);
    return found;
  }

 private:
  /// Only one side of the line is in the part.
  static SideSpan span_of(const LineSweep& sweep, const PlanePart& part,
                          const LineSweep::Span& span, const std::vector<std::uint32_t>& triangles,
                          std::size_t k) {
    const LineSweep::Side& inside = span.left.piece != LineSweep::none ? span.left : span.right;
    const ImagePlace p = place_of(sweep, part, span.along, span.from),
                     q = place_of(sweep, part, span.along, span.to);
    const bool is_upright = k % 2 == 0;
    Ratio from = is_upright ? p.v : p.u, to = is_upright ? q.v : q.u;
    if (to < from) std::swap(from, to);
    return {std::move(from), std::move(to), {triangles[inside.piece], inside.edge}};
  }

  /// The left and the top side of a part have it after them.
  void add(LineSpans& line, std::size_t k, SideSpan span) {
    const std::lock_guard lock(mutex_);
    (k < 2 ? line.after : line.before).push_back(std::move(span));
  }

  [[nodiscard]] static std::vector<Ratio> ends_of(const LineSpans& line) {
    std::vector<Ratio> ends;
    for (const auto* const spans : {&line.before, &line.after}) {
      for (const SideSpan& span : *spans) {
        ends.push_back(span.from);
        ends.push_back(span.to);
      }
    }
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    return ends;
  }

  /// Visits the visible triangles on a side, from one end of a span to the next.
  class Cursor {
   public:
    explicit Cursor(std::vector<SideSpan>& spans) : spans_(spans) {
      std::sort(spans.begin(), spans.end(),
                [](const SideSpan& a, const SideSpan& b) { return a.from < b.from; });
    }
    EdgeSide at(const Ratio& from) {
      while (next_ < spans_.size() && !(from < spans_[next_].to)) ++next_;
      const bool is_there = next_ < spans_.size() && !(from < spans_[next_].from);
      return is_there ? spans_[next_].visible : EdgeSide{};
    }

   private:
    std::vector<SideSpan>& spans_;
    std::size_t next_ = 0;
  };

  void add_edges(const PartSide& side, LineSpans& line, std::vector<VisibleEdge>& found) const {
    const std::vector<Ratio> ends = ends_of(line);
    Cursor before(line.before), after(line.after);
    const auto place = [&](const Ratio& along) {
      const Ratio at{Dyadic(side.at)};
      return side.is_upright ? ImagePlace{at, along} : ImagePlace{along, at};
    };
    for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
      const EdgeSide a = before.at(ends[k]), b = after.at(ends[k]);
      if (a.triangle == b.triangle || are_whole(a, b)) continue;
      if (auto edge = rule_.edge(a, b, place(ends[k]), place(ends[k + 1]))) {
        found.push_back(std::move(*edge));
      }
    }
  }

  [[nodiscard]] bool are_whole(const EdgeSide& a, const EdgeSide& b) const {
    return a.triangle != EdgeSide::none && b.triangle != EdgeSide::none &&
           is_wholly_visible(mesh_, resolved_, a.triangle) &&
           is_wholly_visible(mesh_, resolved_, b.triangle);
  }

  const PlaneMesh& mesh_;
  const EdgeRule& rule_;
  const ResolvedParts& resolved_;
  std::map<PartSide, LineSpans> lines_;
  std::mutex mutex_;
};

}  // namespace

PartSide side_of(const PlanePart& part, std::size_t side) {
  const std::array<double, 4> places{part.left, part.top, part.right, part.bottom};
  return {side % 2 == 0, places[side]};
}

ImagePlace place_of(const LineSweep& sweep, const PlanePart& part, std::uint32_t a,
                    std::uint32_t b) {
  auto [U, V, W] = cross(sweep.lines()[a].exact(), sweep.lines()[b].exact());
  U += W * Dyadic(part.left);
  V += W * Dyadic(part.top);
  return {{std::move(U), W}, {std::move(V), W}};
}

std::vector<VisibleEdge> edges_on_sides(const PlaneMesh& mesh, const EdgeRule& rule,
                                        const std::vector<PartSide>& sides,
                                        std::span<const CrowdedPart> crowded,
                                        const ResolvedParts& resolved) {
  SideEdges found(mesh, rule, resolved, sides);
  in_parallel(crowded.size(),
              [&](std::size_t k) { found.add_part(crowded[k].part, crowded[k].triangles); });
  in_parallel(resolved.clips.size(), [&](std::size_t k) {
    found.add_part(resolved.clips[k].part, {resolved.clips[k].triangle});
  });
  return found.edges();
}

namespace {

/// A crowded part with more lines than LineSweep::most_lines is cut so often, if the halves have
/// more than three quarters of its triangles each time.
constexpr int crowd_cuts_in_vain = 6;

std::uint32_t edge_to(const PlaneMesh& mesh, std::uint32_t i, std::uint32_t mate) {
  for (std::uint32_t k = 0; k < 3; ++k) {
    if (mesh.mate(i, k) == mate) return k;
  }
  return EdgeSide::none;
}

bool is_on_rim(const PartSide& side, const PlanePart& image) {
  return side.is_upright ? side.at == image.left || side.at == image.right
                         : side.at == image.top || side.at == image.bottom;
}

}  // namespace

void PartEdges::keep(std::vector<VisibleEdge> edges, const std::vector<PartSide>& touched) {
  const std::lock_guard lock(mutex_);
  std::move(edges.begin(), edges.end(), std::back_inserter(found_));
  for (const PartSide& side : touched) {
    if (!is_on_rim(side, mesh_.scene().image())) touched_.push_back(side);
  }
}

void PartEdges::add_crowded(CrowdedPart crowded, int cuts) {
  check_interruption();
  const std::uint32_t limit = cuts > 0 ? LineSweep::most_lines : LineSweep::none;
  LineSweep sweep(mesh_, crowded.part, crowded.triangles, limit);
  if (!sweep.is_simple()) return divide(crowded, cuts);
  std::vector<VisibleEdge> edges;
  std::vector<PartSide> touched;
  const auto side_of_span = [&](const LineSweep::Side& side) {
    if (side.piece == LineSweep::none) return EdgeSide{};
    return EdgeSide{crowded.triangles[side.piece], side.edge};
  };
  for (const LineSweep::Span& span : sweep.spans()) {
    const EdgeSide left = side_of_span(span.left), right = side_of_span(span.right);
    const auto side = std::ranges::find(sweep.sides(), span.along, &OrientedLine::line);
    if (side != sweep.sides().end()) {
      const bool ends = left.line != EdgeSide::none || right.line != EdgeSide::none;
      const auto k = static_cast<std::size_t>(side - sweep.sides().begin());
      if (ends) touched.push_back(side_of(crowded.part, k));
      continue;
    }
    const bool is_between = left.triangle != EdgeSide::none && right.triangle != EdgeSide::none;
    if (is_between && rule_.leaves_out(left.triangle, right.triangle)) continue;
    auto edge = rule_.edge(left, right, place_of(sweep, crowded.part, span.along, span.from),
                           place_of(sweep, crowded.part, span.along, span.to));
    if (edge) edges.push_back(std::move(*edge));
  }
  for (std::size_t k = 0; k < 4; ++k) {
    if (sweep.pieces_meet_at_side(k)) touched.push_back(side_of(crowded.part, k));
  }
  keep(std::move(edges), touched);
  const std::lock_guard lock(mutex_);
  swept_.push_back(std::move(crowded));
}

void PartEdges::divide(const CrowdedPart& crowded, int cuts) {
  const auto parts = halves(crowded.part);
  if (!parts) return add_crowded(crowded, 0);
  CrowdedPart first{parts->first, {}}, second{parts->second, {}};
  for (const std::uint32_t i : crowded.triangles) {
    if (!misses(mesh_, i, first.part)) first.triangles.push_back(i);
    if (!misses(mesh_, i, second.part)) second.triangles.push_back(i);
  }
  const bool in_vain =
      2 * (first.triangles.size() + second.triangles.size()) > 3 * crowded.triangles.size();
  add_crowded(std::move(first), cuts - (in_vain ? 1 : 0));
  add_crowded(std::move(second), cuts - (in_vain ? 1 : 0));
}

// Where an edge of a sheet is not certainly outside the part, its other triangle is in the sheet,
// too (SheetFinder). It is a clip of the same part, or wholly inside. An edge on a side of the part
// has its neighbour in another part, where the neighbour or a triangle that ends there is visible:
// one of the two parts notes the side.
bool PartEdges::has_edge(const VisibleClip& clip, std::uint32_t mate) const {
  return clip.triangle < mate || mesh_.box(mate).is_inside(clip.part);
}

/// The edges of a clipped triangle to find by a sweep. Edges that are wholly in the part are added
/// to `whole`.
std::array<bool, 3> PartEdges::edges_of_clip(const VisibleClip& clip,
                                             std::vector<VisibleEdge>& whole) const {
  const std::uint32_t i = clip.triangle;
  std::array<bool, 3> partly{};
  for (std::uint32_t k = 0; k < 3; ++k) {
    const BoundedPoint &from = mesh_.point(i, k), &to = mesh_.point(i, k + 1);
    const std::uint32_t mate = mesh_.mate(i, k);
    if (mate == PlaneMesh::none || misses(clip.part, from, to)) continue;
    if (is_whole(i) && is_whole(mate)) continue;
    if (!has_edge(clip, mate)) continue;
    if (rule_.leaves_out(i, mate)) continue;
    if (PlaneBox(from, to).is_inside(clip.part)) {
      whole.push_back(rule_.whole_edge(i, k));
    } else {
      partly[k] = true;
    }
  }
  return partly;
}

void PartEdges::add_clip(const VisibleClip& clip) {
  check_interruption();
  const std::uint32_t i = clip.triangle;
  const bool is_regular = mesh_.is_regular(i);
  std::vector<VisibleEdge> edges;
  std::vector<PartSide> touched;
  std::array<bool, 3> partly{};
  if (is_regular) partly = edges_of_clip(clip, edges);
  if (!is_regular || std::ranges::count(partly, true) > 0) {
    LineSweep sweep(mesh_, clip.part, {i});
    for (const LineSweep::Span& span : sweep.spans()) {
      const std::uint32_t k = std::min(span.left.edge, span.right.edge);
      if (k == LineSweep::none || (is_regular && !partly[k])) continue;
      const auto side = std::ranges::find(sweep.sides(), span.along, &OrientedLine::line);
      if (side != sweep.sides().end()) {
        touched.push_back(
            side_of(clip.part, static_cast<std::size_t>(side - sweep.sides().begin())));
        continue;
      }
      const std::uint32_t mate = mesh_.mate(i, k);
      auto edge = rule_.edge({i, k}, {mate, edge_to(mesh_, mate, i)},
                             place_of(sweep, clip.part, span.along, span.from),
                             place_of(sweep, clip.part, span.along, span.to));
      if (edge) edges.push_back(std::move(*edge));
    }
  }
  keep(std::move(edges), touched);
}

std::vector<VisibleEdge> PartEdges::partial_edges() {
  in_parallel(resolved_.crowded.size(),
              [&](std::size_t k) { add_crowded(resolved_.crowded[k], crowd_cuts_in_vain); });
  in_parallel(resolved_.clips.size(), [&](std::size_t k) { add_clip(resolved_.clips[k]); });
  std::vector<VisibleEdge> on_sides = edges_on_sides(mesh_, rule_, touched_, swept_, resolved_);
  std::move(on_sides.begin(), on_sides.end(), std::back_inserter(found_));
  return std::move(found_);
}

void PartEdges::whole_edges(const std::function<void(const VisibleEdge&)>& visit) const {
  std::vector<std::uint8_t> wanted(mesh_.size());
  parallel_for(std::uint32_t{0}, mesh_.size(), [&](std::uint32_t i) {
    if (!is_whole(i)) return;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t mate = mesh_.mate(i, k);
      const bool is_first = mate != PlaneMesh::none && i < mate;
      if (!is_first || !is_whole(mate) || rule_.leaves_out(i, mate)) continue;
      wanted[i] = static_cast<std::uint8_t>(wanted[i] | 1U << k);
    }
  });
  for (std::uint32_t i = 0; i < mesh_.size(); ++i) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      if ((wanted[i] >> k & 1U) != 0) visit(rule_.whole_edge(i, k));
    }
  }
}

}  // namespace fathom::area
