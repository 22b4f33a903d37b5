#include "validation/vtk/peeling.h"

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkTextureObject.h>
#include <vtkTranslucentPass.h>

#include <array>

#include "fathom/attribution/model/renderer_input.h"
#include "fathom/failures/errors.h"
#include "validation/opengl/gl_functions.h"

namespace fathom::validation {
namespace {

using attribution::CameraRays;

std::array<double, 3> shown_at(const CameraRays& rays, double u, double v, double depth) {
  const auto value = [&](const CameraRays::Affine& f, std::size_t k) {
    return f.at_corner[k] + u * f.per_u[k] + v * f.per_v[k];
  };
  std::array<double, 3> point{};
  for (std::size_t k = 0; k < 3; ++k) {
    point[k] = value(rays.origin, k) + depth * value(rays.direction, k);
  }
  return point;
}

}  // namespace

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

vtkSmartPointer<vtkActor> translucent_pane(const Camera& camera) {
  const CameraRays rays = attribution::camera_rays(camera);
  const double depth = camera.near + (camera.far - camera.near) / 1000;
  const double right = camera.width + 1.0, lower = camera.height + 1.0;  // one pixel more all round
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const auto& [u, v] :
       {std::array{-1.0, -1.0}, {right, -1.0}, {right, lower}, {-1.0, lower}}) {
    points->InsertNextPoint(shown_at(rays, u, v, depth).data());
  }
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell({0, 1, 2, 3});
  vtkNew<vtkPolyData> polygons;
  polygons->SetPoints(points);
  polygons->SetPolys(cells);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(polygons);
  auto pane = vtkSmartPointer<vtkActor>::New();
  pane->SetMapper(mapper);
  pane->GetProperty()->LightingOff();
  pane->GetProperty()->SetOpacity(0.5);
  return pane;
}

}  // namespace fathom::validation
