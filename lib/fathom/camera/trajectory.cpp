#include "fathom/camera/trajectory.h"

#include <algorithm>
#include <cmath>

#include "fathom/camera/imports/lines_and_poses.h"
#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/slerp.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/decimal.h"
#include "fathom/text/printable.h"

namespace fathom {
using namespace camera;

Trajectory Trajectory::read(const std::filesystem::path& file) {
  const StandardArithmetic standard;
  Trajectory result;
  const files::InputFile input(file);
  result.name_ = text::printable(file.string());
  for (Line& line : lines_of(input.text(), result.name_)) {
    const TumPose given = read_tum_pose(line);
    if (!given.fault.empty()) throw InputError(given.fault);
    if (!result.poses_.empty() && !(result.poses_.back().time < given.time))
      throw InputError(line.where + ": the time is not after the time of the pose before");
    result.poses_.push_back({given.time, {given.position, given.quaternion}});
  }
  if (result.poses_.empty()) throw InputError(result.name_ + ": holds no pose");
  return result;
}

Placement Trajectory::at(const Ratio& time) const {
  const StandardArithmetic standard;
  if (is_at_rest()) return poses_.front().placement;
  const auto is_before = [](const Timed& pose, const Ratio& t) {
    return Ratio(Dyadic(pose.time)) < t;
  };
  const auto end = std::lower_bound(poses_.begin(), poses_.end(), time, is_before);
  // The file's times are rounded, so a time that rounds to the last one is the last one.
  if (end == poses_.end() && round_to_binary64(time) == poses_.back().time)
    return poses_.back().placement;
  const bool is_early = time < Ratio(Dyadic(first_time()));
  if (is_early || end == poses_.end())
    throw InputError(name_ + ": the poses " +
                     (is_early ? "begin at " + text::shortest_decimal(first_time())
                               : "end at " + text::shortest_decimal(poses_.back().time)) +
                     " s, but the sensor measures at " +
                     text::shortest_decimal(round_to_binary64(time)) + " s");
  if (end == poses_.begin()) return end->placement;
  const auto begin = std::prev(end);
  const Dyadic first(begin->time);
  const Ratio share = quotient(time - Ratio(first), Ratio(Dyadic(end->time) - first));
  const Placement &from = begin->placement, &to = end->placement;
  Placement between;
  for (std::size_t i = 0; i < from.position.size(); ++i) {
    const Dyadic start(from.position[i]);
    between.position[i] =
        round_to_binary64(Ratio(start) + share * Ratio(Dyadic(to.position[i]) - start));
  }
  between.quaternion = slerp(from.quaternion, to.quaternion, share);
  return between;
}

}  // namespace fathom
