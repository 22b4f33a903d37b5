#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "fathom/numeric/ratio.h"

/// The path of a moving sensor.
namespace fathom {

/// Where a sensor stands: the rotation of a Hamilton quaternion, then a translation, take points of
/// the sensor to the world.
struct Placement {
  std::array<double, 3> position{};
  /// w, x, y, z, of any length but 0.
  std::array<double, 4> quaternion{1, 0, 0, 0};
};

class Trajectory {
 public:
  /// Reads a file of TUM: lines `time tx ty tz qx qy qz qw` with increasing times in seconds.
  /// Fails    InputError "FILE: line N: …".
  static Trajectory read(const std::filesystem::path& file);

  [[nodiscard]] double first_time() const { return poses_.front().time; }
  /// Whether there is only one pose, which holds at all times.
  [[nodiscard]] bool is_at_rest() const { return poses_.size() == 1; }

  /// The placement at a time between two poses: the position moves at a constant velocity, the
  /// rotation turns at a constant rate on the shorter way. Each number is rounded to binary64 once,
  /// the quaternion as slerp() says; the rounded numbers *are* the placement.
  /// Fails    InputError "FILE: the poses …" if the time is before the first or after the last.
  [[nodiscard]] Placement at(const Ratio& time) const;

 private:
  struct Timed {
    double time = 0;
    Placement placement;
  };

  std::string name_;
  std::vector<Timed> poses_;
};

}  // namespace fathom
