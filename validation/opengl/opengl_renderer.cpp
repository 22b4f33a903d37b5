#include "validation/opengl/opengl_renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "fathom/attribution/camera_rays.h"
#include "fathom/attribution/clip_from_held.h"
#include "fathom/attribution/roundings.h"
#include "fathom/attribution/window_depth.h"
#include "fathom/numeric/errors.h"
#include "validation/opengl/egl_context.h"
#include "validation/opengl/read_back.h"

namespace fathom::validation {
namespace {

using attribution::camera_rays;
using attribution::clip_from_held;
using attribution::OtherMap;
using attribution::RasterModel;
using attribution::SamplePosition;
using attribution::unit_roundoff;
using attribution::window_depth;
using attribution::WindowDepth;
using attribution::WorldMesh;

constexpr const char* vertex_shader = R"(#version 330
layout(location = 0) in vec3 position;
uniform mat4 clip_from_held;
void main() { gl_Position = clip_from_held * vec4(position, 1.0); }
)";
constexpr const char* fragment_shader = R"(#version 330
layout(location = 0) out uint triangle;
void main() { triangle = uint(gl_PrimitiveID); }
)";

GLenum internal_format(Storage storage) {
  switch (storage) {
    case Storage::unorm16:
      return GL_DEPTH_COMPONENT16;
    case Storage::unorm24:
      return GL_DEPTH_COMPONENT24;
    case Storage::unorm32:
      return GL_DEPTH_COMPONENT32;
    case Storage::float32:
      return GL_DEPTH_COMPONENT32F;
    default:
      throw UsageError("OpenGL has no depth attachment of this type");
  }
}

/// A framebuffer with numbers of triangles and depths.
class Framebuffer {
 public:
  Framebuffer(const GlFunctions& gl, const Camera& camera, Storage storage, int samples) : gl_(gl) {
    gl.GenFramebuffers(1, &framebuffer_);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    attach(GL_R32UI, GL_COLOR_ATTACHMENT0, camera, samples);
    granted_samples_ = attach(internal_format(storage), GL_DEPTH_ATTACHMENT, camera, samples);
    if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
      throw InputError("OpenGL: the driver offers no framebuffer with this depth attachment");
    }
  }

  void bind(GLenum target) const { gl_.BindFramebuffer(target, framebuffer_); }
  [[nodiscard]] int granted_samples() const { return granted_samples_; }

 private:
  int attach(GLenum format, GLenum place, const Camera& camera, int samples) const {
    GLuint buffer = 0;
    gl_.GenRenderbuffers(1, &buffer);
    gl_.BindRenderbuffer(GL_RENDERBUFFER, buffer);
    gl_.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples > 1 ? samples : 0, format,
                                       static_cast<GLsizei>(camera.width),
                                       static_cast<GLsizei>(camera.height));
    GLint granted = 0;
    gl_.GetRenderbufferParameteriv(GL_RENDERBUFFER, GL_RENDERBUFFER_SAMPLES, &granted);
    gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, place, GL_RENDERBUFFER, buffer);
    return std::max(granted, 1);
  }

  const GlFunctions& gl_;
  GLuint framebuffer_ = 0;
  int granted_samples_ = 1;
};

void use_program(const GlFunctions& gl, const std::array<float, 16>& clip_from_held) {
  const GLuint program = gl.CreateProgram();
  const auto add = [&](GLenum kind, const char* text) {
    const GLuint shader = gl.CreateShader(kind);
    gl.ShaderSource(shader, 1, &text, nullptr);
    gl.CompileShader(shader);
    gl.AttachShader(program, shader);
  };
  add(GL_VERTEX_SHADER, vertex_shader);
  add(GL_FRAGMENT_SHADER, fragment_shader);
  gl.LinkProgram(program);
  GLint linked = 0;
  gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked == 0) throw InputError("OpenGL: the driver does not take the shaders");
  gl.UseProgram(program);
  gl.UniformMatrix4fv(gl.GetUniformLocation(program, "clip_from_held"), 1, GL_TRUE,
                      clip_from_held.data());
}

void hand_over(const GlFunctions& gl, const WorldMesh& mesh, const RasterModel& model) {
  std::vector<float> held;
  held.reserve(3 * mesh.points.size());
  for (const auto& p : mesh.points) {
    for (std::size_t k = 0; k < 3; ++k) {
      held.push_back(static_cast<float>((p[k] - model.shift[k]) * model.scale[k]));
    }
  }
  std::array<GLuint, 2> buffers{};
  GLuint array = 0;
  gl.GenVertexArrays(1, &array);
  gl.BindVertexArray(array);
  gl.GenBuffers(2, buffers.data());
  gl.BindBuffer(GL_ARRAY_BUFFER, buffers[0]);
  gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(held.size() * sizeof(float)), held.data(),
                GL_STATIC_DRAW);
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
  gl.BufferData(GL_ELEMENT_ARRAY_BUFFER,
                static_cast<GLsizeiptr>(mesh.triangles.size() * sizeof(CornerIndices)),
                mesh.triangles.data(), GL_STATIC_DRAW);
  gl.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
  gl.EnableVertexAttribArray(0);
}

void draw(const GlFunctions& gl, const WorldMesh& mesh, const Camera& camera,
          const OpenGlVariant& variant) {
  gl.Viewport(0, 0, static_cast<GLsizei>(camera.width), static_cast<GLsizei>(camera.height));
  if (variant.reversed) gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  const GLfloat cleared = variant.reversed ? 0.0F : 1.0F;
  const GLuint nothing = no_surface;
  gl.ClearBufferfv(GL_DEPTH, 0, &cleared);
  gl.ClearBufferuiv(GL_COLOR, 0, &nothing);
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthFunc(variant.reversed ? GL_GREATER : GL_LESS);
  if (variant.offset_units == 0) {
    gl.Disable(GL_POLYGON_OFFSET_FILL);
  } else {
    gl.Enable(GL_POLYGON_OFFSET_FILL);
    gl.PolygonOffset(0, static_cast<GLfloat>(variant.offset_units));
  }
  gl.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * mesh.triangles.size()), GL_UNSIGNED_INT,
                  nullptr);
}

OtherMap read_back(const GlFunctions& gl, const Camera& camera, const RasterModel& model) {
  OtherMap map{.width = camera.width, .height = camera.height};
  map.windows = read_window_depths(gl, camera.width, camera.height, model.storage);
  map.triangles = read_numbers(gl, camera.width, camera.height);
  const WindowDepth window =
      window_depth(camera.projection, model.mapping, camera.near, camera.far);
  for (std::size_t i = 0; i < map.windows.size(); ++i) {
    map.depths.push_back(map.triangles[i] == no_surface
                             ? std::numeric_limits<double>::infinity()
                             : window.to_depth(map.windows[i] - model.bias));
  }
  return map;
}

/// What the driver makes of glPolygonOffset: OpenGL leaves to it how much a unit is
/// ([GL46] 14.6.5). The mesh is drawn without and with it; where most pixels agree on the
/// difference, that is it.
void measure_offset(const GlFunctions& gl, const WorldMesh& mesh, const Camera& camera,
                    const OpenGlVariant& variant, RasterModel& model) {
  const auto windows = [&](int units) {
    OpenGlVariant with = variant;
    with.offset_units = units;
    draw(gl, mesh, camera, with);
    return read_window_depths(gl, camera.width, camera.height, model.storage);
  };
  const std::vector<double> without = windows(0), with = windows(variant.offset_units);
  std::vector<double> differences;
  for (std::size_t i = 0; i < with.size(); ++i) {
    if (with[i] < 1 && without[i] < 1) differences.push_back(with[i] - without[i]);
  }
  if (differences.empty()) return;
  const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
  std::nth_element(differences.begin(), middle, differences.end());
  model.bias = *middle;
  model.bias_error = 2 * unit_roundoff;  // added in binary32, and stored
}

/// Where positions are held from: the eye, so that nothing is lost near it, or where there is none,
/// the middle of the mesh.
std::array<double, 3> held_from(const WorldMesh& mesh, const Camera& camera) {
  if (camera.projection == Projection::perspective) return camera_rays(camera).origin.at_corner;
  std::array<double, 3> middle{};
  for (std::size_t k = 0; k < 3; ++k) {
    double least = std::numeric_limits<double>::infinity(), greatest = -least;
    for (const auto& p : mesh.points) {
      least = std::min(least, p[k]);
      greatest = std::max(greatest, p[k]);
    }
    if (least <= greatest) middle[k] = least / 2 + greatest / 2;
  }
  return middle;
}

/// Where in the pixel the sample lies that is read back; OpenGL's rows run from the bottom.
SamplePosition sample_position(const GlFunctions& gl) {
  std::array<GLfloat, 2> position{};
  gl.GetMultisamplefv(GL_SAMPLE_POSITION, 0, position.data());
  return {position[0], 1.0 - position[1]};
}

std::string version_of(const GlFunctions& gl) {
  const auto text = [&](GLenum name) {
    const auto* value = reinterpret_cast<const char*>(gl.GetString(name));
    return std::string(value != nullptr ? value : "unknown");
  };
  return text(GL_VENDOR) + ", " + text(GL_RENDERER) + ", " + text(GL_VERSION);
}

}  // namespace

bool interpolates_before_snapping(const std::string& version) {
  return version.find("llvmpipe") != std::string::npos;
}

DrawnMap draw_opengl(const WorldMesh& mesh, const Camera& camera, const OpenGlVariant& variant) {
  const EglContext context;
  const GlFunctions gl;
  DrawnMap drawn;
  drawn.version = version_of(gl) + context.way();
  RasterModel model;
  model.mapping = variant.reversed ? Mapping::reversed : Mapping::opengl;
  model.shift = held_from(mesh, camera);
  model.matrix = clip_from_held(camera, model);

  const Framebuffer framebuffer(gl, camera, variant.storage, variant.samples);
  model.storage = depth_attachment_storage(gl, GL_FRAMEBUFFER);
  GLint subpixel_bits = 0;
  gl.GetIntegerv(GL_SUBPIXEL_BITS, &subpixel_bits);
  model.subpixel_bits = subpixel_bits;
  model.depth_before_snap = interpolates_before_snapping(drawn.version);
  use_program(gl, *model.matrix);
  hand_over(gl, mesh, model);
  if (variant.offset_units != 0) {
    measure_offset(gl, mesh, camera, variant, model);
    drawn.version +=
        fmt::format(", an offset of {} units is {:.6g}", variant.offset_units, model.bias);
  }
  draw(gl, mesh, camera, variant);
  if (variant.samples > 1) {
    drawn.version += ", " + std::to_string(framebuffer.granted_samples()) + " samples granted";
    drawn.model.sample = sample_position(gl);
    const Framebuffer resolved(gl, camera, variant.storage, 1);
    framebuffer.bind(GL_READ_FRAMEBUFFER);
    resolved.bind(GL_DRAW_FRAMEBUFFER);
    const auto w = static_cast<GLint>(camera.width), h = static_cast<GLint>(camera.height);
    gl.BlitFramebuffer(0, 0, w, h, 0, 0, w, h, GL_DEPTH_BUFFER_BIT | GL_COLOR_BUFFER_BIT,
                       GL_NEAREST);
    resolved.bind(GL_READ_FRAMEBUFFER);
  }
  drawn.map = read_back(gl, camera, model);
  drawn.model.name = "OpenGL";
  drawn.model.first_of_equals = true;
  drawn.model.kind = model;
  if (gl.GetError() != GL_NO_ERROR) throw InputError("OpenGL: the driver reports an error");
  return drawn;
}

std::vector<int> offered_samples() {
  const EglContext context;
  const GlFunctions gl;
  const auto offered = [&](GLenum format) {
    GLint count = 0;
    gl.GetInternalformativ(GL_RENDERBUFFER, format, GL_NUM_SAMPLE_COUNTS, 1, &count);
    std::vector<GLint> counts(static_cast<std::size_t>(count));
    gl.GetInternalformativ(GL_RENDERBUFFER, format, GL_SAMPLES, count, counts.data());
    std::sort(counts.begin(), counts.end());
    return counts;
  };
  const std::vector<GLint> depths = offered(GL_DEPTH_COMPONENT24), numbers = offered(GL_R32UI);
  std::vector<int> both;
  std::set_intersection(depths.begin(), depths.end(), numbers.begin(), numbers.end(),
                        std::back_inserter(both));
  both.erase(both.begin(), std::upper_bound(both.begin(), both.end(), 1));
  return both;
}

}  // namespace fathom::validation
