#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/options/scene_options.h"
#include "apps/shell/command.h"
#include "apps/shell/values.h"

namespace fathom::app {

/// Values of --model that select a model: the best fit, or, for a renderer that draws here, the
/// model of its variant.
inline constexpr const char* any_model = "auto";
inline constexpr const char* matching = "matching";

/// The arguments of `fathom validate`.
struct ValidateArguments {
  std::vector<std::string> scenes;
  std::string map, camera, model, channel, baseline, junit;
  std::string against, scene_names, variants, render, rays, output;
  bool colour = false, faults = false, for_ctest = false;
  /// Codes per scene unit of a map of integers that does not say it itself.
  std::optional<double> png_scale;
  ReadLimits limits;
  Size size{320, 240};
  std::uint32_t seconds = 300;
  /// Of each kind and scene, with --rays.
  std::optional<std::uint32_t> ray_count;

  void add_to(Command& command);

  /// Seconds after which a renderer is ended: --time-limit, a day at most.
  [[nodiscard]] int time_limit() const;
};

}  // namespace fathom::app
