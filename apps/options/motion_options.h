#pragma once

#include <optional>
#include <string>

#include "apps/shell/command.h"
#include "fathom/image/depth_map.h"
#include "fathom/scene/motion.h"

namespace fathom::app {

/// `--motion FILE --time T`: objects that move, and when they are looked at.
struct MotionOptions {
  std::string file;  ///< empty: nothing moves
  std::optional<double> time;

  void add_to(Command& command);

  [[nodiscard]] bool is_given() const { return !file.empty(); }
  /// 0 where no time is given.
  [[nodiscard]] double time_or_start() const { return time.value_or(0); }
  /// The scene with its motion, whose file becomes one of its sources.
  /// Fails    as read_motion and MovingScene.
  [[nodiscard]] MovingScene moving(Scene scene) const;
  /// The scene at the time; as it is where nothing moves.
  /// Fails    also UsageError for a time without a motion.
  [[nodiscard]] Scene placed(Scene scene) const;
  /// The text fathom.time, without which the map could not be computed again.
  void describe(DepthMap& map, double at) const;
};

}  // namespace fathom::app
