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

/// What --peers names, or what there is.
struct Peers {
  bool vtk = bench::peers_are_built(), embree = bench::peers_are_built(), reference = true;
  bool masked_occlusion_culling = bench::masked_occlusion_culling_is_built();
  /// No --peers: the reference engine where it is bearable.
  bool by_default = true;
};

/// The arguments of `fathom bench`.
struct BenchArguments {
  /// Empty where they are not given: what is timed says what is used then.
  std::vector<std::string> scenes;
  std::vector<Size> sizes;
  std::vector<int> threads;
  Peers peers;
  std::vector<Channel> channels{Channel::Z};
  int repeat = 9;
  std::string json;
  /// What each idea brings, instead of a comparison; only these ideas, if there are any.
  bool parts = false;
  std::vector<std::string> ideas;

  void add_to(Command& command);
};

/// `fathom bench --parts`: what each idea brings.
/// Fails    InputError where a scene cannot be read; bench::WrongPicture where an idea changes the
///          picture.
int run_parts(const BenchArguments& arguments, const Console& console);

}  // namespace fathom::app
