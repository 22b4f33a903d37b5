#include <EGL/egl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "fathom/attribution/model/window_depth.h"
#include "validation/opengl/egl_context.h"
#include "validation/opengl/gl_functions.h"

/// The driver's log2, on which the model of logarithmic depths relies: all 2²³ numbers of some
/// binades, held against the bound that the shading language gives ([GLSL46] 4.7.1).
namespace fathom::validation {
namespace {

using attribution::log2_error;

constexpr int width = 4096, height = 2048;

constexpr const char* corners = R"(#version 450
void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1);
  gl_Position = vec4(corner, 0, 1);
}
)";
constexpr const char* logarithms = R"(#version 450
layout(location = 0) out float value;
uniform int exponent;
void main() {
  int index = int(gl_FragCoord.y) * 4096 + int(gl_FragCoord.x);
  value = log2(intBitsToFloat((exponent + 127) << 23 | index));
}
)";

class ShaderLog2 : public testing::TestWithParam<int> {
 protected:
  ShaderLog2() {
    GLuint framebuffer = 0, buffer = 0, array = 0;
    gl.GenFramebuffers(1, &framebuffer);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl.GenRenderbuffers(1, &buffer);
    gl.BindRenderbuffer(GL_RENDERBUFFER, buffer);
    gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, 0, GL_R32F, width, height);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffer);
    gl.GenVertexArrays(1, &array);
    gl.BindVertexArray(array);
    gl.Viewport(0, 0, width, height);
  }

  /// log2 of m·2^exponent for all m from 1 to 2.
  std::vector<float> drawn(int exponent) {
    const GLuint program = use_new_program(gl, corners, logarithms);
    const auto set = reinterpret_cast<PFNGLUNIFORM1IPROC>(eglGetProcAddress("glUniform1i"));
    set(gl.GetUniformLocation(program, "exponent"), exponent);
    const auto draw = reinterpret_cast<PFNGLDRAWARRAYSEXTPROC>(eglGetProcAddress("glDrawArrays"));
    draw(GL_TRIANGLES, 0, 3);
    std::vector<float> values(std::size_t{width} * height);
    gl.ReadBuffer(GL_COLOR_ATTACHMENT0);
    gl.ReadPixels(0, 0, width, height, GL_RED, GL_FLOAT, values.data());
    EXPECT_EQ(gl.GetError(), static_cast<GLenum>(GL_NO_ERROR));
    return values;
  }

  const EglContext context;
  const GlFunctions gl;
};

// The measured errors are printed: docs/validation.md quotes them.
TEST_P(ShaderLog2, IsAsExactAsTheShadingLanguageDemands) {
  const std::vector<float> values = drawn(GetParam());
  double greatest = 0, of_bound = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double x = std::ldexp(1 + std::ldexp(static_cast<double>(i), -23), GetParam());
    const double error = std::abs(values[i] - std::log2(x));
    greatest = std::max(greatest, error);
    of_bound = std::max(of_bound, error / log2_error(std::log2(x)));
  }
  EXPECT_LE(of_bound, 1);
  EXPECT_GT(of_bound, 0);  // something was drawn: no binary32 is the logarithm of most numbers
  std::printf("2^%d: greatest error %.3g, %.3g of the bound\n", GetParam(), greatest, of_bound);
}

INSTANTIATE_TEST_SUITE_P(Binades, ShaderLog2, testing::Values(-24, -12, -4, -1, 0, 3),
                         [](const auto& e) {
                           return (e.param < 0 ? "Minus" : "") + std::to_string(std::abs(e.param));
                         });

}  // namespace
}  // namespace fathom::validation
