#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fathom/attribution/model/renderer_input.h"
#include "fathom/attribution/model/window_depth.h"
#include "fathom/depth_format/depth_format.h"
#include "validation/variants/variants.h"

namespace fathom::validation {

struct GlFunctions;

struct VtkOptions {
  /// The type of the depth attachment; VTK's own choice if not given.
  std::optional<Storage> depth;
  /// Requested samples per pixel; 0: no multisampling.
  int samples = 0;
  /// Near and far at 1 and 0, the greater depth wins: glClipControl, which VTK does not use.
  bool reversed = false;
  /// VTK's fragment shader writes this depth instead of the interpolated one. If it is reversed,
  /// the depth test also lets the greater depth win.
  std::optional<attribution::WrittenDepth> written;
  VtkVariant::Mesh mesh = VtkVariant::Mesh::opaque;
  Driver driver = Driver::usual;
  /// Whether the numbers of triangles are drawn as colours in the pass that writes the depth
  /// (triangle_numbers.h). Not of a peeled mesh, whose layers are blended.
  bool numbers = false;
};

/// The depths of a frame, and the settings with which it was drawn.
struct VtkDrawing {
  /// Window depths exactly as stored, width × height, rows from the top; 1 (reversed: 0) where
  /// nothing was drawn.
  std::vector<double> windows;
  /// Numbers of the visible triangles, no_surface where nothing was drawn; empty if numbers were
  /// not drawn.
  std::vector<std::uint32_t> triangles;
  Storage storage = Storage::unorm24;
  /// Which of equal depths won, by OpenGL's depth test.
  std::optional<EqualDepths> equal_depths;
  int subpixel_bits = 8, samples = 0;
  /// Position of the (first) sample within the pixel, in pixels from its top left corner.
  std::array<double, 2> sample{0.5, 0.5};
  /// Positions are held as (position − shift)·scale, in the world; the matrix, row by row, takes
  /// them to clip coordinates.
  std::array<double, 3> shift{}, scale{};
  std::array<float, 16> clip_from_held{};
};

/// A mesh drawn by VTK into a framebuffer without a display: points in binary64, our camera as
/// explicit model-view and projection matrices, one sample per pixel unless options say otherwise,
/// no lighting, no culling, nothing written but the depth and a constant colour or the number of
/// the triangle.
///
/// Does not  read the mesh after construction.
/// Threads   all calls from the thread that made it. The number of threads of Mesa's software
///           renderer is LP_NUM_THREADS at construction.
/// Fails     InputError if there is no OpenGL (see EglContext).
class VtkRenderer {
 public:
  VtkRenderer(const attribution::WorldMesh& mesh, const Camera& camera,
              const attribution::ClipRange& range, const VtkOptions& options = {});
  ~VtkRenderer();
  VtkRenderer(const VtkRenderer&) = delete;
  VtkRenderer& operator=(const VtkRenderer&) = delete;

  /// Draws a frame and waits until it is done. The first one also compiles shaders and passes the
  /// mesh to OpenGL.
  void draw();

  /// Window depths of the last frame in [0, 1], width × height, rows from the top; 1 where nothing
  /// was drawn.
  [[nodiscard]] std::vector<float> window_depths();

  /// The last frame: with several samples, the values to which OpenGL resolves them; of a peeled
  /// mesh, the nearest layer.
  /// Fails    InputError if VTK did not peel.
  [[nodiscard]] VtkDrawing drawing();

  /// "VTK 9.1.0 on llvmpipe (…)".
  [[nodiscard]] std::string description() const;

 private:
  [[nodiscard]] std::vector<std::uint32_t> numbers_of_first_sample(const GlFunctions& gl,
                                                                   int samples);

  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace fathom::validation
