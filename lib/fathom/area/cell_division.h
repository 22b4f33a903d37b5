#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "fathom/area/image_cell.h"

/// Cutting what lies in a cell in halves until few pieces are left in each part: the questions
/// asked about a part take the square of their number, or more, so that thousands of triangles in a
/// pixel would take forever. Areas of the parts add up, depths of the nearest are compared.
/// Source   John E. Warnock, A hidden surface algorithm for computer generated halftone pictures,
///          University of Utah, 1969.
namespace fathom::area {

struct DivisionLimits {
  /// So few pieces are not divided.
  std::size_t few = 24;
  /// The sides of parts stay binary64 numbers: a place on the image takes 24 bits.
  int cuts = 40;
  /// A cut is in vain where the halves have many more pieces together than the part: edges that lie
  /// on each other are not told apart by any number of cuts.
  int cuts_in_vain = 6;
};

/// Calls `visit` with parts of the state, which has size() and halves().
template <class State, class Visit>
void divide(State state, const Visit& visit, DivisionLimits left = {}) {
  if (state.size() <= left.few || left.cuts == 0 || left.cuts_in_vain == 0) {
    visit(state);
    return;
  }
  std::array<State, 2> halves = state.halves();
  const bool in_vain = 2 * (halves[0].size() + halves[1].size()) > 3 * state.size();
  --left.cuts;
  left.cuts_in_vain = in_vain ? left.cuts_in_vain - 1 : DivisionLimits{}.cuts_in_vain;
  for (State& half : halves) divide(std::move(half), visit, left);
}

/// The part of a polygon in one half of a part of a cell, if it has an area.
inline std::optional<ConvexPolygon> in_half(const ConvexPolygon& polygon,
                                            const ImageCell::Half& half, TierCounts& counts) {
  if (!polygon.bounds().may_meet(half.part.outline.bounds())) return std::nullopt;
  ConvexPolygon result = polygon;
  if (!result.clip(*half.side, counts)) return std::nullopt;
  return result;
}

/// Divides polygons in a cell and calls `visit` with those in each part. Of polygons of which one
/// is the whole part, that one is left.
void for_each_simple_part(ImageCell& cell, std::vector<ConvexPolygon> polygons, TierCounts& counts,
                          const std::function<void(std::span<const ConvexPolygon>)>& visit);

}  // namespace fathom::area
