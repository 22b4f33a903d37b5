#include "validation/opengl/opengl_renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <vector>

#include "fathom/attribution/model/named_models.h"
#include "fathom/attribution/model/renderer_input.h"
#include "fathom/attribution/model/renderer_model.h"
#include "fathom/attribution/model/window_depth.h"
#include "fathom/camera/camera.h"
#include "fathom/failures/errors.h"
#include "fathom/image/depth_map.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "validation/opengl/egl_context.h"
#include "validation/opengl/gl_functions.h"
#include "validation/variants/variants.h"

namespace fathom::validation {
namespace {

/// A mesh in OpenGL: positions in binary32 as in the model, each vertex multiplied by the model's
/// matrix, with the number of the triangle as its colour. It is destroyed with its context.
class DrawnMesh {
 public:
  /// Needs    a model with a matrix.
  /// Fails    InputError if the driver refuses the shaders.
  DrawnMesh(const GlFunctions& gl, const attribution::WorldMesh& mesh,
            const attribution::RasterModel& model);

  /// Clears the framebuffer that is bound and draws the mesh into it.
  void draw(const Camera& camera, const OpenGlVariant& variant) const;

 private:
  const GlFunctions& gl_;
  GLsizei vertex_count_ = 0;
};

using attribution::RasterModel;
using attribution::WorldMesh;

constexpr const char* vertex_shader = R"(#version 330
layout(location = 0) in vec3 position;
layout(location = 1) in uint number;
uniform mat4 clip_from_held;
flat out uint number_of_triangle;
void main() {
  gl_Position = clip_from_held * vec4(position, 1.0);
  number_of_triangle = number;
}
)";
constexpr const char* fragment_shader = R"(#version 330
flat in uint number_of_triangle;
layout(location = 0) out uint triangle;
void main() { triangle = number_of_triangle; }
)";

template <class T>
void hand_over(const GlFunctions& gl, const std::vector<T>& values) {
  GLuint buffer = 0;
  gl.GenBuffers(1, &buffer);
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer);
  gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(values.size() * sizeof(T)), values.data(),
                GL_STATIC_DRAW);
}

/// Passes the corners of the triangles, three for each, to the next draw. Corners are not shared,
/// so that each can have the number of its triangle. Shaders cannot get this number from all
/// drivers: softpipe draws nothing if a shader uses gl_PrimitiveID, and its gl_VertexID restarts
/// within a mesh.
void hand_over(const GlFunctions& gl, const WorldMesh& mesh, const RasterModel& model) {
  std::vector<GLfloat> held;
  std::vector<GLuint> numbers;
  held.reserve(9 * mesh.triangles.size());
  numbers.reserve(3 * mesh.triangles.size());
  for (std::size_t triangle = 0; triangle < mesh.triangles.size(); ++triangle) {
    for (const std::uint32_t corner : mesh.triangles[triangle]) {
      const auto& p = mesh.points[corner];
      for (std::size_t k = 0; k < 3; ++k) {
        held.push_back(static_cast<GLfloat>((p[k] - model.shift[k]) * model.scale[k]));
      }
      numbers.push_back(static_cast<GLuint>(triangle));
    }
  }
  GLuint array = 0;
  gl.GenVertexArrays(1, &array);
  gl.BindVertexArray(array);
  hand_over(gl, held);
  gl.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
  gl.EnableVertexAttribArray(0);
  hand_over(gl, numbers);
  gl.VertexAttribIPointer(1, 1, GL_UNSIGNED_INT, 0, nullptr);
  gl.EnableVertexAttribArray(1);
}

DrawnMesh::DrawnMesh(const GlFunctions& gl, const WorldMesh& mesh, const RasterModel& model)
    : gl_(gl), vertex_count_(static_cast<GLsizei>(3 * mesh.triangles.size())) {
  const GLuint program = use_new_program(gl, vertex_shader, fragment_shader);
  gl.UniformMatrix4fv(gl.GetUniformLocation(program, "clip_from_held"), 1, GL_TRUE,
                      model.matrix->data());
  hand_over(gl, mesh, model);
}

void DrawnMesh::draw(const Camera& camera, const OpenGlVariant& variant) const {
  gl_.Viewport(0, 0, static_cast<GLsizei>(camera.width), static_cast<GLsizei>(camera.height));
  if (variant.reversed) gl_.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  const GLfloat cleared = variant.reversed ? 0.0F : 1.0F;
  const GLuint nothing = no_surface;
  gl_.ClearBufferfv(GL_DEPTH, 0, &cleared);
  gl_.ClearBufferuiv(GL_COLOR, 0, &nothing);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(variant.reversed ? GL_GREATER : GL_LESS);
  if (variant.offset_units == 0) {
    gl_.Disable(GL_POLYGON_OFFSET_FILL);
  } else {
    gl_.Enable(GL_POLYGON_OFFSET_FILL);
    gl_.PolygonOffset(0, static_cast<GLfloat>(variant.offset_units));
  }
  gl_.DrawArrays(GL_TRIANGLES, 0, vertex_count_);
}

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

/// Measures the driver's glPolygonOffset: OpenGL lets the driver choose the size of a unit ([GL46]
/// 14.6.5). The mesh is drawn without and with the offset, and the difference in most pixels is the
/// result.
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

/// The origin of the held positions: the eye, so that nothing is lost near it, or without an eye
/// the middle of the mesh.
std::array<double, 3> held_from(const WorldMesh& mesh, const Camera& camera) {
  if (is_perspective(camera.projection)) return camera_rays(camera).origin.at_corner;
  std::array<double, 3> middle{};
  if (const auto box = box_of(mesh)) {
    for (std::size_t k = 0; k < 3; ++k) middle[k] = box->lower[k] / 2 + box->upper[k] / 2;
  }
  return middle;
}

/// Position within the pixel of the sample that is read back. OpenGL's rows run from the bottom.
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
