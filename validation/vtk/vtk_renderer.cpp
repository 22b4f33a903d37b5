#include "validation/vtk/vtk_renderer.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkShaderProperty.h>
#include <vtkSmartPointer.h>
#include <vtkTextureObject.h>
#include <vtkUniforms.h>
#include <vtkVersion.h>

#include <algorithm>

#include "fathom/failures/errors.h"
#include "validation/opengl/egl_context.h"
#include "validation/opengl/gl_functions.h"
#include "validation/vtk/peeling.h"
#include "validation/vtk/surfaceless_window.h"
#include "validation/vtk/triangle_numbers.h"

namespace fathom::validation {
namespace {

using attribution::clip_from_eye;
using attribution::ClipDepth;
using attribution::ClipRange;
using attribution::eye_from_world;
using attribution::WorldMesh;
using attribution::WrittenDepth;

vtkSmartPointer<vtkPolyData> polygons_of(const WorldMesh& mesh) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(mesh.points.size()));
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    points->SetPoint(static_cast<vtkIdType>(i), mesh.points[i].data());
  }
  vtkNew<vtkCellArray> cells;
  const auto count = static_cast<vtkIdType>(mesh.triangles.size());
  cells->AllocateExact(count, 3 * count);
  for (const auto& [a, b, c] : mesh.triangles) {
    const vtkIdType corners[3] = {a, b, c};
    cells->InsertNextCell(3, corners);
  }
  auto polygons = vtkSmartPointer<vtkPolyData>::New();
  polygons->SetPoints(points);
  polygons->SetPolys(cells);
  return polygons;
}

/// VTK's own view transform is the identity; ours stands in its model transform, so that R need not
/// be a rotation.
void set_camera(vtkCamera& camera, const Camera& ours, const ClipRange& range, ClipDepth depth) {
  camera.SetPosition(0, 0, 0);
  camera.SetFocalPoint(0, 0, -1);
  camera.SetViewUp(0, 1, 0);
  camera.SetModelTransformMatrix(eye_from_world(ours).data());
  vtkNew<vtkMatrix4x4> projection;
  projection->DeepCopy(clip_from_eye(ours, range, depth).data());
  camera.SetExplicitProjectionTransformMatrix(projection);
  camera.UseExplicitProjectionTransformMatrixOn();
  camera.SetParallelProjection(is_orthographic(ours.projection) ? 1 : 0);
  camera.SetClippingRange(range.near, range.far);
}

int texture_format(Storage storage) {
  switch (storage) {
    case Storage::unorm16:
      return vtkTextureObject::Fixed16;
    case Storage::unorm24:
      return vtkTextureObject::Fixed24;
    case Storage::unorm32:
      return vtkTextureObject::Fixed32;
    default:
      return vtkTextureObject::Float32;
  }
}

/// VTK's own ways to a depth of one's own: a piece of its fragment shader exchanged, and uniforms.
void write_depth(vtkShaderProperty& shader, const WrittenDepth& written) {
  const bool logarithmic = is_logarithmic(written.mapping);
  shader.AddFragmentShaderReplacement(
      "//VTK::Depth::Impl", true,
      std::string("float depth_argument = depth_term + depth_factor * ") +
          (written.of_w ? "gl_FragCoord.w" : "gl_FragCoord.z") + ";\n  gl_FragDepth = " +
          (logarithmic ? "depth_scale * log2(depth_argument)" : "depth_argument") + ";\n",
      false);
  vtkUniforms* const uniforms = shader.GetFragmentCustomUniforms();
  uniforms->SetUniformf("depth_term", written.term);
  uniforms->SetUniformf("depth_factor", written.factor);
  if (logarithmic) uniforms->SetUniformf("depth_scale", written.scale);
}

/// Otherwise what is behind the pane was not seen through it.
void require_a_layer(const PeelingRenderer& peeling) {
  const std::vector<float>& layer = peeling.nearest_layer();
  if (std::all_of(layer.begin(), layer.end(), [](float z) { return z == 1; })) {
    throw InputError("vtk: nothing of this scene lies behind a pane just beyond near");
  }
}

}  // namespace

struct VtkRenderer::Parts {
  explicit Parts(Driver driver) : context(driver) {}

  EglContext context;  // outlives the window
  vtkNew<SurfacelessWindow> window;
  vtkNew<RecordingMapper> mapper;
  vtkSmartPointer<PeelingRenderer> peeling;  ///< where something is translucent
  vtkSmartPointer<vtkTextureObject> depth;
  VtkOptions options;
  int width = 0, height = 0;
  bool draws_numbers = false;
};

VtkRenderer::VtkRenderer(const WorldMesh& mesh, const Camera& camera, const ClipRange& range,
                         const VtkOptions& options)
    : parts_(std::make_unique<Parts>(options.driver)) {
  parts_->width = static_cast<int>(camera.width);
  parts_->height = static_cast<int>(camera.height);

  parts_->options = options;
  parts_->draws_numbers =
      options.numbers && options.mesh != VtkVariant::Mesh::peeled && have_colours(mesh);
  RecordingMapper* const mapper = parts_->mapper;
  vtkNew<vtkActor> actor;
  if (parts_->draws_numbers) {
    vtkNew<vtkPolyData> polygons;
    set_numbered_polygons(mesh, *polygons);
    mapper->SetInputData(polygons);
    draw_numbers(*mapper, *actor->GetShaderProperty());
    if (options.samples == 0) mapper->record_numbers(camera.width, camera.height);
  } else {
    mapper->SetInputData(polygons_of(mesh));
  }
  mapper->ScalarVisibilityOff();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  vtkSmartPointer<vtkRenderer> renderer;
  if (options.mesh == VtkVariant::Mesh::opaque) {
    renderer = vtkSmartPointer<vtkRenderer>::New();
  } else {
    renderer = parts_->peeling = vtkSmartPointer<PeelingRenderer>::New();
    if (options.mesh == VtkVariant::Mesh::peeled) actor->GetProperty()->SetOpacity(0.5);
    if (options.mesh == VtkVariant::Mesh::behind_peeled) {
      renderer->AddActor(translucent_pane(camera));
    }
  }
  renderer->AddActor(actor);
  set_camera(*renderer->GetActiveCamera(), camera, range,
             options.reversed ? ClipDepth::one_to_zero : ClipDepth::minus_one_to_one);
  if (options.written) write_depth(*actor->GetShaderProperty(), *options.written);
  if (options.reversed || (options.written && is_reversed(options.written->mapping))) {
    mapper->reverse(options.reversed);
  }

  parts_->window->SetSize(parts_->width, parts_->height);
  parts_->window->AddRenderer(renderer);
  parts_->window->SetMultiSamples(options.samples);
}

VtkRenderer::~VtkRenderer() {
  if (parts_->depth) parts_->depth->ReleaseGraphicsResources(parts_->window);
  parts_->window->Finalize();
}

void VtkRenderer::draw() {
  Parts& p = *parts_;
  if (p.options.depth && !p.depth) {
    p.window->Render();  // makes the framebuffer whose attachment is exchanged
    p.depth = vtkSmartPointer<vtkTextureObject>::New();
    p.depth->SetContext(p.window);
    p.depth->AllocateDepth(static_cast<unsigned>(p.width), static_cast<unsigned>(p.height),
                           texture_format(*p.options.depth));
    vtkOpenGLFramebufferObject* const framebuffer = p.window->GetRenderFramebuffer();
    framebuffer->Bind();
    framebuffer->AddDepthAttachment(p.depth);
    framebuffer->UnBind();
  }
  p.window->Render();
  p.window->WaitForCompletion();
}

VtkDrawing VtkRenderer::drawing() {
  Parts& p = *parts_;
  VtkDrawing drawing;
  const GlFunctions gl;
  vtkOpenGLFramebufferObject* const framebuffer = p.window->GetRenderFramebuffer();
  gl.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer->GetFBOIndex());
  drawing.storage = depth_attachment_storage(gl, GL_READ_FRAMEBUFFER);
  gl.GetIntegerv(GL_SUBPIXEL_BITS, &drawing.subpixel_bits);
  drawing.shift = p.mapper->shift();
  drawing.scale = p.mapper->scale();
  drawing.clip_from_held = p.mapper->clip_from_held();
  drawing.equal_depths = p.mapper->equal_depths();
  if (p.options.mesh == VtkVariant::Mesh::behind_peeled) require_a_layer(*p.peeling);
  if (p.options.mesh == VtkVariant::Mesh::peeled) {
    const std::vector<float>& layer = p.peeling->nearest_layer();
    drawing.windows.assign(layer.begin(), layer.end());
    drawing.storage = Storage::float32;
  } else if (p.options.samples > 0) {
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer->GetFBOIndex());
    gl.GetIntegerv(GL_SAMPLES, &drawing.samples);
    std::array<GLfloat, 2> position{0.5F, 0.5F};  // rows from the bottom
    if (drawing.samples > 1) gl.GetMultisamplefv(GL_SAMPLE_POSITION, 0, position.data());
    drawing.sample = {position[0], 1.0 - position[1]};
    const std::vector<float> resolved = window_depths();
    drawing.windows.assign(resolved.begin(), resolved.end());
    drawing.storage = Storage::float32;  // read as binary32
    if (p.draws_numbers) drawing.triangles = numbers_of_first_sample(gl, drawing.samples);
  } else {
    drawing.windows = read_window_depths(gl, static_cast<std::uint32_t>(p.width),
                                         static_cast<std::uint32_t>(p.height), drawing.storage);
  }
  if (p.options.samples == 0) drawing.triangles = p.mapper->numbers();
  return drawing;
}

/// Last: it changes what OpenGL draws into.
std::vector<std::uint32_t> VtkRenderer::numbers_of_first_sample(const GlFunctions& gl,
                                                                int samples) {
  const auto width = static_cast<std::uint32_t>(parts_->width);
  const auto height = static_cast<std::uint32_t>(parts_->height);
  gl.BindFramebuffer(GL_FRAMEBUFFER, parts_->window->GetRenderFramebuffer()->GetFBOIndex());
  return samples > 1 ? read_triangle_numbers_of_first_sample(gl, width, height)
                     : read_triangle_numbers(gl, width, height);
}

std::vector<float> VtkRenderer::window_depths() {
  const int width = parts_->width, height = parts_->height;
  vtkNew<vtkFloatArray> read;
  parts_->window->GetZbufferData(0, 0, width - 1, height - 1, read);
  const auto row_length = static_cast<std::size_t>(width);
  std::vector<float> depths(row_length * static_cast<std::size_t>(height));
  for (int row = 0; row < height; ++row) {  // OpenGL's rows run from the bottom
    const float* from = read->GetPointer(static_cast<vtkIdType>(height - 1 - row) * width);
    std::copy(from, from + width, depths.begin() + row * row_length);
  }
  return depths;
}

std::string VtkRenderer::description() const {
  return std::string("VTK ") + vtkVersion::GetVTKVersion() + " on " + parts_->context.description();
}

}  // namespace fathom::validation
