#include "validation/studies/z_fighting/scene_fights.h"

#include <algorithm>
#include <cmath>

#include "validation/studies/formats.h"

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

std::vector<StudyFile> pictures_of(const std::string& name, const BufferedScene& buffered) {
  const auto& fight = *buffered.map.values<std::uint32_t>("Zfight");
  const auto& error = *buffered.map.values<float>("Zerror");
  const auto& id = *buffered.map.values<std::uint32_t>("id");
  DepthMap map;
  map.width = buffered.map.width;
  map.height = buffered.map.height;
  const std::string format = label_of(buffered.fights.format);
  const std::string wrong = "wrong surface, " + format, off = "depth error, " + format;
  map.channels = {{"id", id}, {wrong, Samples<float>(fight.begin(), fight.end())}, {off, error}};
  const double end = std::max(buffered.fights.greatest_error, 1e-30);
  return {picture("fights-" + name, map,
                  {.channel = wrong, .colours = ColourMap::grey, .low = 0, .high = 1}),
          picture("error-" + name, map,
                  {.channel = off, .colours = ColourMap::viridis, .low = -end, .high = end})};
}

}  // namespace fathom::studies
