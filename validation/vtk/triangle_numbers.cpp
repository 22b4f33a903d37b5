#include "validation/vtk/triangle_numbers.h"

#include <vtkCellArray.h>
#include <vtkDataObject.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLHelper.h>
#include <vtkOpenGLVertexBufferObject.h>
#include <vtkOpenGLVertexBufferObjectGroup.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkShaderProgram.h>
#include <vtkShaderProperty.h>

#include <array>

#include "fathom/failures/errors.h"
#include "fathom/image/depth_map.h"
#include "validation/opengl/gl_functions.h"

namespace fathom::validation {
namespace {

using attribution::WorldMesh;

constexpr const char* array_name = "triangle number";
constexpr std::size_t colour_count = std::size_t{1} << 24;

std::array<float, 3> colour_of(std::uint32_t triangle) {
  const std::uint32_t code = triangle + 1;
  std::array<float, 3> colour{};
  for (std::size_t k = 0; k < 3; ++k) colour[k] = static_cast<float>(code >> 8 * k & 0xFFU) / 255;
  return colour;
}

/// Of the bytes red, green, blue and alpha.
std::uint32_t number_of(const std::uint8_t* colour) {
  const std::uint32_t code = colour[0] | static_cast<std::uint32_t>(colour[1]) << 8 |
                             static_cast<std::uint32_t>(colour[2]) << 16;
  return code == 0 ? no_surface : code - 1;
}

std::vector<std::uint32_t> read_colours(const GlFunctions& gl, std::uint32_t width,
                                        std::uint32_t height) {
  std::vector<std::uint8_t> read(std::size_t{4} * width * height);
  gl.PixelStorei(GL_PACK_ALIGNMENT, 4);
  gl.ReadPixels(0, 0, static_cast<GLsizei>(width), static_cast<GLsizei>(height), GL_RGBA,
                GL_UNSIGNED_BYTE, read.data());
  std::vector<std::uint32_t> numbers;
  numbers.reserve(std::size_t{width} * height);
  for (std::size_t row = 0; row < height; ++row) {  // OpenGL's rows run from the bottom
    const std::uint8_t* colour = read.data() + 4 * (height - 1 - row) * width;
    for (std::size_t x = 0; x < width; ++x) numbers.push_back(number_of(colour + 4 * x));
  }
  return numbers;
}

/// Points that no triangle uses: VTK counts them where it chooses how to hold positions.
std::vector<bool> used_points(const WorldMesh& mesh) {
  std::vector<bool> used(mesh.points.size());
  for (const CornerIndices& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) used[corner] = true;
  }
  return used;
}

GLuint colour_texture(const GlFunctions& gl, GLenum target) {
  GLint type = 0, name = 0;
  gl.GetFramebufferAttachmentParameteriv(target, GL_COLOR_ATTACHMENT0,
                                         GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, &type);
  gl.GetFramebufferAttachmentParameteriv(target, GL_COLOR_ATTACHMENT0,
                                         GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME, &name);
  if (type != GL_TEXTURE) throw InputError("vtk: does not draw its colours into a texture");
  return static_cast<GLuint>(name);
}

/// Two triangles would meet in a diagonal; one that is larger than the image does not.
constexpr const char* whole_image_vertex_shader = R"(#version 330
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4(4.0 * corner - 1.0, 0.0, 1.0);
}
)";
constexpr const char* first_sample_fragment_shader = R"(#version 330
uniform sampler2DMS colours;
layout(location = 0) out vec4 colour;
void main() { colour = texelFetch(colours, ivec2(gl_FragCoord.xy), 0); }
)";

}  // namespace

bool have_colours(const WorldMesh& mesh) {
  return mesh.triangles.size() < colour_count;
}

void set_numbered_polygons(const WorldMesh& mesh, vtkPolyData& polygons) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkFloatArray> colours;
  colours->SetName(array_name);
  colours->SetNumberOfComponents(3);
  vtkNew<vtkCellArray> cells;
  const auto count = static_cast<vtkIdType>(mesh.triangles.size());
  cells->AllocateExact(count, 3 * count);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::array<float, 3> colour = colour_of(static_cast<std::uint32_t>(t));
    std::array<vtkIdType, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = points->InsertNextPoint(mesh.points[mesh.triangles[t][k]].data());
      colours->InsertNextTuple(colour.data());
    }
    cells->InsertNextCell(3, corners.data());
  }
  const std::vector<bool> used = used_points(mesh);
  const std::array<float, 3> black{};
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i]) continue;
    points->InsertNextPoint(mesh.points[i].data());
    colours->InsertNextTuple(black.data());
  }
  polygons.SetPoints(points);
  polygons.SetPolys(cells);
  polygons.GetPointData()->AddArray(colours);
}

void draw_numbers(vtkPolyDataMapper& mapper, vtkShaderProperty& shader) {
  mapper.MapDataArrayToVertexAttribute("triangleColour", array_name,
                                       vtkDataObject::FIELD_ASSOCIATION_POINTS, -1);
  shader.AddVertexShaderReplacement("//VTK::Normal::Dec", true,
                                    "//VTK::Normal::Dec\n"
                                    "in vec3 triangleColour;\n"
                                    "flat out vec3 numberVSOutput;\n",
                                    false);
  shader.AddVertexShaderReplacement("//VTK::Normal::Impl", true,
                                    "//VTK::Normal::Impl\n"
                                    "  numberVSOutput = triangleColour;\n",
                                    false);
  shader.AddFragmentShaderReplacement("//VTK::Normal::Dec", true,
                                      "//VTK::Normal::Dec\n"
                                      "flat in vec3 numberVSOutput;\n",
                                      false);
  shader.AddFragmentShaderReplacement("//VTK::Light::Impl", true,
                                      "//VTK::Light::Impl\n"
                                      "  gl_FragData[0] = vec4(numberVSOutput, 1.0);\n",
                                      false);
}

std::vector<std::uint32_t> read_triangle_numbers(const GlFunctions& gl, std::uint32_t width,
                                                 std::uint32_t height) {
  GLint drawing = 0, reading = 0;
  gl.GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &drawing);
  gl.GetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &reading);
  gl.BindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(drawing));
  GLint buffer = 0;
  gl.GetIntegerv(GL_READ_BUFFER, &buffer);
  gl.ReadBuffer(GL_COLOR_ATTACHMENT0);
  std::vector<std::uint32_t> numbers = read_colours(gl, width, height);
  gl.ReadBuffer(static_cast<GLenum>(buffer));
  gl.BindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(reading));
  return numbers;
}

std::vector<std::uint32_t> read_triangle_numbers_of_first_sample(const GlFunctions& gl,
                                                                 std::uint32_t width,
                                                                 std::uint32_t height) {
  const GLuint colours = colour_texture(gl, GL_DRAW_FRAMEBUFFER);
  GLuint framebuffer = 0, copy = 0, array = 0;
  gl.GenFramebuffers(1, &framebuffer);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl.GenRenderbuffers(1, &copy);
  gl.BindRenderbuffer(GL_RENDERBUFFER, copy);
  gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, 0, GL_RGBA8, static_cast<GLsizei>(width),
                                    static_cast<GLsizei>(height));
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, copy);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D_MULTISAMPLE, colours);
  use_new_program(gl, whole_image_vertex_shader, first_sample_fragment_shader);
  gl.GenVertexArrays(1, &array);
  gl.BindVertexArray(array);
  for (const GLenum test : {GL_BLEND, GL_DEPTH_TEST, GL_SCISSOR_TEST, GL_CULL_FACE}) {
    gl.Disable(test);
  }
  gl.Viewport(0, 0, static_cast<GLsizei>(width), static_cast<GLsizei>(height));
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  gl.ReadBuffer(GL_COLOR_ATTACHMENT0);
  return read_colours(gl, width, height);
}

vtkStandardNewMacro(RecordingMapper);

namespace {

std::optional<EqualDepths> equal_depths_of(GLenum depth_test) {
  switch (depth_test) {
    case GL_LESS:
    case GL_GREATER:
      return EqualDepths::first_wins;
    case GL_LEQUAL:
    case GL_GEQUAL:
      return EqualDepths::last_wins;
    default:
      return std::nullopt;
  }
}

}  // namespace

void RecordingMapper::SetCameraShaderParameters(vtkOpenGLHelper& drawn, vtkRenderer* renderer,
                                                vtkActor* actor) {
  Superclass::SetCameraShaderParameters(drawn, renderer, actor);
  const GlFunctions gl;
  const auto program = static_cast<GLuint>(drawn.Program->GetHandle());
  const GLint place = gl.GetUniformLocation(program, "MCDCMatrix");
  if (place < 0) return;
  std::array<float, 16> columns{};
  gl.GetUniformfv(program, place, columns.data());
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      clip_from_held_[4 * row + column] = columns[4 * column + row];
    }
  }
  vtkOpenGLVertexBufferObject* const held = VBOs->GetVBO("vertexMC");
  if (held == nullptr || !held->GetCoordShiftAndScaleEnabled()) return;
  for (std::size_t k = 0; k < 3; ++k) {
    shift_[k] = held->GetShift().at(k);
    scale_[k] = held->GetScale().at(k);
  }
}

void RecordingMapper::RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor) {
  if (greater_is_nearer_) {
    draw_reversed(renderer, actor);
  } else {
    draw(renderer, actor);
  }
  if (width_ != 0) numbers_ = read_triangle_numbers(GlFunctions(), width_, height_);
}

void RecordingMapper::draw(vtkRenderer* renderer, vtkActor* actor) {
  GLint test = 0;
  GlFunctions().GetIntegerv(GL_DEPTH_FUNC, &test);
  equal_depths_ = equal_depths_of(static_cast<GLenum>(test));
  Superclass::RenderPieceDraw(renderer, actor);
}

/// VTK has cleared to far = 1 and will test for the less: for this one actor both are turned, and
/// put back as VTK believes them to be.
void RecordingMapper::draw_reversed(vtkRenderer* renderer, vtkActor* actor) {
  const GlFunctions gl;
  const GLfloat far = 0;
  gl.ClearBufferfv(GL_DEPTH, 0, &far);
  gl.DepthFunc(GL_GEQUAL);
  if (zero_to_one_) gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  draw(renderer, actor);
  if (zero_to_one_) gl.ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  gl.DepthFunc(GL_LEQUAL);
}

}  // namespace fathom::validation
