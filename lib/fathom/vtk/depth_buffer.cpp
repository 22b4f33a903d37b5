#include "fathom/vtk/depth_buffer.h"

#if __has_include(<vtk_glad.h>)
#include <vtk_glad.h>
#else
#include <vtk_glew.h>
#endif

#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLRenderWindow.h>

#include <algorithm>
#include <array>

#include "fathom/depth_format/encode.h"

namespace fathom::vtk {
namespace {

Storage storage_of_bound_attachment() {
  GLint bits = 0, type = 0;
  const auto ask = [](GLenum what, GLint& answer) {
    glGetFramebufferAttachmentParameteriv(GL_READ_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, what, &answer);
  };
  ask(GL_FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE, bits);
  ask(GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE, type);
  return storage_of_attachment(bits, type == GL_FLOAT);
}

/// Rows from the bottom.
template <class T>
std::vector<T> read(const WindowPart& part, GLenum type) {
  std::vector<T> values(static_cast<std::size_t>(part.width) *
                        static_cast<std::size_t>(part.height));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(part.left, part.bottom, part.width, part.height, GL_DEPTH_COMPONENT, type,
               values.data());
  return values;
}

template <class T, class Value>
std::vector<double> converted(const std::vector<T>& read, Value value) {
  std::vector<double> windows(read.size());
  std::transform(read.begin(), read.end(), windows.begin(), value);
  return windows;
}

std::vector<double> read_windows(const WindowPart& part, Storage storage) {
  if (storage == Storage::float32) {
    return converted(read<float>(part, GL_FLOAT), [](float z) { return double{z}; });
  }
  const auto window = [&](std::uint32_t pixel) { return window_depth_of_pixel(storage, pixel); };
  if (storage == Storage::unorm16) {
    return converted(read<std::uint16_t>(part, GL_UNSIGNED_SHORT), window);
  }
  return converted(read<std::uint32_t>(part, GL_UNSIGNED_INT), window);
}

/// OpenGL's rows run from the bottom.
void turn_rows(std::vector<double>& values, const WindowPart& part) {
  const auto width = static_cast<std::ptrdiff_t>(part.width);
  for (std::ptrdiff_t low = 0, high = part.height - 1; low < high; ++low, --high) {
    std::swap_ranges(values.begin() + low * width, values.begin() + (low + 1) * width,
                     values.begin() + high * width);
  }
}

/// The values to which VTK itself resolves several samples.
std::vector<double> resolved(vtkOpenGLRenderWindow& window, const WindowPart& part) {
  vtkNew<vtkFloatArray> values;
  window.GetZbufferData(part.left, part.bottom, part.left + part.width - 1,
                        part.bottom + part.height - 1, values);
  const float* const first = values->GetPointer(0);
  return {first, first + values->GetNumberOfTuples()};
}

}  // namespace

DepthBuffer read_depth_buffer(vtkOpenGLRenderWindow& window, const WindowPart& part) {
  window.MakeCurrent();
  DepthBuffer read;
  window.GetRenderFramebuffer()->Bind(GL_FRAMEBUFFER);
  read.renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  glGetIntegerv(GL_SUBPIXEL_BITS, &read.subpixel_bits);
  GLint samples = 0;
  glGetIntegerv(GL_SAMPLES, &samples);
  read.storage = storage_of_bound_attachment();
  if (samples > 1) {
    std::array<GLfloat, 2> position{0.5F, 0.5F};  // rows from the bottom
    glGetMultisamplefv(GL_SAMPLE_POSITION, 0, position.data());
    read.sample = {position[0], 1.0 - position[1]};
    read.windows = resolved(window, part);
    read.storage = Storage::float32;  // read as binary32
  } else {
    read.windows = read_windows(part, read.storage);
  }
  window.GetRenderFramebuffer()->UnBind(GL_FRAMEBUFFER);
  turn_rows(read.windows, part);
  return read;
}

}  // namespace fathom::vtk
