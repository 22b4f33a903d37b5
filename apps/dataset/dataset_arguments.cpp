#include "apps/dataset/dataset_arguments.h"

#include "apps/options/scene_options.h"
#include "apps/shell/command.h"
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

}  // namespace fathom::app
