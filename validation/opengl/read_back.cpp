#include "validation/opengl/read_back.h"

#include <algorithm>

#include "fathom/depth_format/opengl_storage.h"

namespace fathom::validation {
namespace {

/// An image read from the bottom, its rows turned.
template <class T>
std::vector<T> read_pixels(const GlFunctions& gl, std::uint32_t width, std::uint32_t height,
                           GLenum format, GLenum type) {
  std::vector<T> read(std::size_t{width} * height);
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl.ReadPixels(0, 0, static_cast<GLsizei>(width), static_cast<GLsizei>(height), format, type,
                read.data());
  std::vector<T> turned(read.size());
  for (std::size_t row = 0; row < height; ++row) {
    std::copy_n(&read[(height - 1 - row) * width], width, &turned[row * width]);
  }
  return turned;
}

}  // namespace

Storage depth_attachment_storage(const GlFunctions& gl, GLenum target) {
  GLint bits = 0, type = 0;
  gl.GetFramebufferAttachmentParameteriv(target, GL_DEPTH_ATTACHMENT,
                                         GL_FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE, &bits);
  gl.GetFramebufferAttachmentParameteriv(target, GL_DEPTH_ATTACHMENT,
                                         GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE, &type);
  return storage_of_attachment(bits, type == GL_FLOAT);
}

std::vector<double> read_window_depths(const GlFunctions& gl, std::uint32_t width,
                                       std::uint32_t height, Storage storage) {
  constexpr GLenum depths = GL_DEPTH_COMPONENT;
  if (storage == Storage::float32) {
    const auto read = read_pixels<float>(gl, width, height, depths, GL_FLOAT);
    return {read.begin(), read.end()};
  }
  const auto windows = [&](const auto& pixels) {
    std::vector<double> made(pixels.size());
    std::transform(pixels.begin(), pixels.end(), made.begin(),
                   [&](std::uint32_t pixel) { return window_depth_of_pixel(storage, pixel); });
    return made;
  };
  if (storage == Storage::unorm16) {
    return windows(read_pixels<std::uint16_t>(gl, width, height, depths, GL_UNSIGNED_SHORT));
  }
  return windows(read_pixels<std::uint32_t>(gl, width, height, depths, GL_UNSIGNED_INT));
}

std::vector<std::uint32_t> read_numbers(const GlFunctions& gl, std::uint32_t width,
                                        std::uint32_t height) {
  gl.ReadBuffer(GL_COLOR_ATTACHMENT0);
  return read_pixels<std::uint32_t>(gl, width, height, GL_RED_INTEGER, GL_UNSIGNED_INT);
}

}  // namespace fathom::validation
