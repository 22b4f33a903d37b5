#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "fathom/area/plane/sheets.h"

/// Divides the image into parts in which visibility is simple ([War69], with the aim of [Fra80]:
/// work only where something changes).
namespace fathom::area {

/// The results of the parts about a triangle, as flags.
using PartFlags = std::uint8_t;
/// Visible wherever it is, in some part; hidden in some part; in some crowded part.
inline constexpr PartFlags is_seen_somewhere = 1, is_hidden_somewhere = 2, is_crowded_somewhere = 4;

/// A triangle that is visible wherever it is in a part, but may reach beyond the part.
struct VisibleClip {
  std::uint32_t triangle;
  PlanePart part;
};

/// Triangles among which visibility in a part has to be decided in detail.
struct CrowdedPart {
  PlanePart part;
  std::vector<std::uint32_t> triangles;
};

struct ResolvedParts {
  std::vector<PartFlags> flags;
  std::vector<VisibleClip> clips;
  std::vector<CrowdedPart> crowded;
  /// How many parts were looked at, and how many triangles in them.
  std::uint64_t parts = 0, triangles_in_parts = 0;
};

/// The halves of a part, across its longer side; nullopt where binary64 has no number between.
std::optional<std::pair<PlanePart, PlanePart>> halves(const PlanePart& part);

/// Whether all of a triangle is inside the image and visible.
inline bool is_wholly_visible(const PlaneMesh& mesh, const ResolvedParts& parts, std::uint32_t i) {
  return parts.flags[i] == is_seen_somewhere && mesh.is_regular(i) &&
         mesh.box(i).is_inside(mesh.scene().image());
}

/// Where parts are cut: in the middle, or near it, where the cut meets the fewest triangles.
enum class PartCuts : std::uint8_t { in_middle, through_few };

/// Divides the part of the mesh within `whole`. Each part ends as empty, as simple, where every
/// triangle left is visible, or as crowded.
/// Cost     n log n in practice: a part in which a sheet hides the rest is not cut any further.
ResolvedParts resolve(const PlaneMesh& mesh, const PlanePart& whole, PartCuts cuts);

}  // namespace fathom::area
