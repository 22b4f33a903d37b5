#include "apps/study/z_fighting/scene_fights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/study/sweeps.h"
#include "fathom/camera/camera_files.h"

namespace fathom::studies {

BufferedScene buffer_scene(const SceneView& view, const DepthMap& visible,
                           const DepthFormat& format) {
  BufferedScene buffered{{.format = format}, visible};
  buffered.fights.fighting =
      add_depth_buffer(buffered.map, view.scene, view.camera, {format, true, {}}).fighting;
  const auto& id = *buffered.map.values<std::uint32_t>("id");
  const auto& error = *buffered.map.values<float>("Zerror");
  for (std::size_t i = 0; i < id.size(); ++i) {
    if (id[i] == no_surface) continue;
    ++buffered.fights.surface_pixels;
    buffered.fights.greatest_error =
        std::max(buffered.fights.greatest_error, static_cast<double>(std::abs(error[i])));
  }
  return buffered;
}

std::vector<FightPicture> pictures_of(const std::string& name, const BufferedScene& buffered,
                                      const std::string& scene, const std::string& camera) {
  const DepthFormat& format = buffered.fights.format;
  const std::string unit = fmt::format("{}, near {:.3g}", label_of(format), format.near);
  const double end = std::max(buffered.fights.greatest_error, 1e-30);
  const std::string map = fmt::format(
      "fathom render {} --camera {} --depth-format {} --mapping {} --against-exact -o map.exr",
      scene, camera, name_of(format.storage), name_of(format.mapping));
  return {{picture("fights-" + name, buffered.map, {.channel = "Zfight", .unit = unit}),
           fmt::format("{} && fathom preview map.exr --channel Zfight --unit '{}' -o fights-{}.png",
                       map, unit, name)},
          {picture("error-" + name, buffered.map,
                   {.channel = "Zerror", .low = -end, .high = end, .unit = unit}),
           fmt::format("{} && fathom preview map.exr --channel Zerror --range {},{} --unit '{}' "
                       "-o error-{}.png",
                       map, -end, end, unit, name)}};
}

StudyFile camera_file(const std::string& name, const Camera& camera) {
  return {name + ".json", to_json(camera) + "\n"};
}

}  // namespace fathom::studies
