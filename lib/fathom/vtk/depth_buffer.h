#pragma once

#include <string>
#include <vector>

#include "fathom/attribution/model/renderer_model.h"

class vtkOpenGLRenderWindow;

namespace fathom::vtk {

/// A part of a window in pixels, from its bottom left corner.
struct WindowPart {
  int left = 0, bottom = 0, width = 0, height = 0;
};

/// The content of OpenGL's depth buffer after a frame.
struct DepthBuffer {
  /// Window depths exactly as stored, rows from the top; with several samples, the depths of the
  /// first sample, as binary32.
  std::vector<double> windows;
  Storage storage = Storage::unorm24;
  int subpixel_bits = 8;
  attribution::SamplePosition sample;
  /// Of the driver: "llvmpipe (…)".
  std::string renderer;
};

/// Fails    InputError where the window has no depth attachment of a known type.
DepthBuffer read_depth_buffer(vtkOpenGLRenderWindow& window, const WindowPart& part);

}  // namespace fathom::vtk
