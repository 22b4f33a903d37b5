// fathom draw SCENE… --camera FILE -o FILE

#include <unistd.h>

#include <memory>
#include <string>

#include "apps/commands.h"
#include "apps/companions.h"
#include "apps/options/camera_options.h"
#include "apps/options/scene_options.h"
#include "apps/shell/console.h"
#include "apps/shell/failures.h"
#include "apps/shell/output_file.h"
#include "apps/shell/values.h"
#include "fathom/camera/camera.h"
#include "fathom/drawing/drawing.h"
#include "fathom/failures/errors.h"

namespace fathom::app {
namespace {

struct DrawArguments {
  SceneOptions scene;
  CameraOptions camera;
  EdgeOptions edges;
  DrawingStyle style;
  std::string output;  ///< empty unless given
};

EdgeSelection parse_selection(const std::string& text) {
  return parse_enumerator(text, all_edge_selections);
}

double parse_angle(const std::string& text) {
  const double degrees = parse_number(text);
  if (!(degrees >= 0 && degrees <= 180)) {
    throw UsageError("'" + text + "' is not an angle from 0 to 180 degrees");
  }
  return degrees;
}

double parse_width(const std::string& text) {
  const double pixels = parse_number(text);
  if (!(pixels > 0)) throw UsageError("'" + text + "' is not a width above 0");
  return pixels;
}

int run_draw(const DrawArguments& arguments, const Console& console) {
  if (arguments.output.empty() && ::isatty(STDOUT_FILENO) == 1) {
    throw UsageError("the drawing would fill the terminal: give -o FILE, or -o - to print it");
  }
  const std::string name = arguments.output.empty() ? "-" : arguments.output;
  const bool as_pdf = name.ends_with(".pdf");
  if (!as_pdf && name != "-" && !name.ends_with(".svg")) {
    throw UsageError("-o: '" + name + "' does not end in .svg or .pdf");
  }
  EdgeOptions edges = arguments.edges;
  edges.threads = arguments.scene.threads;
  TextOutput output(name);
  const Scene scene = arguments.scene.read(console);
  const Camera camera = arguments.camera.get_one(scene, arguments.scene.limits, "draw", console);
  require_straight(camera);
  Drawing drawing;
  {
    Progress progress(console, "drawing");
    drawing = draw(scene, camera, edges, progress.reporter());
  }
  output.finish(as_pdf ? pdf_of(drawing, arguments.style) : svg_of(drawing, arguments.style));
  return done;
}

}  // namespace

void add_draw(Command& program) {
  const auto arguments = std::make_shared<DrawArguments>();
  Command& command =
      program.command("draw", description_of_companion("draw"),
                      "  fathom draw spot.obj --edges silhouettes -o spot.svg\n"
                      "  fathom draw house.json --camera camera.json -o house.pdf\n"
                      "  fathom draw part.obj --orthographic 4 --view 0,0 --up z -o front.svg");
  arguments->scene.add_to(command);
  arguments->camera.add_to(command);
  command.option("--edges", "KIND", into(arguments->edges.edges, parse_selection),
                 "Draw outlines and crossings of surfaces (silhouettes), also creases (default), "
                 "or all edges");
  command.option("--crease-angle", "DEGREES", into(arguments->edges.crease_angle, parse_angle),
                 "Least angle by which a surface turns at a crease (default 30)");
  command.option("--stroke", "PIXELS", into(arguments->style.stroke, parse_width),
                 "Width of the lines (default 1)");
  add_cull_option(command, arguments->edges.cull);
  add_output_option(command, "FILE", arguments->output,
                    "Write the drawing to this file, .svg or .pdf (default -, SVG on standard "
                    "output)");
  command.runs([arguments](const Console& console) { return run_draw(*arguments, console); });
}

}  // namespace fathom::app
