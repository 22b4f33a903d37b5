#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "fathom/attribution/model/window_depth.h"
#include "fathom/depth_format/depth_format.h"

/// What is assumed of a renderer whose map is compared with the truth. docs/validation.md derives
/// the bounds that follow from it.
namespace fathom::attribution {

/// The factor by which bounds are enlarged for the binary64 roundings of their own evaluation: each
/// bound is a sum of at least 2⁻²⁴ times magnitudes whose evaluation here, and that of the values
/// that they bound, errs by less than 2⁻⁴⁶ of the same magnitudes.
inline constexpr double own_roundings = 1 + 0x1p-20;

/// Corners that a renderer holds in a frame of their own, in binary32 as position − shift, and
/// takes to clip coordinates by one matrix, which it has multiplied in binary64 and rounded once.
struct RasterPart {
  /// Takes the part's frame to the world.
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
  /// Whether the shift is the one that VTK's mappers choose for the mesh (raster/clip_vertex.h),
  /// where the matrix is not known; `shift` then says nothing.
  bool shift_as_vtk = false;
  /// The matrix that takes held positions to clip coordinates, row by row, where it is known; its
  /// entries then are not a source of error, and neither are the positions.
  std::optional<std::array<float, 16>> matrix;
  /// Where parts of the scene are held in frames of their own: together all points of the mesh, in
  /// its order. Then shift, scale, matrix and premultiplied say nothing.
  std::vector<RasterPart> parts;
  /// Whether model-view and projection are multiplied to one matrix before corners meet them.
  bool premultiplied = true;
  /// Corners are snapped to multiples of 2^−subpixel_bits pixel.
  int subpixel_bits = 8;
  /// Whether triangles are cut at the border of the image, or may be, or are not.
  enum class Cut { always, unknown, never } border = Cut::unknown;

  /// From depths to window depths, of the one that is interpolated.
  Mapping mapping = Mapping::opengl;
  Storage storage = Storage::unorm24;
  /// What a fragment shader writes in place of the interpolated window depth; `mapping` is then
  /// that of the interpolated one, between whose near and far triangles are cut.
  std::optional<WrittenDepth> written;
  /// Whether depth is interpolated between corners as they were before they were snapped.
  bool depth_before_snap = false;
  /// Whether a window depth is rounded to the nearest code, or to either of the two about it.
  bool nearest_codes = true;
  /// Depths were decoded from window depths in binary32 before they reached us.
  bool decoded_in_binary32 = false;
  /// Added to every window depth (polygon offset), and how uncertain that is.
  double bias = 0, bias_error = 0;
  /// Depth and not window depth is interpolated linearly: a fault, for hypotheses.
  bool affine = false;

  /// The mapping of what is stored.
  [[nodiscard]] Mapping stored_mapping() const { return written ? written->mapping : mapping; }
};

/// A ray is intersected with triangles; the depth of the hit is stored as binary32.
struct RayModel {
  /// Corners are held in binary32 as position − shift. Frame: world, scene units.
  std::array<double, 3> shift{0, 0, 0};
  /// Roundings that an edge test or a distance may have gone through.
  double roundings = 16;
  /// How far each entry of the camera's rotation may be off, where the renderer makes it anew.
  double rotation_error = 0;
  /// The depth of a hit is computed from its position in the world.
  bool depth_from_point = false;
};

/// Where in the pixel the sample lies, from its top left corner, and how far from there it may be
/// in either direction. In pixels.
struct SamplePosition {
  double x = 0.5, y = 0.5;
  double error = 0;
  /// Radial distortion of the lens, without a unit: what an ideal one shows at radius r of the
  /// plane at depth 1 is shown at r·(1 + k1·r² + k2·r⁴). Perspective only.
  /// Source   [Bro71], as OpenCV has it.
  double k1 = 0, k2 = 0;
};

/// What renderers of all kinds have, and the kind.
struct RendererModel {
  std::string name;
  SamplePosition sample;
  /// No sample between two triangles that share an edge is missed.
  bool watertight = true;
  /// Of triangles with the same corners, which have equal depths whatever the roundings are, the
  /// one that is seen, where the renderer's rule is known. Triangles are drawn in the order of
  /// their numbers.
  std::optional<EqualDepths> equal_depths;
  /// What was written down in place of the depths, where that is known; depths of the map are then
  /// those that its values mean.
  std::optional<RecordedDepth> recorded;
  std::variant<RasterModel, RayModel> kind;
};

}  // namespace fathom::attribution
