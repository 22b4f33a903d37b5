#include "validation/vtk/vtk_depth_maps.h"

#include <limits>

#include "validation/opengl/opengl_renderer.h"
#include "validation/vtk/vtk_renderer.h"

namespace fathom::validation {

DrawnMap draw_vtk(const WorldMesh& mesh, const Camera& camera, const std::string& variant) {
  VtkOptions options;
  if (variant == "own 8 samples") {
    options.samples = 8;
  } else if (variant != "own") {
    options.depth = storage_named(variant);
  }
  VtkRenderer renderer(mesh, camera, {camera.near, camera.far}, options);
  renderer.draw();
  const VtkDrawing drawing = renderer.drawing();

  DrawnMap drawn{.version = renderer.description()};
  RendererModel& model = drawn.model;
  model.name = "VTK";
  model.mapping = Mapping::opengl;
  model.storage = drawing.storage;
  model.matrix = drawing.clip_from_held;
  model.shift = drawing.shift;
  model.scale = drawing.scale;
  model.subpixel_bits = drawing.subpixel_bits;
  model.depth_before_snap = interpolates_before_snapping(drawn.version);
  if (options.samples > 0) {
    drawn.version += ", " + std::to_string(drawing.samples) + " samples granted";
    model.sample = drawing.sample;
  }
  drawn.map = {.width = camera.width, .height = camera.height, .windows = drawing.windows};
  const WindowDepth window =
      window_depth(camera.projection, model.mapping, camera.near, camera.far);
  for (const double z : drawn.map.windows) {
    drawn.map.depths.push_back(z == 1 ? std::numeric_limits<double>::infinity()
                                      : window.to_depth(z));
  }
  return drawn;
}

}  // namespace fathom::validation
