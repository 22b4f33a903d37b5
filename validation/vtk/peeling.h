#pragma once

#include <vtkDualDepthPeelingPass.h>
#include <vtkOpenGLRenderer.h>

#include <vector>

namespace fathom::validation {

/// VTK's depth peeling, which also reads out what only its shaders see: how deep the nearest
/// translucent layer lies. VTK itself hands that to nobody: it leaves the depth buffer to what is
/// opaque.
class ReadablePeelingPass : public vtkDualDepthPeelingPass {
 public:
  static ReadablePeelingPass* New();
  // clang-format off
  vtkTypeMacro(ReadablePeelingPass, vtkDualDepthPeelingPass)
      // clang-format on

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
  // clang-format off
  vtkTypeMacro(PeelingRenderer, vtkOpenGLRenderer)
      // clang-format on

      /// Fails    InputError if the last frame was not peeled.
      [[nodiscard]] const std::vector<float>& nearest_layer() const;

 protected:
  PeelingRenderer();
};

}  // namespace fathom::validation
