#pragma once

#include <array>
#include <optional>
#include <string>

#include "fathom/attribution/written_depth.h"
#include "fathom/camera/camera.h"
#include "fathom/depth_format/depth_format.h"

/// What is assumed of a renderer that is held against the truth. docs/validation.md derives the
/// bounds that follow from it.
namespace fathom::attribution {

/// How a depth D becomes a window depth z: perspective z = a + b/D, orthographic z = a·D + b,
/// logarithmic z = ln(D/near)/ln(far/near).
struct WindowDepth {
  bool perspective = true;
  /// Whether the renderer passes through z_ndc = 2z − 1 (OpenGL's default).
  bool minus_one_to_one = true;
  double a = 0, b = 0;
  /// Of a logarithmic one; ln(far/near) is 0 of the others.
  double near = 0, log_range = 0;

  [[nodiscard]] double of_depth(double depth) const;
  /// Infinite where no finite depth has this window depth or one beyond it.
  [[nodiscard]] double to_depth(double window) const;
  /// Whether nearer surfaces have greater window depths.
  [[nodiscard]] bool reversed() const { return log_range == 0 && (perspective ? b > 0 : a < 0); }
};

/// `mapping` is standard, opengl, log_ulrich or one of the reversed and infinite ones.
WindowDepth window_depth(Projection projection, Mapping mapping, double near, double far);

struct RendererModel {
  enum class Kind {
    raster,  ///< corners are transformed and snapped, window depth is interpolated and stored
    ray      ///< a ray is intersected with triangles, the depth of the hit is stored as binary32
  };

  std::string name;
  Kind kind = Kind::raster;
  /// Positions are held in binary32 as differences from this point, times a scale.
  std::array<double, 3> shift{0, 0, 0}, scale{1, 1, 1};
  /// Where in the pixel the sample lies, from its top left corner, and how far from there it may
  /// be in either direction.
  std::array<double, 2> sample{0.5, 0.5};
  double sample_error = 0;

  // raster
  int subpixel_bits = 8;
  Mapping mapping = Mapping::opengl;
  Storage storage = Storage::unorm24;
  /// What a fragment shader writes in place of the interpolated window depth; `mapping` is then
  /// that of the interpolated one, between whose near and far triangles are cut.
  std::optional<WrittenDepth> written;
  /// Whether model-view and projection are multiplied to one matrix before corners meet them.
  bool premultiplied = true;
  /// The matrix that takes held positions to clip coordinates, row by row, where it is known; its
  /// entries then are no source of error, and neither are the positions.
  std::optional<std::array<float, 16>> matrix;
  /// Whether depth is interpolated between corners as they were before they were snapped.
  bool depth_before_snap = false;
  /// Whether triangles are cut at the image's border, or may be, or are not.
  enum class Cut { always, unknown, never } border = Cut::unknown;
  /// Depths were decoded from window depths in binary32 before they reached us.
  bool decoded_in_binary32 = false;
  /// Added to every window depth (polygon offset), and how uncertain that is.
  double bias = 0, bias_error = 0;

  /// The mapping of what is stored.
  [[nodiscard]] Mapping stored_mapping() const { return written ? written->mapping : mapping; }

  // ray
  /// Roundings that an edge test or a distance may have gone through.
  double ray_roundings = 16;
  /// How far each entry of the camera's rotation may be off, where the renderer makes it anew.
  double rotation_error = 0;
  /// The depth of a hit is computed from its position in the world.
  bool depth_from_point = false;

  /// No sample between two triangles that share an edge is missed.
  bool watertight = true;
  /// Of triangles with the same corners the one of the lowest number is seen.
  bool first_of_equals = false;
  /// Linear interpolation of depth instead of window depth: a fault, for hypotheses.
  bool affine = false;
};

/// Names of the models that `--model` takes, with a line each that explains them.
std::string model_names();
/// Fails    UsageError where there is no such model.
RendererModel model_named(const std::string& name);

}  // namespace fathom::attribution
