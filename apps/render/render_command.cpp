#include "apps/render/render_command.h"

#include <memory>

namespace fathom::app {

void add_render(Command& program, const Render& by_exact_engine, const Render& by_pipeline) {
  const auto arguments = std::make_shared<RenderArguments>();
  Command& command = program.command(
      "render", "Render an exact depth map of a scene",
      "  fathom render spot.obj -o spot.exr\n"
      "  fathom render room.json --camera camera.json --channels Z,id,N -o room.exr\n"
      "  fathom render spot.obj --view 90,0 --size 640x480 --save-camera side.json -o side.pfm\n"
      "  fathom render spot.obj -o spot.png --png-scale 1000      # 16 bits: 1000 codes per scene "
      "unit\n"
      "  fathom render spot.obj --channels Z,id,N --background 0 -o maps/spot.npz\n"
      "  fathom render city.stl --stream --size 16384x16384 -o city.exr\n"
      "  fathom render scan.ply --engine fast --verify 1000 -o scan.exr\n"
      "  fathom render room.json --deep -o room.deep.exr\n"
      "  fathom render spot.obj --camera path.json -o 'view-{index:04}.exr'\n"
      "  fathom render spot.obj --near 0.1 --far 100 --depth-format unorm16 --against-exact -o "
      "stored.exr\n"
      "  fathom render spot.obj --engine pipeline --shading phong --antialias msaa:4 --image "
      "spot.png "
      "-o spot.exr\n"
      "\nKeys of camera and scene files, and warnings: camera-files.md and scene-files.md in the "
      "documentation.");
  arguments->add_to(command);
  command.runs([arguments, by_exact_engine, by_pipeline](const Console& console) {
    return arguments->engine == EngineName::pipeline ? by_pipeline(*arguments, console)
                                                     : by_exact_engine(*arguments, console);
  });
}

}  // namespace fathom::app
