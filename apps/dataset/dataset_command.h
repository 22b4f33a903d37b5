#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "apps/jobs/job.h"
#include "apps/render/render_arguments.h"
#include "apps/render/render_plan.h"
#include "apps/shell/command.h"
#include "apps/shell/console.h"
#include "fathom/camera/camera.h"
#include "fathom/image/depth_map.h"

namespace fathom::app {

/// The arguments of every layout of `fathom dataset`. The maps have plans of `render`, but only the
/// arguments of `render` that the layout declares have an effect.
struct DatasetArguments {
  RenderArguments render;
  CameraChanges camera_changes;
  std::string input, folder;
  Shard shard;
  bool overwrites = false;

  /// INPUT, which `input` describes, --output, --threads, --shard, --overwrite and the like.
  void add_to(Command& command, const std::string& input);
  /// --mesh, for layouts whose maps all show the same scene.
  void add_scene_to(Command& command);

  /// A job with the settings of these arguments.
  [[nodiscard]] Job job() const;
};

/// The layouts of data sets, each a command of its own below `fathom dataset`.
void add_maps_layout(Command& family);
void add_depth_image_layouts(Command& family);
void add_colmap_layout(Command& family);
void add_bop_layout(Command& family);

/// fathom dataset maps | colmap | … : the maps of a whole data set, in its own layout.
void add_dataset(Command& program);

/// Counts the pixels whose depths lie beyond the codes of their maps.
class CodesBeyond {
 public:
  void note(const DepthMap& map);
  /// Warns of these pixels, if there are any.
  void tell(const Console& console) const;

 private:
  std::uint64_t pixels_ = 0, maps_ = 0;
};

/// A file that each camera has in a layout.
struct FileOfView {
  /// Its name for each camera, below the folder of the data set.
  std::vector<std::string> names;
  /// Its bytes, from the map of a camera; `name` is the file's for messages. Called as
  /// Result::files.
  std::function<files::Bytes(const DepthMap& map, const MapPlan& plan, const std::string& name)>
      encode;
};

/// A layout in which each camera has a map, in one file or several.
struct Views {
  std::vector<Camera> cameras;
  /// Name of the files of a camera in messages; Job::noun.
  std::string noun;
  /// What the files depend on in addition to the map.
  std::string inputs;
  /// At least one; messages call a map as its first file.
  std::vector<FileOfView> files;
  /// Whether cameras.json is among the lists.
  bool has_camera_list = true;
  /// Other lists.
  std::vector<JobList> lists;
};

/// Makes the views of a scene by the plan of the arguments, and warns of problems.
/// Fails    as plan_maps(), ViewMaker and run_job().
void make_views(const DatasetArguments& arguments, const Views& views, const Console& console);

}  // namespace fathom::app
