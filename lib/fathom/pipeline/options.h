#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "fathom/depth_format/depth_bias.h"
#include "fathom/depth_format/depth_format.h"
#include "fathom/mesh/vertex_normals.h"

/// The options of the pipeline.
namespace fathom::pipeline {

/// The format to which every operation from the vertex transform to the interpolated fragment
/// rounds. Colours are always computed in binary64.
enum class Precision { binary32, binary64 };

enum class Culling { none, back, front };
enum class FrontFace { counter_clockwise, clockwise };

enum class ScanConversion {
  edge_function,  ///< on the subpixel grid, in integers
  scan_line,      ///< along edges, then along spans, in floating point
};
enum class Interpolation { affine, perspective };
/// `points` draws the corners of triangles as points, `wireframe` draws their edges as lines.
enum class Shading { none, points, wireframe, flat, gouraud, phong };
/// How highlights are computed: from the vector halfway between light and eye ([Bli77]), or from
/// the mirrored light ([Pho75]).
enum class SpecularModel { blinn, phong };
using fathom::NormalSource;
/// Colours of triangles: the colours of their vertices in the file, white if there are none; or the
/// colours that previews give to the numbers of objects or triangles.
enum class SurfaceColours { file, object, triangle };
enum class TextureFilter { nearest, bilinear, trilinear, anisotropic };
enum class HiddenSurface { z_buffer, painter };
enum class WireLine { explicit_equation, dda, bresenham, midpoint, diamond_exit };

/// Whether the depth test may discard blended fragments, and whether they write depth.
enum class BlendDepth {
  off,       ///< every fragment is blended; the depth buffer still keeps the nearest
  on,        ///< fragments that fail the test are discarded; all others write depth
  read_only  ///< fragments that fail the test are discarded; no fragment writes depth
};

/// The order in which triangles are drawn. The depth of a triangle is the depth of the mean of its
/// corners.
enum class DrawOrder { file, front_to_back, back_to_front, random };

/// `temporal` and `temporal_area` are for scenes that move (render_moving.h).
enum class AntialiasMethod { none, ssaa, msaa, jitter, area, fxaa, taa, temporal, temporal_area };
/// What counts as an edge for FXAA, and how much of it is smoothed; the defaults are the published
/// values.
struct FxaaSettings {
  /// The least range of luma around a pixel on an edge: relative to the greatest luma there, and
  /// absolute.
  double threshold = 0.166, least_threshold = 0.0833;
  /// How strongly details smaller than a pixel are smoothed, from 0 to 1.
  double subpixel = 0.75;
};

struct Antialias {
  AntialiasMethod method = AntialiasMethod::none;
  /// ssaa: n of n × n; msaa: 1, 2, 4, 8 or 16; jitter: 1, 4, 16, 64 or 256; taa, temporal: frames.
  int count = 1;
  /// msaa: use the 2 × 2 grid turned by arctan ½ and enlarged by √5/2 instead of the standard
  /// positions.
  bool rotated_grid = false;
  FxaaSettings fxaa;
};

/// A rectangle of the window in whole pixels, its origin the lower left corner of the window as in
/// OpenGL.
struct WindowRectangle {
  std::int64_t x = 0, y = 0;
  std::int64_t width = 0, height = 0;
};

using Colour = std::array<double, 3>;

/// A light so far away that it comes from one direction.
struct LightSource {
  /// The direction towards the light, of any length except 0: in the world, or in the camera's
  /// frame (x right, y down, z forward). The default light is above the camera's left shoulder.
  std::array<double, 3> towards{-0.45, -0.65, -1};
  bool in_world = false;
};

/// How surfaces reflect: colour·(ambient + diffuse·N·L) + specular·(cos of the
/// highlight)^shininess.
struct Material {
  double ambient = 0.15, diffuse = 0.75, specular = 0.25, shininess = 40;
  SpecularModel highlight = SpecularModel::blinn;
};

struct PipelineOptions {
  Precision precision = Precision::binary32;
  /// `near` and `far` are the camera's; missing ones are filled in.
  DepthFormat depth_format{Mapping::standard, Storage::float32, 0, 0, 1};
  std::optional<WindowRectangle> viewport;  ///< default: the window
  std::optional<WindowRectangle> scissor;   ///< default: the window
  /// The window depths of near and far (glDepthRange), each in [0, 1].
  std::array<double, 2> depth_range{0, 1};
  Culling culling = Culling::none;
  FrontFace front_face = FrontFace::counter_clockwise;
  /// The grid of corners in the window has 2^subpixel_bits steps a pixel.
  int subpixel_bits = 8;
  ScanConversion scan = ScanConversion::edge_function;
  /// Blocks of 8 × 8 pixels are tested before their samples; the picture does not change.
  bool blocks = true;
  /// The depth test comes before shading; the picture does not change.
  bool early_depth = true;
  Interpolation interpolation = Interpolation::perspective;
  Shading shading = Shading::flat;
  NormalSource normals_from = NormalSource::file;
  SurfaceColours colours = SurfaceColours::file;
  LightSource light;
  Material material;
  WireLine wire_line = WireLine::bresenham;
  /// "", "checker" or a PNG file.
  std::string texture;
  TextureFilter filter = TextureFilter::trilinear;
  HiddenSurface hidden_surface = HiddenSurface::z_buffer;
  /// For objects without their own setting (DrawState in scene/scene.h).
  DepthBias polygon_offset;
  /// Blends each fragment over the picture with this opacity instead of selecting the nearest.
  std::optional<double> blend_alpha;
  BlendDepth blend_depth = BlendDepth::off;
  DrawOrder draw_order = DrawOrder::file;
  std::uint64_t draw_seed = 0;  ///< of a random order
  Antialias antialias;
  Colour background{0, 0, 0};
};

/// Results of the three tests of back_face_culling.h on the triangles that clipping did not cut.
struct FacingStatistics {
  std::uint64_t compared = 0;
  std::uint64_t front_in_world = 0, front_in_ndc = 0, front_in_window = 0;
  std::uint64_t disagreeing = 0;  ///< triangles on which the three tests disagree
};

/// Counts of the work that the pipeline did.
struct PipelineStatistics {
  std::uint64_t triangles = 0;
  std::uint64_t not_finite = 0;    ///< left out, lines and points too: a corner is no number then
  std::uint64_t clipped_away = 0;  ///< outside of the view volume
  std::uint64_t clipped = 0;       ///< cut at its boundary
  std::uint64_t degenerate = 0;    ///< no area in the window
  std::uint64_t culled = 0;
  std::uint64_t drawn = 0;               ///< triangles that reach scan conversion
  std::uint64_t lines = 0, points = 0;   ///< of the files, that do
  std::uint64_t turned_by_snapping = 0;  ///< front to back or to nothing
  std::uint64_t fragments = 0;
  std::uint64_t depth_passed = 0;
  std::uint64_t shaded = 0;
  std::uint64_t blocks_skipped = 0, blocks_full = 0;
  double near = 0, far = 0;  ///< clip planes, in scene units from the camera
  FacingStatistics facings;
};

/// Refuses meaningless or incompatible options.
/// Fails    UsageError.
void require_meaningful(const PipelineOptions& options);

}  // namespace fathom::pipeline
