#pragma once

#include <string>
#include <vector>

#include "apps/options/camera_options.h"
#include "apps/options/render_options.h"
#include "apps/options/scene_options.h"
#include "apps/render/depth_buffer_options.h"
#include "apps/render/pipeline_options.h"

namespace fathom::app {

/// The arguments of `fathom render`.
struct RenderArguments {
  SceneOptions scene;
  CameraOptions camera;
  StorageOptions storage;
  DepthBufferArguments depth_buffer;
  PipelineArguments pipeline;
  std::string output, save_camera, statistics, verify, samples;
  std::string engine = "fast", channels, cull = "none";
  bool stream = false, deep = false, cryptomatte = false;
};

/// The names of the maps: of a camera path, the option's pattern with {index} filled in.
std::vector<std::string> map_names(const char* option, const std::string& pattern,
                                   std::size_t cameras);

}  // namespace fathom::app
