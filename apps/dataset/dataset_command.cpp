#include "apps/dataset/dataset_command.h"

#include "apps/options/scene_options.h"
#include "apps/shell/values.h"

namespace fathom::app {

void DatasetArguments::add_to(Command& command, const std::string& what) {
  command.argument("INPUT", input, what).required();
  add_output_option(command, "DIR", folder, "Folder of the data set; created if missing")
      .required();
  render.scene.add_reading_to(command);
  add_cull_option(command, render.cull);
  command.option("--shard", "I/N", into(shard, parse_shard),
                 "Render every Nth map, beginning with the Ith, so that N machines share the work");
  command.flag(
      "--overwrite", overwrites,
      "Overwrite existing files, even those not made by fathom; where a name is a symbolic "
      "link, the link stays and the file it leads to is overwritten");
}

void DatasetArguments::add_scene_to(Command& command) {
  command
      .option_with_values("--mesh", "FILE", render.scene.files,
                          "Mesh or scene file to render; repeat the option for several")
      .required();
}

Job DatasetArguments::job() const {
  Job job;
  job.folder = folder;
  job.shard = shard;
  job.overwrites = overwrites;
  return job;
}

void add_dataset(Command& program) {
  Command& family = program.command(
      "dataset", "Render all maps of a data set in its own layout; resume an interrupted run",
      "  fathom camera import colmap sparse/0 -o cameras.json\n"
      "  fathom dataset maps cameras.json --mesh room.ply --name '{stem}.npy' -o room\n"
      "\nEach map appears as soon as it is finished; DIR/fathom-manifest.jsonl lists the finished "
      "maps. If you repeat the command, it renders only maps that are missing, damaged or made "
      "from other inputs. Layouts: data-sets.md in the documentation.");
  family.requires_command();
  add_maps_layout(family);
  add_colmap_layout(family);
  add_depth_image_layouts(family);
  add_bop_layout(family);
}

}  // namespace fathom::app
