#pragma once

#include <vtkActor.h>
#include <vtkDualDepthPeelingPass.h>
#include <vtkOpenGLRenderer.h>
#include <vtkSmartPointer.h>

#include <vector>

#include "fathom/camera/camera.h"

namespace fathom::validation {

/// VTK's depth peeling, which also reads out what only its shaders see: how deep the nearest
/// translucent layer lies. VTK itself hands that to nobody: it leaves the depth buffer to what is
/// opaque.
class ReadablePeelingPass : public vtkDualDepthPeelingPass {
 public:
  static ReadablePeelingPass* New();
  vtkTypeMacro(ReadablePeelingPass, vtkDualDepthPeelingPass)

  bool SetShaderParameters(vtkShaderProgram* program, vtkAbstractMapper* mapper, vtkProp* prop,
                           vtkOpenGLVertexArrayObject* array) override;

  /// Window depths of the nearest layer of the last frame in binary32, width × height, rows from
  /// the top; 1 where there is none that is not behind something opaque. Empty if nothing was
  /// peeled.
  [[nodiscard]] const std::vector<float>& nearest() const { return nearest_; }

 private:
  void read_nearest();

  std::vector<float> nearest_;
};

/// VTK's renderer, peeling with a pass that can be read.
class PeelingRenderer : public vtkOpenGLRenderer {
 public:
  static PeelingRenderer* New();
  vtkTypeMacro(PeelingRenderer, vtkOpenGLRenderer)

  /// Fails    InputError if the last frame was not peeled.
  [[nodiscard]] const std::vector<float>& nearest_layer() const;

 protected:
  PeelingRenderer();
};

/// A translucent pane across the whole view, a thousandth of the way from near to far: in front of
/// all but what nearly touches the near plane.
vtkSmartPointer<vtkActor> translucent_pane(const Camera& camera);

}  // namespace fathom::validation
