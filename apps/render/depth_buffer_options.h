#pragma once

#include <optional>

#include "apps/shell/command.h"
#include "fathom/depth_format/depth_format.h"

namespace fathom::app {

/// `--depth-format --mapping --c --against-exact` of `render`: the channels of a depth buffer, or
/// the z-buffer of the pipeline.
struct DepthBufferArguments {
  std::optional<Storage> storage;
  std::optional<Mapping> mapping;
  std::optional<double> c;
  bool against_exact = false;

  void add_to(Command& command);
};

}  // namespace fathom::app
