#pragma once

#include <string>
#include <vector>

#include "apps/shell/command.h"
#include "apps/shell/values.h"
#include "fathom/image/channel_table.h"
#include "validation/bench/processors.h"
#include "validation/bench/renderers.h"
#include "validation/bench/scenes.h"

namespace fathom::app {

/// What --peers names, or what there is.
struct Peers {
  bool vtk = bench::peers_are_built(), embree = bench::peers_are_built(), reference = true;
  /// No --peers: the reference engine where it is bearable.
  bool by_default = true;
};

/// The arguments of `fathom bench`.
struct BenchArguments {
  std::vector<std::string> scenes = bench::default_scene_names();
  std::vector<Size> sizes{{1920, 1080}};
  std::vector<int> threads{bench::processor_count()};
  Peers peers;
  std::vector<Channel> channels{Channel::Z};
  int repeat = 9;
  std::string json;

  void add_to(Command& command);
};

}  // namespace fathom::app
