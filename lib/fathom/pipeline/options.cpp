#include "fathom/pipeline/options.h"

#include <cmath>

#include "fathom/failures/errors.h"
#include "fathom/pipeline/geometry/subpixel_grid.h"
#include "fathom/pipeline/geometry/vertex_transform.h"

namespace fathom::pipeline {
namespace {

void require_rectangle(const std::optional<WindowRectangle>& r, const Setting& setting) {
  if (r && (r->width < 1 || r->height < 1))
    throw UsageError(setting, "expected a size of at least 1x1");
  constexpr std::int64_t most = 1 << 20;
  if (r && (r->width > most || r->height > most || r->x > most || r->x < -most || r->y > most ||
            r->y < -most))
    throw UsageError(setting, "beyond 1048576 pixels");
}

void require_count(const Antialias& antialias) {
  const Setting setting{"antialias"};
  const int n = antialias.count;
  if (antialias.method == AntialiasMethod::msaa && n != 1 && n != 2 && n != 4 && n != 8 && n != 16)
    throw UsageError(setting,
                     "msaa:" + std::to_string(n) + " does not exist; there are 1, 2, 4, 8 and 16");
  if (antialias.method == AntialiasMethod::ssaa && (n < 1 || n > 16))
    throw UsageError(setting, "ssaa:N takes 1 to 16, for N times N samples");
  if (antialias.method == AntialiasMethod::jitter && n != 1 && n != 4 && n != 16 && n != 64 &&
      n != 256)
    throw UsageError(setting,
                     "jitter:" + std::to_string(n) +
                         " does not exist; there are 1, 4, 16, 64 and 256: squares of cells");
  if (n < 1 || n > 256) throw UsageError(setting, "expected 1 to 256 samples");
  const FxaaSettings& f = antialias.fxaa;
  for (const double share : {f.threshold, f.least_threshold, f.subpixel})
    if (!(share >= 0 && share <= 1))
      throw UsageError(setting, "fxaa:THRESHOLD,LEAST,SUBPIXEL takes numbers from 0 to 1");
}

bool offsets_depths(const DepthBias& bias) {
  return bias.slope_factor != 0 || bias.constant_factor != 0;
}

/// Polygon offset and depth range change the depths that the projection and the viewport produce;
/// depths that fragments compute do not pass through them.
void require_projected_depths(const PipelineOptions& o) {
  if (!is_per_fragment(o.depth_format.mapping)) return;
  const std::string reason =
      "does not reach the depths of mapping " + std::string(name_of(o.depth_format.mapping)) +
      ", which fragments compute; there are standard, reversed, infinite, reversed-infinite and "
      "opengl";
  if (offsets_depths(o.polygon_offset)) throw UsageError(Setting{"polygon_offset"}, reason);
  if (o.depth_range != std::array<double, 2>{0, 1})
    throw UsageError(Setting{"depth_range"}, reason);
}

void require_light(const LightSource& light, const Material& material) {
  const auto& [x, y, z] = light.towards;
  if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z) || (x == 0 && y == 0 && z == 0))
    throw UsageError(Setting{"light"}, "expected three finite numbers, not all of them 0");
  for (const double m : {material.ambient, material.diffuse, material.specular, material.shininess})
    if (!(m >= 0 && std::isfinite(m)))
      throw UsageError(Setting{"material"}, "expected four finite numbers, none below 0");
}

}  // namespace

void require_meaningful(const PipelineOptions& o) {
  if (o.subpixel_bits < 0 || o.subpixel_bits > most_subpixel_bits)
    throw UsageError(Setting{"subpixel_bits"}, "expected 0 to 16");
  require_rectangle(o.viewport, {"viewport"});
  require_rectangle(o.scissor, {"scissor"});
  for (const double d : o.depth_range)
    if (!(d >= 0 && d <= 1))
      throw UsageError(Setting{"depth_range"}, "expected two numbers from 0 to 1");
  require_projected_depths(o);
  require_count(o.antialias);
  const bool one_sample =
      o.antialias.method == AntialiasMethod::none || o.antialias.method == AntialiasMethod::fxaa;
  if (o.scan == ScanConversion::scan_line && !one_sample)
    throw UsageError(Setting{"scan"},
                     "scan-line samples pixel centres only; it allows no antialiasing but fxaa");
  const bool has_areas = o.shading != Shading::points && o.shading != Shading::wireframe;
  if (o.hidden_surface == HiddenSurface::painter && !has_areas)
    throw UsageError(Setting{"hidden_surface"},
                     "painter draws areas; points and wireframe have none");
  const bool by_area = o.antialias.method == AntialiasMethod::area ||
                       o.antialias.method == AntialiasMethod::temporal_area;
  if (!has_areas && by_area)
    throw UsageError(Setting{"antialias"},
                     "area draws triangles; points and wireframe have msaa, ssaa and others");
  if (o.hidden_surface == HiddenSurface::painter && offsets_depths(o.polygon_offset))
    throw UsageError(Setting{"polygon_offset"}, "the painter compares no depths to be offset");
  if (o.hidden_surface == HiddenSurface::painter && o.blend_depth != BlendDepth::off)
    throw UsageError(Setting{"blend_depth"}, "the painter has no depth test");
  require_light(o.light, o.material);
  for (const double component : o.background)
    if (!std::isfinite(component))
      throw UsageError(Setting{"background"}, "expected three finite numbers");
  // A clamp of NaN means no clamp.
  if (!std::isfinite(o.polygon_offset.slope_factor) ||
      !std::isfinite(o.polygon_offset.constant_factor))
    throw UsageError(Setting{"polygon_offset"}, "expected finite numbers");
  if (o.blend_alpha && by_area)
    throw UsageError(Setting{"antialias"}, "area sees the nearest surface; it does not blend");
  if (o.blend_alpha && !(*o.blend_alpha >= 0 && *o.blend_alpha <= 1))
    throw UsageError(Setting{"blend_alpha"}, "expected 0 to 1");
  if (o.draw_order != DrawOrder::file && o.hidden_surface == HiddenSurface::painter)
    throw UsageError(Setting{"draw_order"}, "the painter's algorithm decides the order");
}

}  // namespace fathom::pipeline
