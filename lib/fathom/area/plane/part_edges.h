#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <mutex>
#include <vector>

#include "fathom/area/plane/edge_rule.h"
#include "fathom/area/plane/line_sweep.h"
#include "fathom/area/plane/resolve.h"
#include "fathom/area/plane/side_edges.h"

namespace fathom::area {

/// The visible edges in the parts of an image.
///
/// In a simple part every edge lies between neighbours that are both visible. In a crowded part a
/// line sweep finds the edges. An edge on a side between two parts has one side in each;
/// side_edges.h puts them together. An edge between two triangles that are wholly visible takes no
/// arithmetic.
class PartEdges {
 public:
  PartEdges(const PlaneMesh& mesh, const EdgeRule& rule)
      : mesh_(mesh), rule_(rule), resolved_(resolve(mesh, mesh.scene().image())) {}

  /// Finds the edges that are not visible as a whole by whole_edges().
  [[nodiscard]] std::vector<VisibleEdge> partial_edges();
  /// Calls visit(edge) for those between wholly visible triangles.
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
