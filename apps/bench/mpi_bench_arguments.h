#pragma once

#include "apps/mpi/mpi_arguments.h"
#include "apps/shell/values.h"
#include "validation/scenes/generated/generated_scene.h"

namespace fathom::app {

/// The arguments of fathom_mpi_bench: the scene that is made, and of what `fathom-mpi render` takes
/// that which costs something.
struct MpiBenchArguments {
  bench::GeneratedArguments scene;
  Size size{1920, 1080};
  MpiArguments rendering;

  MpiBenchArguments();
  void add_to(Command& command);
};

}  // namespace fathom::app
