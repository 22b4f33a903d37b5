#include "fathom/area/plane/part_edges.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "fathom/threads/interruption.h"
#include "fathom/threads/threads.h"

namespace fathom::area {
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
