#pragma once

#include <string>
#include <vector>

#include "apps/study/study_scene.h"
#include "fathom/depth_buffer/depth_buffer.h"

/// Z-fighting over the image of a scene, ideal model.
namespace fathom::studies {

struct SceneFights {
  DepthFormat format;
  std::uint64_t surface_pixels = 0, fighting = 0;
  /// Greatest |decoded − exact| depth.
  double greatest_error = 0;
  [[nodiscard]] double share() const {
    return surface_pixels == 0
               ? 0
               : static_cast<double>(fighting) / static_cast<double>(surface_pixels);
  }
};

/// What a format makes of what is visible; `map` has Z and id.
struct BufferedScene {
  SceneFights fights;
  /// With the channels of depth_buffer.h.
  DepthMap map;
};
BufferedScene buffer_scene(const SceneView& view, const DepthMap& visible,
                           const DepthFormat& format);

/// A picture, and the command that draws it in the folder of the page.
struct FightPicture {
  StudyFile png;
  std::string command;
};
/// fights-NAME: where it fights; error-NAME: how far decoded depths are off. The commands read
/// these files of the scene and its camera.
std::vector<FightPicture> pictures_of(const std::string& name, const BufferedScene& buffered,
                                      const std::string& scene, const std::string& camera);

/// NAME.json
StudyFile camera_file(const std::string& name, const Camera& camera);

}  // namespace fathom::studies
