#include "validation/opengl/opengl_renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>

#include "fathom/attribution/model/named_models.h"
#include "fathom/attribution/model/renderer_camera.h"
#include "fathom/attribution/model/window_depth.h"
#include "fathom/failures/errors.h"
#include "fathom/numeric/unit_roundoff.h"
#include "validation/opengl/drawn_mesh.h"
#include "validation/opengl/egl_context.h"
#include "validation/opengl/framebuffer.h"
#include "validation/opengl/gl_functions.h"

namespace fathom::validation {
namespace {

using attribution::camera_rays;
using attribution::clip_from_held;
using attribution::OtherMap;
using attribution::RasterModel;
using attribution::SamplePosition;
using attribution::window_depth;
using attribution::WindowDepth;
using attribution::WorldMesh;

OtherMap read_back(const GlFunctions& gl, const Camera& camera, const RasterModel& model) {
  OtherMap map{.width = camera.width, .height = camera.height};
  map.windows = read_window_depths(gl, camera.width, camera.height, model.storage);
  map.triangles = read_numbers(gl, camera.width, camera.height);
  const WindowDepth window =
      window_depth(camera.projection.model, model.mapping, camera.near, camera.far);
  for (std::size_t i = 0; i < map.windows.size(); ++i) {
    map.depths.push_back(map.triangles[i] == no_surface
                             ? std::numeric_limits<double>::infinity()
                             : window.to_depth(map.windows[i] - model.bias));
  }
  return map;
}

/// What the driver makes of glPolygonOffset: OpenGL leaves to it how much a unit is
/// ([GL46] 14.6.5). The mesh is drawn without and with it; where most pixels agree on the
/// difference, that is it.
void measure_offset(const GlFunctions& gl, const DrawnMesh& mesh, const Camera& camera,
                    const OpenGlVariant& variant, RasterModel& model) {
  const auto windows = [&](int units) {
    OpenGlVariant with = variant;
    with.offset_units = units;
    mesh.draw(camera, with);
    return read_window_depths(gl, camera.width, camera.height, model.storage);
  };
  const std::vector<double> without = windows(0), with = windows(variant.offset_units);
  std::vector<double> differences;
  for (std::size_t i = 0; i < with.size(); ++i) {
    if (with[i] < 1 && without[i] < 1) differences.push_back(with[i] - without[i]);
  }
  if (differences.empty()) return;
  const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
  std::nth_element(differences.begin(), middle, differences.end());
  model.bias = *middle;
  model.bias_error = 2 * unit_roundoff<float>;  // added in binary32, and stored
}

/// Where positions are held from: the eye, so that nothing is lost near it, or where there is none,
/// the middle of the mesh.
std::array<double, 3> held_from(const WorldMesh& mesh, const Camera& camera) {
  if (is_perspective(camera.projection)) return camera_rays(camera).origin.at_corner;
  std::array<double, 3> middle{};
  if (const auto box = box_of(mesh)) {
    for (std::size_t k = 0; k < 3; ++k) middle[k] = box->lower[k] / 2 + box->upper[k] / 2;
  }
  return middle;
}

/// Where in the pixel the sample lies that is read back; OpenGL's rows run from the bottom.
SamplePosition sample_position(const GlFunctions& gl) {
  std::array<GLfloat, 2> position{};
  gl.GetMultisamplefv(GL_SAMPLE_POSITION, 0, position.data());
  return {position[0], 1.0 - position[1]};
}

std::string version_of(const GlFunctions& gl) {
  const auto text = [&](GLenum name) {
    const auto* value = reinterpret_cast<const char*>(gl.GetString(name));
    return std::string(value != nullptr ? value : "unknown");
  };
  return text(GL_VENDOR) + ", " + text(GL_RENDERER) + ", " + text(GL_VERSION);
}

}  // namespace

DrawnMap draw_opengl(const WorldMesh& mesh, const Camera& camera, const OpenGlVariant& variant) {
  const EglContext context(variant.driver);
  const GlFunctions gl;
  DrawnMap drawn;
  drawn.version = version_of(gl) + context.way();
  RasterModel model;
  model.mapping = variant.reversed ? Mapping::reversed : Mapping::opengl;
  model.shift = held_from(mesh, camera);
  model.matrix = clip_from_held(camera, model);

  const Framebuffer framebuffer(gl, camera, variant.storage, variant.samples);
  model.storage = depth_attachment_storage(gl, GL_FRAMEBUFFER);
  GLint subpixel_bits = 0;
  gl.GetIntegerv(GL_SUBPIXEL_BITS, &subpixel_bits);
  const DrawnMesh drawn_mesh(gl, mesh, model);
  if (variant.offset_units != 0) {
    measure_offset(gl, drawn_mesh, camera, variant, model);
    drawn.version +=
        fmt::format(", an offset of {} units is {:.6g}", variant.offset_units, model.bias);
  }
  drawn_mesh.draw(camera, variant);
  if (variant.samples > 1) {
    drawn.version += ", " + std::to_string(framebuffer.granted_samples()) + " samples granted";
    drawn.model.sample = sample_position(gl);
    const Framebuffer resolved(gl, camera, variant.storage, 1);
    resolve(gl, framebuffer, resolved, camera);
  }
  drawn.map = read_back(gl, camera, model);
  drawn.model.name = "OpenGL";
  drawn.model.equal_depths = EqualDepths::first_wins;  // GL_LESS, GL_GREATER
  drawn.model.kind = model;
  attribution::set_driver_facts(drawn.version, subpixel_bits, camera, drawn.model);
  if (gl.GetError() != GL_NO_ERROR) throw InputError("OpenGL: the driver reports an error");
  return drawn;
}

std::vector<int> offered_samples(Driver driver) {
  const EglContext context(driver);
  const GlFunctions gl;
  const auto offered = [&](GLenum format) {
    GLint count = 0;
    gl.GetInternalformativ(GL_RENDERBUFFER, format, GL_NUM_SAMPLE_COUNTS, 1, &count);
    std::vector<GLint> counts(static_cast<std::size_t>(count));
    gl.GetInternalformativ(GL_RENDERBUFFER, format, GL_SAMPLES, count, counts.data());
    std::sort(counts.begin(), counts.end());
    return counts;
  };
  const std::vector<GLint> depths = offered(GL_DEPTH_COMPONENT24), numbers = offered(GL_R32UI);
  std::vector<int> both;
  std::set_intersection(depths.begin(), depths.end(), numbers.begin(), numbers.end(),
                        std::back_inserter(both));
  both.erase(both.begin(), std::upper_bound(both.begin(), both.end(), 1));
  return both;
}

}  // namespace fathom::validation
