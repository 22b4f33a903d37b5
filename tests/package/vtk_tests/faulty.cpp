#include <fathom/vtk/explain_depth.h>
#include <vtkActor.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLCamera.h>
#include <vtkOpenGLHelper.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkShaderProgram.h>
#include <vtkSphereSource.h>

#include <cstdlib>
#include <iostream>

/// Passes a matrix to OpenGL that makes the picture wider by a thousandth.
class FaultyMapper : public vtkOpenGLPolyDataMapper {
 public:
  static FaultyMapper* New();
  vtkTypeMacro(FaultyMapper, vtkOpenGLPolyDataMapper);

 protected:
  void SetCameraShaderParameters(vtkOpenGLHelper& drawn, vtkRenderer* renderer,
                                 vtkActor* actor) override {
    Superclass::SetCameraShaderParameters(drawn, renderer, actor);
    vtkMatrix4x4 *view, *projection, *both;
    vtkMatrix3x3* normals;
    vtkOpenGLCamera::SafeDownCast(renderer->GetActiveCamera())
        ->GetKeyMatrices(renderer, view, normals, projection, both);
    vtkNew<vtkMatrix4x4> wrong;
    wrong->DeepCopy(both);
    for (int i = 0; i < 4; ++i) wrong->SetElement(i, 0, 1.001 * wrong->GetElement(i, 0));
    drawn.Program->SetUniformMatrix("MCDCMatrix", wrong);
  }
};
vtkStandardNewMacro(FaultyMapper);

int main() {
  vtkNew<vtkSphereSource> sphere;
  vtkNew<FaultyMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  vtkNew<vtkRenderWindow> window;
  window->AddRenderer(renderer);
  const fathom::vtk::DepthVerdict verdict = fathom::vtk::explain_depth(*window, *renderer);
  std::cout << verdict;
  return verdict.is_good() ? EXIT_SUCCESS : EXIT_FAILURE;
}
