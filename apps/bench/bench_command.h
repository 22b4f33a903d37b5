#pragma once

#include <string>
#include <vector>

#include "apps/bench/measurement.h"
#include "apps/bench/report.h"
#include "apps/shell/command.h"
#include "apps/shell/console.h"
#include "apps/shell/values.h"
#include "fathom/image/channel_table.h"
#include "validation/scenes/scenes.h"

namespace fathom::app {

/// The renderers that --peers names, or all that are built in.
struct Peers {
  bool vtk = bench::peers_are_built(), embree = bench::peers_are_built(), reference = true;
  bool masked_occlusion_culling = bench::masked_occlusion_culling_is_built();
  /// Without --peers, the reference engine runs only where it is fast enough.
  bool by_default = true;
};

/// The arguments of `fathom bench`.
struct BenchArguments {
  /// Empty if not given; each kind of timing then has its own defaults.
  std::vector<std::string> scenes;
  std::vector<Size> sizes;
  std::vector<int> threads;
  Peers peers;
  std::vector<Channel> channels{Channel::Z};
  int repeat = 9;
  std::string json;
  /// Times each idea instead of a comparison; if `ideas` is not empty, only these ideas.
  bool parts = false;
  std::vector<std::string> ideas;

  void add_to(Command& command);
};

/// `fathom bench --parts`: times each idea.
/// Fails    InputError where a scene cannot be read; bench::WrongPicture where an idea changes the
///          picture.
int run_parts(const BenchArguments& arguments, const Console& console);

}  // namespace fathom::app
