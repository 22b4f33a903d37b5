#include "fathom/render.h"

#include <algorithm>
#include <utility>

#include "fathom/area/deep_pixels.h"
#include "fathom/failures/errors.h"
#include "fathom/fast/render_fast.h"
#include "fathom/image/depth_map.h"
#include "fathom/map_description.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/reference/reference.h"
#include "fathom/rendering/options.h"
#include "fathom/scene/scene_fault.h"
#include "fathom/threads/threads.h"

namespace fathom {
using namespace area;

namespace {

void describe(const Scene& scene, const Camera& camera, const RenderOptions& options,
              DepthMap& map) {
  describe_map(scene, camera, name_of(options.engine), map);
  if (options.cull != Cull::none) {
    map.texts[cull_text] = name_of(options.cull);
  }
  if (options.normals != NormalSource::file && map.find("Ns.X")) {
    map.texts[normals_text] = name_of(options.normals);
  }
}

/// Counts surfaces without a code, if depths beyond the greatest code are stored as background: all
/// other surfaces have a code above 0.
void count_codes_beyond(const RenderOptions& options, const RenderStatistics& statistics,
                        DepthMap& map) {
  const DepthEncoding& encoding = options.depth_encoding;
  if (encoding.type != StoredType::scaled_unorm16 || !encoding.beyond_is_none) return;
  std::uint64_t beyond = 0;
  for (const ImageChannel& channel : map.channels) {
    const auto* codes = std::get_if<Samples<std::uint16_t>>(&channel.values);
    if (!codes) continue;
    const auto none = static_cast<std::uint64_t>(std::count(codes->begin(), codes->end(), 0));
    beyond = std::max(beyond, statistics.pixels_with_surface + none - codes->size());
  }
  map.codes_beyond = beyond;
}

}  // namespace

Rendered render(const Scene& scene, const Camera& camera, const RenderOptions& options,
                const RenderContext& context) {
  const StandardArithmetic standard;
  Rendered rendered;
  render_into(rendered, scene, camera, options, context);
  return rendered;
}

void render_into(Rendered& rendered, const Scene& scene, const Camera& camera,
                 const RenderOptions& options, const RenderContext& context) {
  const StandardArithmetic standard;
  DepthMap before = std::exchange(rendered, {}).map;
  Rendered now = options.engine == Engine::fast
                     ? render_fast(scene, camera, options, context, std::move(before))
                     : render_reference(scene, camera, options, context, std::move(before));
  finish_map(now.map, scene, camera, options, now.statistics);
  rendered = std::move(now);
}

void finish_map(DepthMap& map, const Scene& scene, const Camera& camera,
                const RenderOptions& options, const RenderStatistics& statistics) {
  const StandardArithmetic standard;
  count_codes_beyond(options, statistics, map);
  describe(scene, camera, options, map);
}

Rendered render(const StreamedScene& scene, const Camera& camera, const RenderOptions& options,
                const StreamLimits& limits, const RenderContext& context) {
  const StandardArithmetic standard;
  if (options.engine != Engine::fast) {
    throw UsageError("only the fast engine renders a scene that stays in its files");
  }
  Rendered rendered = render_streamed(scene, camera, options, limits, context);
  finish_map(rendered.map, outline_of(scene), camera, options, rendered.statistics);
  return rendered;
}

DeepMap render_deep(const Scene& scene, const Camera& camera, const RenderOptions& options,
                    const RowShare& share, const std::function<void(double)>& progress) {
  const StandardArithmetic standard;
  require_thread_count(options.threads);
  require_renderable(scene, camera);
  DeepMap map = visible_in_pixels(scene, camera, options, share, progress);
  describe(scene, camera, options, map.description);
  map.description.texts.erase(engine_text);
  return map;
}

}  // namespace fathom
