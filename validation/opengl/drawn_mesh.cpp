#include "validation/opengl/drawn_mesh.h"

#include <vector>

#include "fathom/image/depth_map.h"
#include "validation/opengl/gl_functions.h"

namespace fathom::validation {
namespace {

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

/// The corners of the triangles, three for each, as what the next draw takes. Corners are not
/// shared, so that each can hold the number of its triangle. Drivers do not all know it: where a
/// shader asks for gl_PrimitiveID, softpipe draws nothing, and its gl_VertexID starts anew within a
/// mesh.
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

}  // namespace

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

}  // namespace fathom::validation
