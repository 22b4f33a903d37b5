#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "fathom/attribution/model/window_depth.h"
#include "fathom/depth_format/depth_format.h"

/// The assumptions about a renderer whose map is compared with the truth. docs/validation.md
/// derives the bounds that follow from them.
namespace fathom::attribution {

/// The factor by which bounds are enlarged for the binary64 roundings of their own evaluation: each
/// bound is a sum of at least 2⁻²⁴ times some magnitudes. The evaluation of the bound, and of the
/// values that it bounds, errs by less than 2⁻⁴⁶ of the same magnitudes.
inline constexpr double own_roundings = 1 + 0x1p-20;

/// Corners that a renderer holds in binary32, as position − shift, in a frame of their own. It
/// transforms them to clip coordinates by one matrix, a product computed in binary64 and rounded
/// once.
struct RasterPart {
  /// Transforms the part's frame to the world.
  Pose world_from_part{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
  /// In the part's frame.
  std::array<double, 3> shift{0, 0, 0};
  std::shared_ptr<const std::vector<std::array<double, 3>>> points;
};

/// Corners are transformed and snapped to a grid; window depth is interpolated and stored.
struct RasterModel {
  /// Corners are held in binary32 as (position − shift)·scale, component by component.
  ///
  /// Frame    world, scene units.
  std::array<double, 3> shift{0, 0, 0}, scale{1, 1, 1};
  /// Whether the shift is the shift that VTK's mappers choose for the mesh (raster/clip_vertex.h),
  /// if the matrix is unknown; `shift` is ignored then.
  bool shift_as_vtk = false;
  /// The matrix from held positions to clip coordinates, row by row, if known. Then neither its
  /// entries nor the positions are a source of error.
  std::optional<std::array<float, 16>> matrix;
  /// The parts of the scene, if each is held in a frame of its own: together all points of the
  /// mesh, in its order. Then shift, scale, matrix and premultiplied are ignored.
  std::vector<RasterPart> parts;
  /// Whether model-view and projection matrix are multiplied before corners are transformed.
  bool premultiplied = true;
  /// Corners are snapped to multiples of 2^−subpixel_bits pixel.
  int subpixel_bits = 8;
  /// Whether triangles are cut at the border of the image: always, perhaps, or never.
  enum class Cut { always, unknown, never } border = Cut::unknown;

  /// The mapping from depths to the window depths that are interpolated.
  Mapping mapping = Mapping::opengl;
  Storage storage = Storage::unorm24;
  /// The depth that a fragment shader writes in place of the interpolated window depth. `mapping`
  /// remains the mapping of the interpolated depth; triangles are cut at its near and far.
  std::optional<WrittenDepth> written;
  /// Whether depth is interpolated between the corners before snapping.
  bool depth_before_snap = false;
  /// Whether a window depth is rounded to the nearest code; if not, to either of the two
  /// neighbouring codes.
  bool nearest_codes = true;
  /// The depths of the map were decoded from window depths in binary32.
  bool decoded_in_binary32 = false;
  /// Added to every window depth (polygon offset), and how uncertain that is.
  double bias = 0, bias_error = 0;
  /// Depth and not window depth is interpolated linearly: a fault, for hypotheses.
  bool affine = false;

  /// The mapping of the stored depths.
  [[nodiscard]] Mapping stored_mapping() const { return written ? written->mapping : mapping; }
};

/// Rays of a renderer that are not those of a pinhole: one for each pixel, all from the origin of
/// the world.
///
/// Frame    world, scene units; rows from the top.
struct PixelRays {
  struct PixelRay {
    /// Of any length; 0, 0, 0 where the renderer shoots no ray.
    std::array<double, 3> direction{};
    /// Bounds on the error of the renderer's own direction, component by component.
    std::array<double, 3> error{};
  };
  std::vector<PixelRay> rays;
  /// How far a ray may pass by the origin, component by component.
  double origin_error = 0;
};

/// A ray is intersected with triangles; the depth of the hit is stored as binary32.
struct RayModel {
  /// Corners are held in binary32 as position − shift. Frame: world, scene units.
  std::array<double, 3> shift{0, 0, 0};
  /// Roundings that an edge test or a distance may have gone through.
  double roundings = 16;
  /// The error of each entry of the camera's rotation, if the renderer computes the rotation
  /// itself.
  double rotation_error = 0;
  /// The depth of a hit is computed from its position in the world.
  bool depth_from_point = false;
  /// The rays, if they are not the camera's. Depths are then distances from the origin, also those
  /// of the truth and its near and far; `shift`, `rotation_error` and the sample's position are
  /// ignored.
  std::shared_ptr<const PixelRays> rays = nullptr;
};

class LensSamples;

/// The position of the sample in the pixel, from its top left corner, and its error in either
/// direction. In pixels.
struct SamplePosition {
  double x = 0.5, y = 0.5;
  double error = 0;
  /// Radial distortion of the lens, without a unit: a point that an ideal lens shows at radius r of
  /// the plane at depth 1 appears at r·(1 + k1·r² + k2·r⁴). Perspective only.
  /// Source   [Bro71], as OpenCV has it.
  double k1 = 0, k2 = 0;
  /// Where the samples of a camera with a lens lie in the image of the camera without it; then x,
  /// y, k1 and k2 say nothing.
  std::shared_ptr<const LensSamples> lens = nullptr;
};

/// The properties that renderers of all kinds have, and the kind.
struct RendererModel {
  std::string name;
  SamplePosition sample;
  /// No sample between two triangles that share an edge is missed.
  bool watertight = true;
  /// Which of several triangles with the same corners is visible, if the renderer's rule is known:
  /// they have equal depths whatever the roundings are. Triangles are drawn in the order of their
  /// numbers.
  std::optional<EqualDepths> equal_depths;
  /// The quantity that was recorded instead of the depths, if known; the depths of the map are then
  /// decoded from its values.
  std::optional<RecordedDepth> recorded;
  std::variant<RasterModel, RayModel> kind;
};

}  // namespace fathom::attribution
