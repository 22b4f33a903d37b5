#include "apps/dataset/dataset_command.h"

#include "apps/dataset/layouts.h"

namespace fathom::app {

void add_dataset(Command& program) {
  Command& family = program.command(
      "dataset", "Render all maps of a data set in its own layout; resume an interrupted run",
      "  fathom camera import colmap sparse/0 -o cameras.json\n"
      "  fathom dataset maps cameras.json --mesh room.ply --name 'depth/{stem}.npy' -o room\n"
      "\nEach map is in its place as soon as it is finished; DIR/fathom-manifest.jsonl says which "
      "are. The same command, given again, makes those that are missing, damaged, or of other "
      "inputs. Layouts: data-sets.md in the documentation.");
  family.requires_command();
  add_maps_layout(family);
  add_colmap_layout(family);
  add_depth_image_layouts(family);
  add_bop_layout(family);
}

}  // namespace fathom::app
