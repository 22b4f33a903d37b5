#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "fathom/area/image_cell.h"

/// Cutting what lies in a cell in two until few pieces are left in each part: the work for a part
/// grows with the cube of their number, so that thousands of triangles in a pixel would take
/// forever. Areas of the parts add up, and their nearest depths are compared.
///
/// A part is cut in halves ([War69]) as long as that separates pieces. Halves do not separate
/// pieces that cover the same places, such as faces that coincide or edges that lie on each other.
/// Then the part is cut along an edge of the piece that hides most: after as many cuts as that
/// piece has edges, it is all of a part, of which nothing else is left but what lies in front. Such
/// an edge becomes a side of both parts, and with it every other edge in the same line.
/// Source   [War69], [FKN80]
namespace fathom::area {

struct DivisionLimits {
  /// So few pieces are not divided any further.
  std::size_t few = 24;
  int cuts = 40;
  /// A cut in halves is in vain if they have many more pieces together than the part.
  int cuts_in_vain = 6;
};

template <class State>
std::size_t size_of(const std::vector<State>& parts) {
  std::size_t sum = 0;
  for (const State& part : parts) sum += part.size();
  return sum;
}

/// Calls `visit` with parts of the state, which must have
///   size()                how many pieces there are
///   halves()              the state in the halves of its part
///   halves_along_edge()   the same on both sides of an edge that is not a side of the part;
///                         nothing if there is none
/// It ends, because pieces in a part have fewer edges that are not its sides than before a cut
/// along an edge, and other cuts are limited.
template <class State, class Visit>
void divide(State state, const Visit& visit, DivisionLimits left = {}) {
  if (state.size() <= left.few) {
    visit(state);
    return;
  }
  std::vector<State> parts;
  if (left.cuts > 0) parts = state.halves();
  const bool separate = !parts.empty() && 2 * size_of(parts) <= 3 * state.size();
  bool in_halves = true;
  if (!separate) {
    std::vector<State> along_edge = state.halves_along_edge();
    in_halves = !parts.empty() && left.cuts_in_vain > 0 && size_of(parts) < size_of(along_edge);
    if (!in_halves) parts = std::move(along_edge);
    --left.cuts_in_vain;
  }
  if (in_halves) --left.cuts;
  if (parts.empty()) {
    visit(state);
    return;
  }
  for (State& part : parts) divide(std::move(part), visit, left);
}

/// The part of a polygon in one half of a part of a cell, if it has an area.
inline std::optional<ConvexPolygon> in_half(const ConvexPolygon& polygon,
                                            const ImageCell::Half& half, TierCounts& counts) {
  if (!polygon.bounds().may_meet(half.part.outline.bounds())) return std::nullopt;
  ConvexPolygon result = polygon;
  if (!result.clip(*half.side, counts)) return std::nullopt;
  return result;
}

/// Divides polygons in a cell and calls `visit` with those in each part. If one of the polygons is
/// the whole part, only that one is left.
void for_each_simple_part(ImageCell& cell, std::vector<ConvexPolygon> polygons, TierCounts& counts,
                          const std::function<void(std::span<const ConvexPolygon>)>& visit);

}  // namespace fathom::area
