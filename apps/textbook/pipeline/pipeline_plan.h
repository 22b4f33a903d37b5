#pragma once

#include <optional>
#include <vector>

#include "apps/render/render_arguments.h"
#include "fathom/pipeline/render_moving.h"

namespace fathom::app {

/// How the pipeline makes maps and pictures: what the arguments mean together.
struct PipelinePlan {
  MapFormat format = MapFormat::exr;
  WriteOptions writing;
  StorageOptions storage;
  std::vector<Channel> channels;
  pipeline::PipelineOptions stages;
  bool with_picture = false;
  bool with_depth_buffer = false;
  /// Of a scene that moves meanwhile.
  std::optional<pipeline::Shutter> shutter;
};

/// Fails    UsageError where the arguments contradict each other, before any work.
PipelinePlan plan_pipeline(const RenderArguments& arguments);

}  // namespace fathom::app
