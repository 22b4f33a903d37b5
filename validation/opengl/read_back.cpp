#include "validation/opengl/read_back.h"

#include <string>

#include "fathom/numeric/errors.h"

namespace fathom::validation {
namespace {

/// An image read from the bottom, its rows turned; every value made anew by `value`.
template <class T, class Value>
std::vector<Value> read_pixels(const GlFunctions& gl, std::uint32_t width, std::uint32_t height,
                               GLenum format, GLenum type, Value (*value)(T)) {
  std::vector<T> read(std::size_t{width} * height);
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl.ReadPixels(0, 0, static_cast<GLsizei>(width), static_cast<GLsizei>(height), format, type,
                read.data());
  std::vector<Value> values(read.size());
  for (std::size_t row = 0; row < height; ++row) {
    for (std::size_t x = 0; x < width; ++x) {
      values[row * width + x] = value(read[(height - 1 - row) * width + x]);
    }
  }
  return values;
}

}  // namespace

Storage depth_attachment_storage(const GlFunctions& gl, GLenum target) {
  GLint bits = 0, type = 0;
  gl.GetFramebufferAttachmentParameteriv(target, GL_DEPTH_ATTACHMENT,
                                         GL_FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE, &bits);
  gl.GetFramebufferAttachmentParameteriv(target, GL_DEPTH_ATTACHMENT,
                                         GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE, &type);
  if (type == GL_FLOAT) return Storage::float32;
  if (bits == 16) return Storage::unorm16;
  if (bits == 24) return Storage::unorm24;
  if (bits == 32) return Storage::unorm32;
  throw InputError("OpenGL: the driver's depth attachment has " + std::to_string(bits) + " bits");
}

std::vector<double> read_window_depths(const GlFunctions& gl, std::uint32_t width,
                                       std::uint32_t height, Storage storage) {
  const auto read_codes = [&](double (*value)(std::uint32_t)) {
    return read_pixels<std::uint32_t, double>(gl, width, height, GL_DEPTH_COMPONENT,
                                              GL_UNSIGNED_INT, value);
  };
  if (storage == Storage::unorm16) {
    return read_pixels<std::uint16_t, double>(gl, width, height, GL_DEPTH_COMPONENT,
                                              GL_UNSIGNED_SHORT,
                                              [](std::uint16_t code) { return code / 65535.0; });
  }
  if (storage == Storage::unorm24) {  // in the upper 24 bits
    return read_codes([](std::uint32_t code) { return (code >> 8) / 16777215.0; });
  }
  if (storage == Storage::unorm32) {
    return read_codes([](std::uint32_t code) { return code / 4294967295.0; });
  }
  return read_pixels<float, double>(gl, width, height, GL_DEPTH_COMPONENT, GL_FLOAT,
                                    [](float z) { return double{z}; });
}

std::vector<std::uint32_t> read_numbers(const GlFunctions& gl, std::uint32_t width,
                                        std::uint32_t height) {
  gl.ReadBuffer(GL_COLOR_ATTACHMENT0);
  return read_pixels<std::uint32_t, std::uint32_t>(gl, width, height, GL_RED_INTEGER,
                                                   GL_UNSIGNED_INT,
                                                   [](std::uint32_t number) { return number; });
}

}  // namespace fathom::validation
