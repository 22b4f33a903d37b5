#include <cmath>
#include <cstdint>
#include <limits>

#include "fathom/attribution/model/named_models.h"
#include "fathom/attribution/model/window_depth.h"
#include "fathom/attribution/raster/clip_vertex.h"
#include "fathom/failures/errors.h"
#include "fathom/image/depth_map.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "validation/vtk/drawn_by_vtk.h"
#include "validation/vtk/vtk_renderer.h"

namespace fathom::validation {
namespace {

using attribution::RasterModel;
using attribution::window_depth;
using attribution::WindowDepth;
using attribution::WorldMesh;
using attribution::written_depth;

VtkOptions options_of(const VtkVariant& variant, const Camera& camera) {
  VtkOptions options{.depth = variant.attachment,
                     .samples = variant.samples,
                     .mesh = variant.mesh,
                     .driver = variant.driver,
                     .numbers = true};
  const auto write = [&](Mapping mapping) {
    options.written = written_depth(camera.projection.model, mapping, camera.near, camera.far);
  };
  switch (variant.encoding) {
    case VtkVariant::Encoding::interpolated:
      break;
    case VtkVariant::Encoding::reversed:
      options.reversed = true;
      break;
    case VtkVariant::Encoding::reversed_by_shader:
      write(Mapping::reversed);
      break;
    case VtkVariant::Encoding::logarithmic:
      write(Mapping::log_ulrich);
      break;
  }
  return options;
}

/// A depth buffer shows nothing where it holds the value that it was cleared to, though a surface
/// at the far plane may have been drawn there: GL_LEQUAL lets it pass. The map says what the depth
/// buffer does.
/// Fails    InputError where a colour is that of no triangle, or a depth has none: another colour
///          than ours was drawn.
void hold_against_depths(attribution::OtherMap& map, std::size_t triangle_count) {
  for (std::size_t i = 0; i < map.triangles.size(); ++i) {
    std::uint32_t& triangle = map.triangles[i];
    const bool shows_a_surface = std::isfinite(map.depths[i]);
    if (triangle != no_surface ? triangle >= triangle_count : shows_a_surface) {
      throw InputError("vtk: drew a depth in a colour that is the number of no triangle");
    }
    if (!shows_a_surface) triangle = no_surface;
  }
}

}  // namespace

using attribution::ClipRow;
using attribution::RasterModel;

bool is_matrix_of(const Camera& camera, const RasterModel& model,
                  const std::array<float, 16>& clip_from_held) {
  RasterModel factors = model;
  factors.premultiplied = false;  // magnitudes are then sums of absolute products
  const std::array<ClipRow, 4> rows = rows_of_camera(camera, factors);
  // Ours loses less than 2⁻⁴⁶ of the terms in binary64, and so does a renderer's, in fewer than 2⁷
  // roundings.
  const double lost = std::ldexp(1, -45);
  for (std::size_t r = 0; r < 4; ++r) {
    for (std::size_t k = 0; k < 4; ++k) {
      const double scale = k < 3 ? model.scale[k] : 1;
      const double terms = rows[r].loss[k] + rows[r].magnitude[k];
      const double exact = rows[r].row[k] / scale;
      const double bound = unit_roundoff<float> * std::abs(exact) + lost * terms / std::abs(scale);
      if (!(std::abs(clip_from_held[4 * r + k] - exact) <= bound)) return false;
    }
  }
  return true;
}

DrawnMap draw_vtk(const WorldMesh& mesh, const Camera& camera, const VtkVariant& variant) {
  const VtkOptions options = options_of(variant, camera);
  VtkRenderer renderer(mesh, camera, {camera.near, camera.far}, options);
  renderer.draw();
  const VtkDrawing drawing = renderer.drawing();

  DrawnMap drawn{.version = renderer.description()};
  drawn.model.name = "VTK";
  drawn.model.equal_depths = drawing.equal_depths;
  RasterModel model;
  model.mapping = options.reversed ? Mapping::reversed : Mapping::opengl;
  model.written = options.written;
  model.storage = drawing.storage;
  model.shift = drawing.shift;
  model.scale = drawing.scale;
  if (!is_matrix_of(camera, model, drawing.clip_from_held)) {
    throw InputError("vtk: passed a matrix to OpenGL that is not the camera's");
  }
  model.matrix = drawing.clip_from_held;
  if (options.samples > 0) {
    drawn.version += ", " + std::to_string(drawing.samples) + " samples granted";
    drawn.model.sample = {drawing.sample[0], drawing.sample[1]};
  }
  drawn.model.kind = model;
  attribution::set_driver_facts(drawn.version, drawing.subpixel_bits, camera, drawn.model);
  drawn.map = {.width = camera.width, .height = camera.height, .windows = drawing.windows};
  const WindowDepth window =
      window_depth(camera.projection.model, model.stored_mapping(), camera.near, camera.far);
  const double cleared = window.reversed() ? 0 : 1;
  for (const double z : drawn.map.windows) {
    drawn.map.depths.push_back(z == cleared ? std::numeric_limits<double>::infinity()
                                            : window.to_depth(z));
  }
  drawn.map.triangles = drawing.triangles;
  hold_against_depths(drawn.map, mesh.triangles.size());
  return drawn;
}

}  // namespace fathom::validation
