#include "apps/validate/validate_arguments.h"

#include <algorithm>

namespace fathom::app {

void ValidateArguments::add_to(Command& command) {
  command.arguments("SCENE", scenes, "Meshes and scene files");
  command.option(
      "--against", "NAME", against,
      "Renderers that draw the scenes: vtk, opengl, embree, blender; vtk and opengl also "
      "with a driver: opengl@softpipe, vtk@llvmpipe");
  command.flag("--colour", colour,
               "Compare the pipeline's flat, Gouraud and Phong pictures with VTK's");
  command.flag(
      "--faults", faults,
      "Make the maps of the renderers wrong in every way of the catalogue, and see what is "
      "found");
  command.option("--scene", "NAME", scene_names,
                 "Scenes of ours instead of SCENE (default: all, see below)");
  command.option("--variants", "NAME", variants,
                 "Only these variants of the renderers: unorm24, robust, … (default: all)");
  limits.add_to(command);
  command.option("--size", "WxH", into(size, parse_size),
                 "Image size without --camera (default 320x240)");
  command.option("--time-limit", "SECONDS", into(seconds, parse_positive),
                 "Seconds after which a renderer is ended (default 300)");
  command.option("--render", "NAME", render, "Only draw, with this renderer");
  command.option("-o", "MAP", output, "Where --render puts its map");
  command.option("--map", "MAP", map, "The map of another renderer (EXR, PFM, PNG, NPY, NPZ)");
  command.option("--channel", "NAME", channel, "Its channel of depths (default: detected)");
  command.option("--png-scale", "N", into(png_scale, parse_scale),
                 "Codes per unit of a map of integers that does not say it itself");
  command.option("--camera", "FILE", camera, "Camera file");
  command.option(
      "--model", "NAME", model,
      "What is assumed of the renderer; auto: what fits best. With --against, their maps are "
      "judged as maps that someone brings, in binary32; matching: each by the model of "
      "its variant");
  command.option(
      "--out", "DIR", out,
      "Folder for report.json and report.html; with --colour, colours.json and pictures");
  command.option("--baseline", "REPORT", baseline,
                 "An earlier report.json: says what changed, exit status 1 if something got worse; "
                 "with --out also comparison.html");
  command.option("--junit", "FILE", junit, "Also a JUnit XML file, as CI services read it");
  command.flag("--ctest", for_ctest,
               "Of --map: the cause in the first line, measurements and pictures for CTest and "
               "CDash; see fathom_add_depth_test in docs/validation.md");
}

int ValidateArguments::time_limit() const {
  return static_cast<int>(std::min(seconds, 86400U));
}

}  // namespace fathom::app
