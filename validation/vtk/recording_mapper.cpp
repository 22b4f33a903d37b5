#include "validation/vtk/recording_mapper.h"

#include <vtkObjectFactory.h>
#include <vtkOpenGLHelper.h>
#include <vtkOpenGLVertexBufferObject.h>
#include <vtkOpenGLVertexBufferObjectGroup.h>
#include <vtkShaderProgram.h>

#include "validation/opengl/gl_functions.h"
#include "validation/vtk/triangle_numbers.h"

namespace fathom::validation {

vtkStandardNewMacro(RecordingMapper);

namespace {

std::optional<EqualDepths> equal_depths_of(GLenum depth_test) {
  switch (depth_test) {
    case GL_LESS:
    case GL_GREATER:
      return EqualDepths::first_wins;
    case GL_LEQUAL:
    case GL_GEQUAL:
      return EqualDepths::last_wins;
    default:
      return std::nullopt;
  }
}

}  // namespace

void RecordingMapper::SetCameraShaderParameters(vtkOpenGLHelper& drawn, vtkRenderer* renderer,
                                                vtkActor* actor) {
  Superclass::SetCameraShaderParameters(drawn, renderer, actor);
  const GlFunctions gl;
  const auto program = static_cast<GLuint>(drawn.Program->GetHandle());
  const GLint place = gl.GetUniformLocation(program, "MCDCMatrix");
  if (place < 0) return;
  std::array<float, 16> columns{};
  gl.GetUniformfv(program, place, columns.data());
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      clip_from_held_[4 * row + column] = columns[4 * column + row];
    }
  }
  vtkOpenGLVertexBufferObject* const held = VBOs->GetVBO("vertexMC");
  if (held == nullptr || !held->GetCoordShiftAndScaleEnabled()) return;
  for (std::size_t k = 0; k < 3; ++k) {
    shift_[k] = held->GetShift().at(k);
    scale_[k] = held->GetScale().at(k);
  }
}

void RecordingMapper::RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor) {
  if (greater_is_nearer_) {
    draw_reversed(renderer, actor);
  } else {
    draw(renderer, actor);
  }
  if (width_ != 0) numbers_ = read_triangle_numbers(GlFunctions(), width_, height_);
}

void RecordingMapper::draw(vtkRenderer* renderer, vtkActor* actor) {
  GLint test = 0;
  GlFunctions().GetIntegerv(GL_DEPTH_FUNC, &test);
  equal_depths_ = equal_depths_of(static_cast<GLenum>(test));
  Superclass::RenderPieceDraw(renderer, actor);
}

/// VTK has cleared to far = 1 and will test for the less: for this one actor both are turned, and
/// put back as VTK believes them to be.
void RecordingMapper::draw_reversed(vtkRenderer* renderer, vtkActor* actor) {
  const GlFunctions gl;
  const GLfloat far = 0;
  gl.ClearBufferfv(GL_DEPTH, 0, &far);
  gl.DepthFunc(GL_GEQUAL);
  if (zero_to_one_) gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  draw(renderer, actor);
  if (zero_to_one_) gl.ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  gl.DepthFunc(GL_LEQUAL);
}

}  // namespace fathom::validation
