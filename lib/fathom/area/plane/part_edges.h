#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <functional>
#include <mutex>
#include <span>
#include <vector>

#include "fathom/area/plane/edge_rule.h"
#include "fathom/area/plane/line_sweep.h"
#include "fathom/area/plane/resolve.h"

/// Edges that lie exactly on sides between parts of the image: on each side of them another part
/// knows which triangle is visible.
namespace fathom::area {

/// The line of a side of parts: u = at if it is upright, else v = at.
struct PartSide {
  bool is_upright = false;
  double at = 0;
  // NOLINTNEXTLINE(modernize-use-nullptr): it has no pointer
  friend auto operator<=>(const PartSide&, const PartSide&) = default;
};
/// Of the side of that number in LineSweep::sides().
PartSide side_of(const PlanePart& part, std::size_t side);

/// The place where two lines of a sweep of a part cross.
ImagePlace place_of(const LineSweep& sweep, const PlanePart& part, std::uint32_t a,
                    std::uint32_t b);

/// The edges on some sides, from all parts that have triangles. Edges between triangles that are
/// `whole` are left out.
std::vector<VisibleEdge> edges_on_sides(const PlaneMesh& mesh, const EdgeRule& rule,
                                        const std::vector<PartSide>& sides,
                                        std::span<const CrowdedPart> crowded,
                                        const ResolvedParts& resolved);

/// The visible edges in the parts of an image.
///
/// In a simple part every edge lies between neighbours that are both visible. In a crowded part a
/// line sweep finds the edges. An edge on a side between two parts has one side in each;
/// edges_on_sides() puts them together. An edge between two triangles that are wholly visible takes
/// no arithmetic.
class PartEdges {
 public:
  PartEdges(const PlaneMesh& mesh, const EdgeRule& rule)
      : mesh_(mesh),
        rule_(rule),
        resolved_(resolve(mesh, mesh.scene().image(), PartCuts::in_middle)) {}

  /// Finds the edges that are not visible as a whole by whole_edges().
  [[nodiscard]] std::vector<VisibleEdge> partial_edges();
  /// Calls visit(edge) for the edges between wholly visible triangles.
  void whole_edges(const std::function<void(const VisibleEdge&)>& visit) const;

 private:
  void add_crowded(CrowdedPart crowded, int cuts);
  void divide(const CrowdedPart& crowded, int cuts);
  void add_clip(const VisibleClip& clip);
  /// Whether the edge to a neighbour is of this clip, not of the neighbour's.
  [[nodiscard]] bool has_edge(const VisibleClip& clip, std::uint32_t mate) const;
  [[nodiscard]] std::array<bool, 3> edges_of_clip(const VisibleClip& clip,
                                                  std::vector<VisibleEdge>& whole) const;
  [[nodiscard]] bool is_whole(std::uint32_t i) const {
    return is_wholly_visible(mesh_, resolved_, i);
  }
  void keep(std::vector<VisibleEdge> edges, const std::vector<PartSide>& touched);

  const PlaneMesh& mesh_;
  const EdgeRule& rule_;
  ResolvedParts resolved_;
  std::mutex mutex_;
  std::vector<VisibleEdge> found_;
  /// Crowded parts as they were swept.
  std::vector<CrowdedPart> swept_;
  std::vector<PartSide> touched_;
};

}  // namespace fathom::area
