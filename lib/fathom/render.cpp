#include "fathom/render.h"

#include "fathom/area/deep_pixels.h"
#include "fathom/fast/render_fast.h"
#include "fathom/map_description.h"
#include "fathom/numeric/errors.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/reference/reference.h"
#include "fathom/scene/scene_fault.h"
#include "fathom/threads/threads.h"
#include "fathom/triangle/map_of_camera.h"

namespace fathom {
using namespace area;
using namespace triangle;

namespace {

void describe(const Scene& scene, const Camera& camera, const RenderOptions& options,
              DepthMap& map) {
  describe_map(scene, camera, name_of(options.engine), map);
  if (options.cull != Cull::none) {
    map.texts["fathom.cull"] = options.cull == Cull::back ? "back" : "front";
  }
}

}  // namespace

DepthMap render(const Scene& scene, const Camera& camera, const RenderOptions& options) {
  const StandardArithmetic standard;
  DepthMap map = options.engine == Engine::fast ? render_fast(scene, camera, options)
                                                : render_reference(scene, camera, options);
  describe(scene, camera, options, map);
  return map;
}

DepthMap render(const StreamedScene& scene, const Camera& camera, const RenderOptions& options,
                const StreamLimits& limits) {
  const StandardArithmetic standard;
  if (options.engine != Engine::fast) {
    throw UsageError("only the fast engine renders a scene that stays in its files");
  }
  DepthMap map = render_streamed(scene, camera, options, limits);
  describe(outline_of(scene), camera, options, map);
  return map;
}

DeepMap render_deep(const Scene& scene, const Camera& camera, const RenderOptions& options) {
  const StandardArithmetic standard;
  require_thread_count(options.threads);
  require_renderable(scene, camera);
  DeepMap map = visible_in_pixels(scene, camera, options);
  describe(scene, camera, options, map.description);
  map.description.texts.erase("fathom.engine");
  return map;
}

void add_cryptomatte(DepthMap& map, const Scene& scene, const Camera& camera,
                     const RenderOptions& options) {
  const StandardArithmetic standard;
  require_thread_count(options.threads);
  // A map that is yet to get its channels is of the size that its areas are computed for.
  if (!map.channels.empty()) require_map_of(camera, map);
  require_renderable(scene, camera);
  std::vector<std::uint32_t> ids;
  for (const Object& object : scene.objects) ids.push_back(cryptomatte_id(object.name));
  const TriangleSource triangles(scene);
  Mattes mattes = mattes_in_pixels(triangles, camera, options, [&](std::uint32_t number) {
    return ids[triangles.origin(number).object];
  });
  mattes.layer = "CryptoObject";
  for (const Object& object : scene.objects) mattes.names.push_back(object.name);
  add_mattes(map, mattes);
}

}  // namespace fathom
