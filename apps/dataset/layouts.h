#pragma once

#include "apps/dataset/dataset_arguments.h"
#include "apps/shell/command.h"

namespace fathom::app {

/// The layouts of data sets, each a command of its own below `fathom dataset`.
void add_maps_layout(Command& family);
void add_depth_image_layouts(Command& family);
void add_colmap_layout(Command& family);
void add_bop_layout(Command& family);

}  // namespace fathom::app
