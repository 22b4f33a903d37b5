// The functions of render.h that make Cryptomatte channels.

#include <atomic>
#include <string>
#include <utility>
#include <vector>

#include "fathom/area/deep_pixels.h"
#include "fathom/failures/errors.h"
#include "fathom/image/channel_table.h"
#include "fathom/image/cryptomatte.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/render.h"
#include "fathom/rendering/map_background.h"
#include "fathom/rendering/segment_channels.h"
#include "fathom/scene/scene_fault.h"
#include "fathom/scene/scene_segments.h"
#include "fathom/threads/threads.h"

namespace fathom {
using namespace area;
using namespace rendering;

namespace {

std::vector<std::uint32_t> ids_of(const std::vector<std::string>& names) {
  std::vector<std::uint32_t> ids;
  ids.reserve(names.size());
  for (const std::string& name : names) ids.push_back(cryptomatte_id(name));
  return ids;
}

Mattes mattes_by_object(const Scene& scene, const Camera& camera, const RenderOptions& options,
                        const RowShare& share, const std::function<void(double)>& progress) {
  std::vector<std::string> names;
  for (const Object& object : scene.objects) names.push_back(object.name);
  const std::vector<std::uint32_t> ids = ids_of(names);
  const TriangleSource triangles(scene);
  const auto matte_of = [&](std::uint32_t number) { return ids[triangles.origin(number).object]; };
  Mattes mattes = mattes_in_pixels(triangles, camera, options, matte_of, share, progress);
  mattes.layer = "CryptoObject";
  mattes.names = std::move(names);
  return mattes;
}

std::string layer_of(Segmentation by) {
  std::string name(description_of(channel_of(by)).name);
  name[0] = static_cast<char>(name[0] - 'a' + 'A');
  return "Crypto" + name;
}

/// Triangles that belong to no segment have the empty name, which is listed where one is visible.
Mattes mattes_by_segment(const Scene& scene, const Camera& camera, const RenderOptions& options,
                         Segmentation by, const RowShare& share,
                         const std::function<void(double)>& progress) {
  const TriangleSource triangles(scene);
  const SceneSegments segments(triangles, {by});
  const std::vector<std::uint32_t> ids = ids_of(segments.names(by));
  std::atomic<bool> some_without_name = false;
  const auto matte_of = [&](std::uint32_t number) {
    const std::uint32_t segment = segments.number(by, triangles.origin(number));
    if (segment != unsegmented) return ids[segment];
    some_without_name = true;
    return cryptomatte_id("");
  };
  Mattes mattes = mattes_in_pixels(triangles, camera, options, matte_of, share, progress);
  mattes.layer = layer_of(by);
  mattes.names = segments.names(by);
  if (some_without_name) mattes.names.emplace_back();
  return mattes;
}

}  // namespace

void add_cryptomatte(DepthMap& map, const Scene& scene, const Camera& camera,
                     const RenderOptions& options, std::optional<Segmentation> by,
                     const std::function<void(double)>& progress) {
  const StandardArithmetic standard;
  // A map that is yet to get its channels is of the size that its areas are computed for.
  if (!map.channels.empty()) require_map_of(camera, map);
  add_mattes(map, find_mattes(scene, camera, options, by, {}, progress));
}

Mattes find_mattes(const Scene& scene, const Camera& camera, const RenderOptions& options,
                   std::optional<Segmentation> by, const RowShare& share,
                   const std::function<void(double)>& progress) {
  const StandardArithmetic standard;
  if (by == Segmentation::label) throw UsageError("labels have no names, which Cryptomatte needs");
  require_thread_count(options.threads);
  require_renderable(scene, camera);
  return by ? mattes_by_segment(scene, camera, options, *by, share, progress)
            : mattes_by_object(scene, camera, options, share, progress);
}

}  // namespace fathom
