// fathom, the everyday program. What takes long to compile or needs other packages is a program of
// its own, which this one starts.

#include <algorithm>

#include "apps/commands.h"
#include "apps/dataset/dataset_command.h"
#include "apps/render/render_command.h"
#include "apps/shell/program.h"
#include "fathom/failures/errors.h"

namespace fathom::app {
namespace {

std::vector<Companion> companions() {
  return {
      {"visible", "fathom-surfaces",
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
      {"bench", "fathom-bench",
       "Compare time and memory with VTK, Embree and the reference engine"},
      {"validate", "fathom-validate",
       "Check another renderer's maps against the truth and explain every difference"}};
}

/// `render --engine pipeline` is carried out by fathom-textbook, which gets the same arguments.
Render by_textbook(const std::vector<std::string>& arguments) {
  return [arguments](const RenderArguments&, const Console&) -> int {
    start_companion("fathom-textbook", arguments);
    throw UsageError(
        not_built("'--engine pipeline'", "fathom-textbook", "render … --engine pipeline"));
  };
}

/// `camera shutter` is carried out by fathom-surfaces, which has rays.
ShutterRun by_surfaces(const std::vector<std::string>& arguments) {
  return [arguments](const ShutterArguments&, const Console&) -> int {
    start_companion("fathom-surfaces", arguments);
    throw UsageError(not_built("'camera shutter'", "fathom-surfaces", "camera shutter"));
  };
}

std::vector<AddCommand> commands(const std::vector<std::string>& arguments) {
  const auto add_render_command = [arguments](Command& program) {
    add_render(program, render_exactly, by_textbook(arguments));
  };
  const auto add_camera_command = [arguments](Command& program) {
    add_camera(program, by_surfaces(arguments));
  };
  return {add_render_command, add_probe,          add_info,    add_preview, add_compare,
          add_convert,        add_camera_command, add_dataset, add_depth};
}

}  // namespace
}  // namespace fathom::app

int main(int argc, char** argv) {
  return fathom::app::program_main(argc, argv, fathom::app::commands, fathom::app::companions);
}
