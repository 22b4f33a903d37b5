#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkLight.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLHelper.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkShader.h>
#include <vtkShaderProgram.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVersion.h>

#include <string>
#include <vector>

#include "fathom/attribution/model/renderer_input.h"
#include "fathom/failures/errors.h"
#include "validation/opengl/egl_context.h"
#include "validation/vtk/drawn_by_vtk.h"
#include "validation/vtk/surfaceless_window.h"
#include "validation/vtk/vtk_renderer.h"

namespace fathom::validation {
namespace {

/// VTK's mapper, which shows the text of the shader that it made.
class ReadableMapper : public vtkOpenGLPolyDataMapper {
 public:
  static ReadableMapper* New();
  vtkTypeMacro(ReadableMapper, vtkOpenGLPolyDataMapper)

  [[nodiscard]] const std::string& fragment_shader() const { return text_; }

 protected:
  void SetCameraShaderParameters(vtkOpenGLHelper& drawn, vtkRenderer* renderer,
                                 vtkActor* actor) override {
    Superclass::SetCameraShaderParameters(drawn, renderer, actor);
    text_ = drawn.Program->GetFragmentShader()->GetSource();
  }

 private:
  std::string text_;
};
vtkStandardNewMacro(ReadableMapper);

vtkSmartPointer<vtkPolyData> polygons_of(const LitScene& scene) {
  vtkNew<vtkPoints> points;  // binary32
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents(3);
  vtkNew<vtkCellArray> cells;
  vtkIdType next = 0;
  for (const LitTriangle& t : scene.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      points->InsertNextPoint(t.corners[k].data());
      normals->InsertNextTuple(t.normals[k].data());
    }
    const vtkIdType corners[3] = {next, next + 1, next + 2};
    cells->InsertNextCell(3, corners);
    next += 3;
  }
  auto polygons = vtkSmartPointer<vtkPolyData>::New();
  polygons->SetPoints(points);
  polygons->SetPolys(cells);
  polygons->GetPointData()->SetNormals(normals);
  return polygons;
}

void set_camera(vtkCamera& camera, const Camera& ours) {
  camera.SetPosition(0, 0, 0);
  camera.SetFocalPoint(0, 0, -1);
  camera.SetViewUp(0, 1, 0);
  camera.SetModelTransformMatrix(attribution::eye_from_world(ours).data());
  vtkNew<vtkMatrix4x4> projection;
  projection->DeepCopy(attribution::clip_from_eye(ours, {ours.near, ours.far}).data());
  camera.SetExplicitProjectionTransformMatrix(projection);
  camera.UseExplicitProjectionTransformMatrixOn();
  camera.SetClippingRange(ours.near, ours.far);
}

void set_material(vtkProperty& property, const pipeline::Material& material, VtkShading shading) {
  property.SetInterpolation(shading == VtkShading::flat      ? VTK_FLAT
                            : shading == VtkShading::gouraud ? VTK_GOURAUD
                                                             : VTK_PHONG);
  property.SetColor(1, 1, 1);
  property.SetAmbient(material.ambient);
  property.SetDiffuse(material.diffuse);
  property.SetSpecular(material.specular);
  property.SetSpecularPower(material.shininess);
}

/// The bounds in expected_colour.h are of these lines.
void require_lines(const std::string& shader, VtkShading shading) {
  std::vector<std::string> lines{"df = max(0.0, dot(normalVCVSOutput, -lightDirectionVC0))",
                                 "sf = sign(df)*pow(max(0.0, dot( reflect(lightDirectionVC0, "
                                 "normalVCVSOutput), normalize(-vertexVC.xyz))",
                                 "specularPower)", "ambientColor + diffuse + specular"};
  if (shading == VtkShading::flat) {
    lines.emplace_back("normalize(cross(fdx,fdy))");
  } else {
    lines.emplace_back("vec3 normalVCVSOutput = normalize(normalVCVSOutput);");
    lines.emplace_back("if (gl_FrontFacing == false) { normalVCVSOutput = -normalVCVSOutput; }");
  }
  for (const std::string& line : lines)
    if (shader.find(line) == std::string::npos)
      throw InputError("this VTK lights in another way: its shader lacks '" + line + "'");
}

}  // namespace

GreyPicture draw_vtk_colours(const LitScene& scene, VtkShading shading) {
  const EglContext context;  // outlives the window
  vtkNew<SurfacelessWindow> window;
  vtkNew<ReadableMapper> mapper;
  mapper->SetInputData(polygons_of(scene));
  mapper->ScalarVisibilityOff();
  mapper->SetVBOShiftScaleMethod(0);  // positions as they are
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  set_material(*actor->GetProperty(), scene.material, shading);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  renderer->AutomaticLightCreationOff();
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  light->PositionalOff();
  const auto& [x, y, z] = scene.towards_light;
  light->SetPosition(x, y, z);
  light->SetFocalPoint(0, 0, 0);
  light->SetColor(1, 1, 1);
  light->SetIntensity(1);
  renderer->AddLight(light);
  renderer->SetBackground(0, 0, 0);
  set_camera(*renderer->GetActiveCamera(), scene.camera);

  const auto width = static_cast<int>(scene.camera.width),
             height = static_cast<int>(scene.camera.height);
  window->SetSize(width, height);
  window->AddRenderer(renderer);
  window->SetMultiSamples(0);
  window->Render();
  window->WaitForCompletion();
  require_lines(mapper->fragment_shader(), shading);

  vtkNew<vtkUnsignedCharArray> read;
  window->GetPixelData(0, 0, width - 1, height - 1, 0, read.Get(), 0);
  GreyPicture picture{scene.camera.width, scene.camera.height, {}, {}};
  picture.codes.reserve(std::size_t{scene.camera.width} * scene.camera.height);
  for (int row = height - 1; row >= 0; --row) {  // OpenGL's rows run from the bottom
    for (int column = 0; column < width; ++column) {
      const unsigned char* c = read->GetPointer(3 * (vtkIdType{row} * width + column));
      if (c[0] != c[1] || c[1] != c[2]) throw InputError("VTK drew a colour where all is grey");
      picture.codes.push_back(c[0]);
    }
  }
  picture.version =
      std::string("VTK ") + vtkVersion::GetVTKVersion() + " on " + context.description();
  window->Finalize();
  return picture;
}

}  // namespace fathom::validation
