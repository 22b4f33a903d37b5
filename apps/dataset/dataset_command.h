#pragma once

#include <string>

#include "apps/jobs/job.h"
#include "apps/render/render_arguments.h"
#include "apps/shell/command.h"

namespace fathom::app {

/// What every layout of `fathom dataset` takes. Of the arguments of `render`, whose plans are made
/// for the maps, those count that the layout declares.
struct DatasetArguments {
  RenderArguments render;
  CameraChanges camera_changes;
  std::string input, folder;
  Shard shard;
  bool overwrites = false;

  /// INPUT, which `input` describes, --output, --threads, --shard, --overwrite and the like.
  void add_to(Command& command, const std::string& input);
  /// --mesh, where the scene is the same in every map.
  void add_scene_to(Command& command);

  /// A job with what these arguments say of any.
  [[nodiscard]] Job job() const;
};

/// The layouts of data sets, each a command of its own below `fathom dataset`.
void add_maps_layout(Command& family);
void add_depth_image_layouts(Command& family);
void add_colmap_layout(Command& family);
void add_bop_layout(Command& family);

/// fathom dataset maps | colmap | … : the maps of a whole data set, in its own layout.
void add_dataset(Command& program);

}  // namespace fathom::app
