#include "fathom/rays/lidar_rays.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "fathom/camera/rounded_angles.h"
#include "fathom/failures/errors.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/rays/exact_ray.h"
#include "fathom/threads/threads.h"

namespace fathom {
namespace {

/// A rigid motion, exactly: the rows divided by n, then the position.
struct Motion {
  std::array<ExactVector3, 3> rows;
  Dyadic n;
  ExactVector3 position;
};

Motion motion_of(const Placement& placement) {
  const auto& [w, x, y, z] = placement.quaternion;
  // The camera of the inverse quaternion at the world's zero: its pose is the rotation itself.
  const camera::ExactPose pose = camera::exact_view_from({0.0, 0.0, 0.0}, {w, -x, -y, -z});
  Motion motion;
  motion.n = pose[0][0].denominator;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) motion.rows[i][k] = pose[i][k].numerator;
    motion.position[i] = placement.position[i];
  }
  return motion;
}

/// The placement of the sensor while it measures a column.
Placement placement_at(const LidarSensor& sensor, const Trajectory* path, double start,
                       std::size_t column) {
  if (!path) return {};
  if (path->is_at_rest()) return path->at(Ratio());
  const double columns_per_second = static_cast<double>(sensor.columns) * *sensor.turns_per_second;
  return path->at(Ratio(Dyadic(start)) + Ratio(static_cast<double>(column), columns_per_second));
}

/// Of the altitudes of all beams.
using Altitudes = std::vector<camera::SineCosine>;

Altitudes altitudes_of(const LidarSensor& sensor) {
  Altitudes altitudes;
  for (const double degrees : sensor.altitudes)
    altitudes.push_back(camera::sine_and_cosine(degrees));
  return altitudes;
}

/// The rays of a sensor in one placement.
class Column {
 public:
  Column(const LidarSensor& sensor, std::size_t column, const Placement& placement)
      : sensor_(sensor), column_(column), motion_(motion_of(placement)) {
    const camera::SineCosine encoder = camera::sine_and_cosine(angle(0));
    const Dyadic radius = sensor.beam_radius;
    // Millimetres of the world, times n.
    const ExactVector3 origin =
        turned(in_sensor({radius * Dyadic(encoder.cosine.rounded),
                          -(radius * Dyadic(encoder.sine.rounded)), sensor.beam_height},
                         1.0));
    const Dyadic scale = Dyadic(1000.0) * motion_.n;
    for (int i = 0; i < 3; ++i)
      origin_[i] = round_to_binary64(Ratio(origin[i] + motion_.position[i] * scale, scale));
  }

  [[nodiscard]] Ray ray(std::size_t row, const camera::SineCosine& altitude) const {
    const auto [sine, cosine] = camera::sine_and_cosine(angle(sensor_.azimuths[row]));
    const auto& [up, level] = altitude;
    const ExactVector3 direction = turned(in_sensor(
        {camera::rounded_product(cosine, level), camera::rounded_product(-sine, level), up.rounded},
        0.0));
    Ray ray{origin_, {}};
    for (int i = 0; i < 3; ++i)
      ray.direction[i] = round_to_binary64(Ratio(direction[i], motion_.n));
    return ray;
  }

 private:
  /// The encoder's angle plus an angle, in degrees.
  [[nodiscard]] double angle(double azimuth) const {
    const Dyadic columns(static_cast<double>(sensor_.columns));
    const Dyadic turned(360.0 * static_cast<double>(column_));
    return round_to_binary64(Ratio(turned + Dyadic(azimuth) * columns, columns));
  }

  /// A point (w = 1) or a direction (w = 0) of the lidar in the sensor's frame.
  [[nodiscard]] ExactVector3 in_sensor(const ExactVector3& v, const Dyadic& w) const {
    ExactVector3 result;
    for (int i = 0; i < 3; ++i) {
      const auto& row = sensor_.lidar_to_sensor[i];
      result[i] = dot(ExactVector3{row[0], row[1], row[2]}, v) + Dyadic(row[3]) * w;
    }
    return result;
  }

  [[nodiscard]] ExactVector3 turned(const ExactVector3& v) const {
    return {dot(motion_.rows[0], v), dot(motion_.rows[1], v), dot(motion_.rows[2], v)};
  }

  const LidarSensor& sensor_;
  std::size_t column_;
  Motion motion_;
  std::array<double, 3> origin_{};
};

}  // namespace

std::vector<Ray> lidar_rays(const LidarSensor& sensor, const Trajectory* path, double start,
                            int threads) {
  const StandardArithmetic standard;
  if (path && !path->is_at_rest() && !sensor.turns_per_second)
    throw InputError(sensor.name +
                     ": 'lidar_mode' is missing, which says how long a turn takes on a path");
  const std::size_t columns = sensor.columns;
  // The ends first: a path that is too short is refused before any work, with the same message by
  // any number of threads.
  for (const std::size_t v : {std::size_t{0}, columns - 1}) placement_at(sensor, path, start, v);
  const Altitudes altitudes = altitudes_of(sensor);
  std::vector<Ray> rays(sensor.rows * columns);
  with_threads(threads, [&] {
    parallel_for(std::size_t{0}, columns, [&](std::size_t v) {
      const Column column(sensor, v, placement_at(sensor, path, start, v));
      for (std::size_t i = 0; i < sensor.rows; ++i)
        rays[i * columns + v] = column.ray(i, altitudes[i]);
    });
  });
  for (std::size_t k = 0; k < rays.size(); ++k)
    if (!rays::is_finite(rays[k]))
      throw InputError(sensor.name + ": the ray of beam " + std::to_string(k / columns) +
                       " in column " + std::to_string(k % columns) + " is beyond binary64");
  return rays;
}

}  // namespace fathom
