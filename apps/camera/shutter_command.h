#pragma once

#include <functional>
#include <optional>
#include <string>

#include "apps/options/scene_options.h"
#include "apps/shell/command.h"

namespace fathom::app {

/// `fathom camera shutter`: the rays of a moving camera with a rolling shutter.
struct ShutterArguments {
  std::string camera, poses, output;
  double readout = 0;
  std::optional<double> start;
  ReadLimits limits;
};

/// Computes and writes the rays; gives the exit status. fathom-surfaces does it, which has rays;
/// fathom knows the options and starts that program.
using ShutterRun = std::function<int(const ShutterArguments&, const Console&)>;

void add_shutter(Command& camera, const ShutterRun& run);

}  // namespace fathom::app
