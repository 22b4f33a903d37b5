#include "fathom/vtk/explain_depth.h"

#include <vtkOpenGLPolyDataMapper.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLVertexBufferObject.h>
#include <vtkOpenGLVertexBufferObjectGroup.h>
#include <vtkProp.h>
#include <vtkRenderer.h>
#include <vtkRendererCollection.h>

#include <limits>
#include <ostream>
#include <utility>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/model/named_models.h"
#include "fathom/attribution/model/window_depth.h"
#include "fathom/attribution/truth.h"
#include "fathom/failures/errors.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/vtk/depth_buffer.h"
#include "fathom/vtk/drawn_scene.h"

namespace fathom::vtk {
namespace {

using attribution::PixelClass;
using attribution::RasterModel;

/// Hides props while it lives.
class Hidden {
 public:
  explicit Hidden(const std::vector<vtkSmartPointer<vtkProp>>& props) : props_(props) {
    for (vtkProp* const prop : props_) prop->VisibilityOff();
  }
  ~Hidden() {
    for (vtkProp* const prop : props_) prop->VisibilityOn();
  }
  Hidden(const Hidden&) = delete;
  Hidden& operator=(const Hidden&) = delete;

 private:
  const std::vector<vtkSmartPointer<vtkProp>>& props_;
};

vtkOpenGLRenderWindow& window_to_judge(vtkRenderWindow& window, vtkRenderer& renderer) {
  auto* const of_opengl = vtkOpenGLRenderWindow::SafeDownCast(&window);
  if (of_opengl == nullptr) {
    throw InputError(
        "the window has no OpenGL: link VTK::RenderingOpenGL2 and call vtk_module_autoinit()");
  }
  if (window.GetRenderers()->IsItemPresent(&renderer) == 0) {
    throw InputError("the renderer is not in the window");
  }
  if (window.GetStereoRender() != 0) throw InputError("the window renders in stereo");
  if (window.GetNumberOfLayers() > 1) {
    throw InputError("the window has " + std::to_string(window.GetNumberOfLayers()) +
                     " layers, and its depth buffer holds only the last one");
  }
  return *of_opengl;
}

WindowPart part_of(vtkRenderer& renderer) {
  WindowPart part;
  renderer.GetTiledSizeAndOrigin(&part.width, &part.height, &part.left, &part.bottom);
  return part;
}

std::string list_of(const std::vector<LeftOut>& left_out) {
  std::string list;
  for (const LeftOut& one : left_out) list += (list.empty() ? "" : "; ") + one.prop + " " + one.why;
  return list;
}

/// How each mapper passed coordinates to OpenGL in the frame before.
void set_shifts(DrawnScene& drawn) {
  for (std::size_t i = 0; i < drawn.parts.size(); ++i) {
    vtkOpenGLVertexBufferObject* const held = drawn.mappers[i]->GetVBOs()->GetVBO("vertexMC");
    if (held == nullptr || !held->GetCoordShiftAndScaleEnabled()) continue;
    for (std::size_t k = 0; k < 3; ++k) drawn.parts[i].shift[k] = held->GetShift().at(k);
  }
}

RasterModel raster_model(DrawnScene& drawn, const DepthBuffer& buffer) {
  RasterModel model;
  model.parts = std::move(drawn.parts);
  model.storage = buffer.storage;
  return model;
}

attribution::OtherMap map_of(const DepthBuffer& buffer, const Camera& camera) {
  attribution::OtherMap map{
      .width = camera.width, .height = camera.height, .windows = buffer.windows};
  const attribution::WindowDepth window =
      attribution::window_depth(camera.projection.model, Mapping::opengl, camera.near, camera.far);
  for (const double z : map.windows) {
    map.depths.push_back(z == 1 ? std::numeric_limits<double>::infinity() : window.to_depth(z));
  }
  return map;
}

std::string cause_of(const DepthVerdict& verdict, vtkRenderer& renderer) {
  if (const auto fault = fault_of_matrices(renderer, verdict.truth.camera)) {
    return "camera: its matrices do not follow from its description: " + *fault;
  }
  return attribution::cause_of(verdict.truth, verdict.map, verdict.attribution);
}

}  // namespace

DepthVerdict explain_depth(vtkRenderWindow& any_window, vtkRenderer& renderer) {
  const StandardArithmetic standard;
  vtkOpenGLRenderWindow& window = window_to_judge(any_window, renderer);
  // A renderer without a camera makes a camera that sees all props, including props that will be
  // hidden.
  if (renderer.IsActiveCameraCreated() == 0) renderer.ResetCamera();
  DrawnScene drawn = drawn_scene(renderer);
  if (drawn.scene.objects.empty()) {
    throw InputError("the renderer shows no opaque triangles" +
                     (drawn.left_out.empty() ? "" : ": " + list_of(drawn.left_out)));
  }
  DepthBuffer buffer;
  {
    const Hidden hidden(drawn.to_hide);
    window.Render();
    buffer = read_depth_buffer(window, part_of(renderer));
  }
  set_shifts(drawn);

  const Camera camera = camera_of(renderer);
  DepthVerdict verdict;
  verdict.left_out = std::move(drawn.left_out);
  verdict.truth = attribution::make_truth(drawn.scene, camera);
  verdict.truth.corner_numbers = attribution::corner_numbers(drawn.parts);
  verdict.model.name = "VTK on " + buffer.renderer;
  verdict.model.sample = buffer.sample;
  verdict.map = map_of(buffer, camera);
  verdict.model.kind = raster_model(drawn, buffer);
  attribution::set_driver_facts(buffer.renderer, buffer.subpixel_bits, camera, verdict.model);
  verdict.attribution = attribution::attribute_and_name(verdict.truth, verdict.map, verdict.model);
  verdict.cause = cause_of(verdict, renderer);
  return verdict;
}

std::ostream& operator<<(std::ostream& out, const DepthVerdict& verdict) {
  out << (verdict.is_good() ? "every pixel is explained" : verdict.cause) << '\n';
  for (std::size_t i = 0; i < attribution::pixel_class_count; ++i) {
    const std::uint64_t count = verdict.attribution.counts[i];
    if (count > 0) out << count << ' ' << name_of(static_cast<PixelClass>(i)) << '\n';
  }
  for (const LeftOut& one : verdict.left_out) {
    out << "left out: " << one.prop << ' ' << one.why << '\n';
  }
  return out;
}

}  // namespace fathom::vtk
