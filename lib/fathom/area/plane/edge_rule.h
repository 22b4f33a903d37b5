#pragma once

#include <cstdint>
#include <optional>

#include "fathom/area/plane/sheets.h"
#include "fathom/area/visible_edges.h"

namespace fathom::area {

/// A side of a part of a line: the visible triangle of a mesh, and which of its lines it is: for a
/// regular triangle, the edge from that corner to the next, otherwise a form of its region.
struct EdgeSide {
  static constexpr std::uint32_t none = PlaneMesh::none;
  std::uint32_t triangle = none, line = none;
  friend bool operator==(const EdgeSide&, const EdgeSide&) = default;
};

/// Decides which edges are wanted, and whose they are.
class EdgeRule {
 public:
  /// Fails    UsageError for an angle outside 0 to 180.
  EdgeRule(const TriangleSource& triangles, const PlaneMesh& mesh, const EdgeOptions& options);

  /// Whether an edge between two triangles whose surface continues there is wanted.
  [[nodiscard]] bool wants_joined(std::uint32_t i, std::uint32_t j) const;
  /// Whether they are neighbours in one object, and an edge between them is not wanted.
  [[nodiscard]] bool leaves_out(std::uint32_t i, std::uint32_t j) const;

  /// The edge between two sides with different triangles; nullopt if it is not wanted.
  [[nodiscard]] std::optional<VisibleEdge> edge(EdgeSide a, EdgeSide b, ImagePlace from,
                                                ImagePlace to) const;
  /// The edge of a regular triangle from corner k to the next, as a whole, where its neighbour is
  /// visible on the other side.
  [[nodiscard]] VisibleEdge whole_edge(std::uint32_t i, std::uint32_t k) const;

 private:
  [[nodiscard]] std::uint32_t object_of(std::uint32_t i) const;
  [[nodiscard]] bool are_mates(std::uint32_t i, std::uint32_t j) const;
  [[nodiscard]] bool are_equally_deep(std::uint32_t i, std::uint32_t j, const ImagePlace& from,
                                      const ImagePlace& to) const;
  [[nodiscard]] bool is_crease(std::uint32_t i, std::uint32_t j) const;
  [[nodiscard]] EdgeName name_of(EdgeSide side) const;

  const TriangleSource& triangles_;
  const PlaneMesh& mesh_;
  EdgeSelection selection_;
  double cosine_;
};

}  // namespace fathom::area
