#include "validation/vtk/peeling.h"

#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkTextureObject.h>
#include <vtkTranslucentPass.h>

#include "fathom/failures/errors.h"
#include "validation/opengl/gl_functions.h"

namespace fathom::validation {

vtkStandardNewMacro(ReadablePeelingPass);
vtkStandardNewMacro(PeelingRenderer);

/// Before the first layer is peeled, the depths by which it will be recognised lie in a texture.
bool ReadablePeelingPass::SetShaderParameters(vtkShaderProgram* program, vtkAbstractMapper* mapper,
                                              vtkProp* prop, vtkOpenGLVertexArrayObject* array) {
  if (CurrentStage == Peeling && CurrentPeel == 0) read_nearest();
  return Superclass::SetShaderParameters(program, mapper, prop, array);
}

/// VTK keeps (−nearest, farthest) in two components, (−1, −1) or (−1, opaque) where there is none.
void ReadablePeelingPass::read_nearest() {
  const GlFunctions gl;
  const auto width = static_cast<std::size_t>(ViewportWidth);
  const auto height = static_cast<std::size_t>(ViewportHeight);
  std::vector<float> read(2 * width * height);
  GLint before = 0;
  gl.GetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &before);
  GLuint reading = 0;
  gl.GenFramebuffers(1, &reading);
  gl.BindFramebuffer(GL_READ_FRAMEBUFFER, reading);
  gl.FramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                          Textures[DepthSource]->GetHandle(), 0);
  gl.ReadBuffer(GL_COLOR_ATTACHMENT0);
  gl.PixelStorei(GL_PACK_ALIGNMENT, 4);
  gl.ReadPixels(0, 0, ViewportWidth, ViewportHeight, GL_RG, GL_FLOAT, read.data());
  gl.BindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(before));
  gl.DeleteFramebuffers(1, &reading);
  nearest_.resize(width * height);
  for (std::size_t row = 0; row < height; ++row) {  // OpenGL's rows run from the bottom
    for (std::size_t x = 0; x < width; ++x) {
      nearest_[row * width + x] = -read[2 * ((height - 1 - row) * width + x)];
    }
  }
}

PeelingRenderer::PeelingRenderer() {
  vtkNew<vtkTranslucentPass> translucent;
  DepthPeelingPass = ReadablePeelingPass::New();  // the base class deletes it
  DepthPeelingPass->SetTranslucentPass(translucent);
  UseDepthPeelingOn();
  SetMaximumNumberOfPeels(100);
}

const std::vector<float>& PeelingRenderer::nearest_layer() const {
  const auto& nearest = static_cast<const ReadablePeelingPass*>(DepthPeelingPass)->nearest();
  if (LastRenderingUsedDepthPeeling == 0 || nearest.empty()) {
    throw InputError("vtk: drew without depth peeling");
  }
  return nearest;
}

}  // namespace fathom::validation
