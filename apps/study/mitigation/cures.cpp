#include "apps/study/mitigation/cures.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

#include "apps/study/cell.h"
#include "apps/study/sweeps.h"

namespace fathom::studies {

DepthFormat uncured_format(const Camera& camera) {
  return format_between(camera.near, camera.far, Mapping::standard, uncured_storage);
}

double nearest_depth(const DepthMap& visible) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const float z : *visible.values<float>("Z")) {
    nearest = std::min(nearest, static_cast<double>(z));
  }
  return nearest;
}

std::vector<Cure> farther_near_planes(const SceneView& view, const DepthMap& visible) {
  std::vector<Cure> cures;
  const double nearest = 0.999 * nearest_depth(visible);
  for (double near = view.camera.near;; near = std::min(2 * near, nearest)) {
    SceneView moved = view;
    moved.camera.near = near;
    cures.push_back({"near " + text_of(near, ".3g"),
                     buffer_scene(moved, visible, uncured_format(moved.camera)).fights});
    if (near >= nearest) return cures;
  }
}

std::vector<Cure> other_formats(const SceneView& view, const DepthMap& visible) {
  constexpr std::pair<Mapping, Storage> all[] = {
      {Mapping::standard, uncured_storage},  {Mapping::standard, Storage::unorm32},
      {Mapping::standard, Storage::float32}, {Mapping::reversed, uncured_storage},
      {Mapping::reversed, Storage::float32}, {Mapping::reversed_infinite, Storage::float32},
      {Mapping::linear, uncured_storage},    {Mapping::log, uncured_storage},
      {Mapping::log, Storage::float32},      {Mapping::log_ulrich, uncured_storage}};
  std::vector<Cure> cures;
  for (const auto& [mapping, storage] : all) {
    const DepthFormat format = format_between(view.camera.near, view.camera.far, mapping, storage);
    cures.push_back({label_of(format), buffer_scene(view, visible, format).fights});
  }
  return cures;
}

std::vector<OffsetCount> polygon_offsets(const SceneView& view) {
  if (view.scene.objects.size() < 2 || !is_perspective(view.camera.projection)) return {};
  const auto first =
      static_cast<std::uint32_t>(view.scene.meshes[view.scene.objects[0].mesh].triangles.size());
  const std::vector<LayeredSample> samples = layered_samples(view);
  const OffsetLayers layers(view, samples, uncured_format(view.camera), first);
  constexpr std::size_t units = std::size(offset_units);
  std::vector<OffsetCount> counts(std::size(offset_factors) * units);
  tbb::parallel_for(std::size_t{0}, counts.size(), [&](std::size_t i) {
    counts[i] = count_with_offset(layers, {offset_factors[i / units], offset_units[i % units], 0});
  });
  return counts;
}

}  // namespace fathom::studies
