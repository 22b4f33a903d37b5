#pragma once

#include <vtkSmartPointer.h>

#include <vector>

#include "fathom/attribution/model/renderer_model.h"
#include "fathom/scene/scene.h"
#include "fathom/vtk/explain_depth.h"

class vtkOpenGLPolyDataMapper;
class vtkProp;
class vtkRenderer;

namespace fathom::vtk {

/// The opaque triangles that a renderer shows.
struct DrawnScene {
  /// An object for each actor that is drawn, its mesh in the actor's own frame.
  Scene scene;
  /// For each object, how VTK holds its corners, and the mapper that draws it. Shifts and scales
  /// are known once it has drawn.
  std::vector<attribution::RasterPart> parts;
  std::vector<vtkSmartPointer<vtkOpenGLPolyDataMapper>> mappers;
  /// Visible props that are not in the scene.
  std::vector<LeftOut> left_out;
  std::vector<vtkSmartPointer<vtkProp>> to_hide;
};

/// Updates the mappers' inputs; draws nothing.
DrawnScene drawn_scene(vtkRenderer& renderer);

}  // namespace fathom::vtk
