#pragma once

#include <array>
#include <string_view>

#include "apps/shell/companion.h"

/// The commands that are companion programs. `fathom --help` and the programs take the descriptions
/// from this table.
namespace fathom::app {

inline constexpr auto companion_table = std::to_array<Companion>(
    {{"visible", "fathom-surfaces",
      "Measure how much of each triangle and object is visible, exactly"},
     {"areas", "fathom-surfaces",
      "Measure the areas that a sun, a lamp or a camera sees, exactly, without pixels"},
     {"sun", "fathom-surfaces", "Print directions towards the sun, for areas"},
     {"draw", "fathom-surfaces", "Draw the visible edges as SVG or PDF, with exact hidden lines"},
     {"evaluate", "fathom-surfaces",
      "Measure a reconstructed mesh or point cloud against the true one: Depth L1, accuracy, "
      "completeness"},
     {"coplanar", "fathom-surfaces",
      "Find visible surfaces that coincide or nearly coincide, where z-buffers fight"},
     {"cast", "fathom-surfaces", "Find the triangles that rays meet, exactly"},
     {"sees", "fathom-surfaces", "Decide which points see each other, exactly"},
     {"doctor", "fathom-surfaces",
      "Find what is wrong with the cameras and depth images of a mesh"},
     {"clip", "fathom-textbook", "Clip polygons and segments given as JSON lines"},
     {"scan", "fathom-textbook", "Rasterize lines, polygons and triangles given as JSON lines"},
     {"pipeline", "fathom-textbook",
      "Trace primitives through the graphics pipeline, or run one of its stages"},
     {"study", "fathom-study",
      "Measure depth-buffer precision and textbook algorithms; write tables and web pages"},
     {"view", "fathom-view",
      "Show maps in a browser, with pan, zoom, values, ranges and histograms"},
     {"formats", "fathom-formats",
      "Show which libraries read foreign mesh formats (FBX, COLLADA, 3DS, 3MF, …)"},
     {"bench", "fathom-bench", "Compare time and memory with VTK, Embree and the reference engine"},
     {"validate", "fathom-validate",
      "Check another renderer's maps against the truth and explain every difference"}});

/// The description of a command of the table; a command that is not there does not compile.
consteval const char* description_of_companion(std::string_view command) {
  for (const Companion& companion : companion_table)
    if (companion.command == command) return companion.description.data();
  throw "companion_table has no such command";
}

}  // namespace fathom::app
