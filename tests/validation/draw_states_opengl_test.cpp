#include <EGL/egl.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fathom/pipeline/render_pipeline.h"
#include "tests/pipeline/layers.h"
#include "validation/opengl/egl_context.h"
#include "validation/opengl/gl_functions.h"

/// The draw states of the pipeline held to OpenGL: the driver draws the same layers with the same
/// depth and stencil tests, masks, offsets and opacities, and has the same codes, stencil values
/// and colours in the end.
namespace fathom::validation {
namespace {

using pipeline::camera_of_layers;
using pipeline::Layer;
using pipeline::layers;
using pipeline::PipelineFrame;
using pipeline::PipelineOptions;

constexpr double near_plane = 0.5, far_plane = 100;
constexpr std::uint32_t width = 6, height = 4;  // of camera_of_layers

/// The driver's functions that only this test calls.
template <class Function>
Function function_named(const char* name) {
  const auto function = reinterpret_cast<Function>(eglGetProcAddress(name));
  EXPECT_NE(function, nullptr) << name;
  return function;
}

constexpr const char* whole_window = R"(#version 330
// Of the depth in normalised device coordinates: along x, along y, in the middle.
uniform vec3 plane;
void main() {
  vec2 corner = vec2((gl_VertexID & 1) * 2 - 1, (gl_VertexID & 2) - 1);
  gl_Position = vec4(corner, dot(plane.xy, corner) + plane.z, 1);
}
)";
constexpr const char* one_colour = R"(#version 330
uniform vec4 colour;
layout(location = 0) out vec4 drawn;
void main() { drawn = colour; }
)";

GLenum gl_name(Comparison comparison) {
  constexpr GLenum names[]{GL_NEVER,   GL_LESS,     GL_EQUAL,  GL_LEQUAL,
                           GL_GREATER, GL_NOTEQUAL, GL_GEQUAL, GL_ALWAYS};
  return names[static_cast<std::size_t>(comparison)];
}

GLenum gl_name(StencilAction action) {
  constexpr GLenum names[]{GL_KEEP,      GL_ZERO, GL_REPLACE,   GL_INCR,
                           GL_INCR_WRAP, GL_DECR, GL_DECR_WRAP, GL_INVERT};
  return names[static_cast<std::size_t>(action)];
}

class DrawStates : public testing::Test {
 protected:
  explicit DrawStates(GLenum depth_format = GL_DEPTH24_STENCIL8,
                      GLenum place = GL_DEPTH_STENCIL_ATTACHMENT) {
    GLuint framebuffer = 0, array = 0;
    gl.GenFramebuffers(1, &framebuffer);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    attach(GL_RGBA32F, GL_COLOR_ATTACHMENT0);
    attach(depth_format, place);
    EXPECT_EQ(gl.CheckFramebufferStatus(GL_FRAMEBUFFER),
              static_cast<GLenum>(GL_FRAMEBUFFER_COMPLETE));
    gl.GenVertexArrays(1, &array);
    gl.BindVertexArray(array);
    gl.Viewport(0, 0, width, height);
    program = use_new_program(gl, whole_window, one_colour);
  }

  void attach(GLenum format, GLenum place) const {
    GLuint buffer = 0;
    gl.GenRenderbuffers(1, &buffer);
    gl.BindRenderbuffer(GL_RENDERBUFFER, buffer);
    gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, 0, format, width, height);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, place, GL_RENDERBUFFER, buffer);
  }

  /// Masks hold for clearing too.
  void clear() const {
    set({});
    stencil_mask(255);
    const std::array<GLfloat, 4> black{0, 0, 0, 0};
    gl.ClearBufferfv(GL_COLOR, 0, black.data());
    clear_buffer_fi(GL_DEPTH_STENCIL, 0, 1, 0);
  }

  void set(const DrawState& state) const {
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(gl_name(state.depth_test.value_or(Comparison::less)));
    depth_mask(state.depth_write ? GL_TRUE : GL_FALSE);
    const GLboolean colour = state.colour_write ? GL_TRUE : GL_FALSE;
    colour_mask(colour, colour, colour, colour);
    const StencilState s = state.stencil.value_or(StencilState{});
    if (state.stencil) {
      gl.Enable(GL_STENCIL_TEST);
    } else {
      gl.Disable(GL_STENCIL_TEST);
    }
    stencil_function(gl_name(s.test), s.reference, s.mask);
    stencil_operation(gl_name(s.fail), gl_name(s.depth_fail), gl_name(s.pass));
    stencil_mask(s.write_mask);
    if (state.alpha) {
      gl.Enable(GL_BLEND);
    } else {
      gl.Disable(GL_BLEND);
    }
    blend_function(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    gl.Enable(GL_POLYGON_OFFSET_FILL);
    const PolygonOffset offset = state.polygon_offset.value_or(PolygonOffset{});
    gl.PolygonOffset(static_cast<GLfloat>(offset.factor), static_cast<GLfloat>(offset.units));
  }

  /// A plane whose depth in [−1, 1] changes by x from the window's middle to its right edge, by y
  /// to its upper one.
  void draw(const DrawState& state, const std::array<float, 3>& colour, float x, float y,
            float middle) const {
    set(state);
    uniform_3f(gl.GetUniformLocation(program, "plane"), x, y, middle);
    uniform_4f(gl.GetUniformLocation(program, "colour"), colour[0], colour[1], colour[2],
               static_cast<float>(state.alpha.value_or(1)));
    draw_arrays(GL_TRIANGLE_STRIP, 0, 4);
  }

  [[nodiscard]] std::vector<std::uint32_t> codes(Storage storage) const {
    const double greatest = storage == Storage::unorm16 ? 65535 : 16777215;
    std::vector<std::uint32_t> codes;
    for (const double z : read_window_depths(gl, width, height, storage)) {
      codes.push_back(static_cast<std::uint32_t>(std::lround(z * greatest)));
    }
    return codes;
  }

  /// How many of the least steps of the storage a unit of an offset is. OpenGL leaves that to the
  /// driver ([GL46] 14.6.5); the pipeline's is one.
  [[nodiscard]] double steps_of_unit(Storage storage) const {
    const auto code_with = [&](double units) {
      DrawState state;
      state.polygon_offset = PolygonOffset{0, units};
      clear();
      draw(state, {1, 1, 1}, 0, 0, -0.25F);
      return static_cast<double>(codes(storage)[0]);
    };
    return (code_with(64) - code_with(0)) / 64;
  }

  const EglContext context;
  const GlFunctions gl;
  GLuint program = 0;

 private:
  decltype(&::glDepthMask) depth_mask = function_named<decltype(depth_mask)>("glDepthMask");
  decltype(&::glColorMask) colour_mask = function_named<decltype(colour_mask)>("glColorMask");
  decltype(&::glStencilFunc) stencil_function =
      function_named<decltype(stencil_function)>("glStencilFunc");
  decltype(&::glStencilOp) stencil_operation =
      function_named<decltype(stencil_operation)>("glStencilOp");
  decltype(&::glStencilMask) stencil_mask = function_named<decltype(stencil_mask)>("glStencilMask");
  decltype(&::glBlendFunc) blend_function = function_named<decltype(blend_function)>("glBlendFunc");
  decltype(&::glDrawArrays) draw_arrays = function_named<decltype(draw_arrays)>("glDrawArrays");
  PFNGLCLEARBUFFERFIPROC clear_buffer_fi =
      function_named<decltype(clear_buffer_fi)>("glClearBufferfi");
  PFNGLUNIFORM3FPROC uniform_3f = function_named<decltype(uniform_3f)>("glUniform3f");
  PFNGLUNIFORM4FPROC uniform_4f = function_named<decltype(uniform_4f)>("glUniform4f");
};

/// The depth whose window depth is k/256: all of these but 128 are codes of 24 bits and less than
/// half a code beside, so that no rounding of the way there matters; in binary32 they are exact.
double depth_at(int k) {
  return far_plane * near_plane / (far_plane - k / 256.0 * (far_plane - near_plane));
}

struct Drawn {
  int k = 0;
  Layer layer;
};

/// A state of any kind.
DrawState any_state(std::mt19937& random) {
  const auto one_in = [&](unsigned n) { return random() % n == 0; };
  const auto byte = [&] { return static_cast<std::uint8_t>(random()); };
  const auto comparison = [&] { return static_cast<Comparison>(random() % 8); };
  const auto action = [&] { return static_cast<StencilAction>(random() % 8); };
  DrawState state;
  if (!one_in(3)) state.depth_test = comparison();
  state.depth_write = !one_in(4);
  state.colour_write = !one_in(5);
  if (one_in(3)) state.polygon_offset = PolygonOffset{0, static_cast<int>(random() % 9) - 4.0};
  if (one_in(3)) state.alpha = static_cast<double>(random() % 5) / 4;
  if (!one_in(3)) {
    // Masks of few bits, so that values meet.
    const auto mask = static_cast<std::uint8_t>(one_in(2) ? 255 : byte() & 7);
    state.stencil = StencilState{comparison(), static_cast<std::uint8_t>(random() % 4),
                                 mask,         one_in(2) ? std::uint8_t{255} : byte(),
                                 action(),     action(),
                                 action()};
  }
  return state;
}

std::vector<Drawn> any_layers(std::mt19937& random) {
  std::vector<Drawn> list(2 + random() % 6);
  for (Drawn& drawn : list) {
    drawn.k = 100 + static_cast<int>(random() % 4);  // equal depths are frequent
    const auto part = [&] { return static_cast<float>(random() % 5) / 4; };
    drawn.layer = {depth_at(drawn.k), any_state(random), {part(), part(), part()}};
  }
  return list;
}

PipelineOptions unlit(Storage storage) {
  PipelineOptions options;
  options.precision = pipeline::Precision::binary64;
  options.depth_format.storage = storage;
  options.depth_format.mapping = Mapping::opengl;
  options.depth_format.near = near_plane;
  options.depth_format.far = far_plane;
  options.shading = pipeline::Shading::none;
  return options;
}

/// The driver compiles code for every state that it has not seen: 3000 scenes take minutes.
TEST_F(DrawStates, OfLayersDoWhatTheDriverDoes) {
  std::mt19937 random(1);
  const double steps = steps_of_unit(Storage::unorm24);
  std::size_t blended = 0, offset = 0, stencilled = 0;
  for (int scene = 0; scene < 200; ++scene) {
    SCOPED_TRACE("scene " + std::to_string(scene));
    const std::vector<Drawn> list = any_layers(random);
    std::vector<Layer> of_pipeline;
    clear();
    for (const auto& [k, layer] : list) {
      of_pipeline.push_back(layer);
      if (auto& offset_of = of_pipeline.back().state.polygon_offset) offset_of->units *= steps;
      draw(layer.state, layer.colour, 0, 0, static_cast<float>(k) / 128 - 1);
      blended += layer.state.alpha.has_value() ? 1 : 0;
      offset += layer.state.polygon_offset.has_value() ? 1 : 0;
      stencilled += layer.state.stencil.has_value() ? 1 : 0;
    }
    const PipelineFrame frame =
        render_frame(layers(of_pipeline), camera_of_layers(near_plane, far_plane),
                     unlit(Storage::unorm24), true);

    const std::vector<std::uint32_t> codes = this->codes(Storage::unorm24);
    std::vector<std::uint8_t> stencil(codes.size());
    gl.ReadPixels(0, 0, width, height, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, stencil.data());
    std::vector<std::array<float, 4>> colours(codes.size());
    gl.ReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, colours.data());
    for (std::size_t i = 0; i < codes.size(); ++i) {
      ASSERT_EQ(frame.stored[i].bits, codes[i]);
      ASSERT_EQ(frame.stencil[i], stencil[i]);
      // Seven layers, three roundings of numbers up to 1 each.
      const auto& pixel = frame.picture.pixels[i];
      for (std::size_t k = 0; k < 3; ++k) ASSERT_NEAR(pixel[k], colours[i][k], 21 * 0x1p-24);
    }
    ASSERT_EQ(gl.GetError(), static_cast<GLenum>(GL_NO_ERROR));
  }
  EXPECT_GT(std::min({blended, offset, stencilled}), 150U);
}

class SlopedPlanes : public DrawStates {
 protected:
  SlopedPlanes() : DrawStates(GL_DEPTH_COMPONENT16, GL_DEPTH_ATTACHMENT) {}
};

/// Planes that are tilted by any slopes, offset by factors: every code of 16 bits is the exact one
/// but where the exact depth lies so near the middle of two that binary32 cannot tell.
TEST_F(SlopedPlanes, AreOffsetAsTheDriverDoes) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> slope(-0.15, 0.15), factor(-0.5, 0.5);
  const double steps = steps_of_unit(Storage::unorm16);
  std::size_t compared = 0;
  for (int scene = 0; scene < 1000; ++scene) {
    SCOPED_TRACE("scene " + std::to_string(scene));
    // Window depth z = p·X + q·Y + r on the window from −1 to 1, Y up; 1/D = (F − z)/(F·n).
    const auto p = static_cast<float>(slope(random)), q = static_cast<float>(slope(random));
    const float r = 0.5F;
    DrawState state;
    state.polygon_offset = PolygonOffset{std::round(factor(random) * 64) / 64, 4};
    DrawState of_pipeline = state;
    of_pipeline.polygon_offset->units *= steps;
    const double F = far_plane / (far_plane - near_plane);
    const auto depth = [&](double X, double Y) {
      return F * near_plane / (F - (double{p} * X + double{q} * Y + r));
    };
    // Twice the window, so that it is cut by the window's edges.
    Scene plane = layers({{1, of_pipeline}});
    constexpr std::array<std::array<double, 2>, 4> corners{
        {{-1.5, 1.5}, {1.5, 1.5}, {1.5, -1.5}, {-1.5, -1.5}}};
    for (std::size_t k = 0; k < 4; ++k) {
      const auto [X, Y] = corners[k];
      const double D = depth(X, Y);
      // cx / fx = 3/4, cy / fy = 1/2; the camera's y runs down.
      plane.meshes[0].vertices[k] = {X * 0.75 * D, -Y * 0.5 * D, D};
    }
    const PipelineFrame frame =
        render_frame(plane, camera_of_layers(near_plane, far_plane), unlit(Storage::unorm16), true);
    clear();
    draw(state, {1, 1, 1}, 2 * p, 2 * q, 2 * r - 1);
    const std::vector<std::uint32_t> codes = this->codes(Storage::unorm16);

    const double m = std::max(std::abs(double{p}) * 2 / width, std::abs(double{q}) * 2 / height);
    const double o = m * state.polygon_offset->factor + 4 * steps / 65535.0;
    for (std::size_t i = 0; i < codes.size(); ++i) {
      const double X = (static_cast<double>(i % width) + 0.5) * 2 / width - 1;
      const double Y = 1 - (static_cast<double>(i / width) + 0.5) * 2 / height;
      const double exact = (double{p} * X + double{q} * Y + r + o) * 65535;
      // Some ten roundings of numbers up to 1: 10·2⁻²⁴·65535 = 0.04.
      if (std::abs(std::remainder(exact - 0.5, 1)) < 0.05) continue;
      ++compared;
      ASSERT_EQ(codes[i], static_cast<std::uint32_t>(std::lround(exact))) << "the driver's";
      ASSERT_EQ(frame.stored[i].bits, codes[i]) << "pixel " << i;
    }
  }
  EXPECT_GT(compared, 20000U);
}

}  // namespace
}  // namespace fathom::validation
