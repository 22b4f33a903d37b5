#pragma once

#include <string>
#include <vector>

#include "camera_options.h"
#include "depth_buffer_options.h"
#include "pipeline_options.h"
#include "render_options.h"
#include "scene_options.h"

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
