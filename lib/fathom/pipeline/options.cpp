#include "fathom/pipeline/options.h"

#include <cmath>

#include "fathom/numeric/errors.h"
#include "fathom/pipeline/subpixel_grid.h"

namespace fathom::pipeline {
namespace {

void require_rectangle(const std::optional<WindowRectangle>& r, const std::string& option) {
  if (r && (r->width < 1 || r->height < 1))
    throw UsageError(option + ": a size of 0; expected at least 1x1");
  constexpr std::int64_t most = 1 << 20;
  if (r && (r->width > most || r->height > most || std::abs(r->x) > most || std::abs(r->y) > most))
    throw UsageError(option + ": beyond 1048576 pixels");
}

void require_count(const Antialias& antialias) {
  const int n = antialias.count;
  if (antialias.method == AntialiasMethod::msaa && n != 1 && n != 2 && n != 4 && n != 8 && n != 16)
    throw UsageError("--antialias: msaa:" + std::to_string(n) +
                     " does not exist; there are 1, 2, 4, 8 and 16");
  if (antialias.method == AntialiasMethod::ssaa && (n < 1 || n > 16))
    throw UsageError("--antialias: ssaa:N takes 1 to 16, for N times N samples");
  if (antialias.method == AntialiasMethod::jitter && n != 1 && n != 4 && n != 16 && n != 64 &&
      n != 256)
    throw UsageError("--antialias: jitter:" + std::to_string(n) +
                     " does not exist; there are 1, 4, 16, 64 and 256: squares of cells");
  if (n < 1 || n > 256) throw UsageError("--antialias: expected 1 to 256 samples");
}

}  // namespace

void require_meaningful(const PipelineOptions& o) {
  if (o.subpixel_bits < 0 || o.subpixel_bits > most_subpixel_bits)
    throw UsageError("--subpixel-bits: expected 0 to 16");
  require_rectangle(o.viewport, "--viewport");
  require_rectangle(o.scissor, "--scissor");
  for (const double d : o.depth_range)
    if (!(d >= 0 && d <= 1)) throw UsageError("--depth-range: expected two numbers from 0 to 1");
  require_count(o.antialias);
  const bool one_sample =
      o.antialias.method == AntialiasMethod::none || o.antialias.method == AntialiasMethod::fxaa;
  if (o.scan == ScanConversion::scan_line && !one_sample)
    throw UsageError("--scan scan-line samples centres only; it takes --antialias none or fxaa");
  const bool has_areas = o.shading != Shading::points && o.shading != Shading::wireframe;
  if (!has_areas && !one_sample)
    throw UsageError("--shading points and wireframe take --antialias none or fxaa");
  if (o.hidden_surface == HiddenSurface::painter && !has_areas)
    throw UsageError("--hidden-surface painter draws areas; points and wireframe have none");
  if (o.blend_alpha && !(*o.blend_alpha >= 0 && *o.blend_alpha <= 1))
    throw UsageError("--blend: an opacity is between 0 and 1");
}

}  // namespace fathom::pipeline
