#include "fathom/area/plane/side_edges.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <utility>

#include "fathom/threads/interruption.h"
#include "fathom/threads/threads.h"

namespace fathom::area {
namespace {

/// What is visible next to a side, in one of the parts at it; places count along the side.
struct SideSpan {
  Ratio from, to;
  EdgeSide visible;
};

/// What is visible on the two sides of a line: at smaller and at greater coordinates.
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

  /// What is visible at the sides of a part.
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

  /// Visits, from neighbouring end to end, what is visible on a side.
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

}  // namespace fathom::area
