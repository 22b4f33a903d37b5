#pragma once

#include <vtkSmartPointer.h>

#include <optional>
#include <string>
#include <vector>

#include "fathom/attribution/model/renderer_model.h"
#include "fathom/camera/camera.h"
#include "fathom/scene/scene.h"
#include "fathom/vtk/explain_depth.h"

class vtkOpenGLPolyDataMapper;
class vtkProp;
class vtkRenderer;

namespace fathom::vtk {

/// The renderer's camera, including near and far, from the binary64 matrices that VTK's mappers
/// get.
/// Fails    InputError if no Camera has such matrices, or if the camera is not of VTK's OpenGL.
Camera camera_of(vtkRenderer& renderer);

/// Checks that the camera of VTK's matrices follows from the position, focal point, view up, view
/// angle or parallel scale, window centre, model transform and clipping range of its vtkCamera, up
/// to the roundings of sums in binary64. Returns the difference as a clause, or nothing. Returns
/// nothing if the vtkCamera has a user's view transform, an explicit projection, shear or an
/// off-axis projection, which are matrices themselves.
/// Source   vtkCamera's documentation of these properties.
std::optional<std::string> fault_of_matrices(vtkRenderer& renderer, const Camera& of_matrices);

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
