#pragma once

#include <optional>

#include "fathom/fast/channels/background_rows.h"
#include "fathom/fast/channels/certified_writer.h"
#include "fathom/fast/channels/map_rows.h"
#include "fathom/fast/tiles/draw_context.h"
#include "fathom/fast/tiles/tile.h"
#include "fathom/triangle/channels.h"

namespace fathom::fast {

/// Where a tile is written to.
struct TileOutput {
  CertifiedWriter& certified;
  /// If not null, the values of channel Z, which are written for the whole area.
  float* depths;
  /// Whether there are channels besides Z in binary32 and A, and what these have where there is
  /// no surface, as far as they have to be filled.
  bool others;
  const BackgroundRows& background;
  MapLayout layout;
};

/// Writes the visible surfaces; stops at the first fault in row order, whose pixel is that of the
/// map.
std::optional<triangle::EncodingFault> resolve(const Tile& tile, const TileOutput& output,
                                               const DrawContext& context);

}  // namespace fathom::fast
