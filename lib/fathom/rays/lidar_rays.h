#pragma once

#include <cstdint>
#include <vector>

#include "fathom/camera/trajectory.h"
#include "fathom/rays/lidar_sensor.h"
#include "fathom/rays/ray.h"

/// The rays of a lidar.
///
/// Beam i of column v has the encoder angle ε = 360°·v/columns and, in the lidar's frame,
///
///   direction   (cos θ·cos φ, −sin θ·cos φ, sin φ),   θ = ε + azimuthᵢ,  φ = altitudeᵢ
///   origin      (radius·cos ε, −radius·sin ε, height)
///
/// ε and θ are rounded to binary64 once, then each sine, each cosine and each component of the
/// direction once. All that follows is exact until the ray is rounded to binary64: the sensor's
/// matrix, the change from millimetres to metres, and the placement. The rounded numbers *are* the
/// ray.
///
/// Source   `ouster-lidar/ouster-sdk`: make_xyz_lut() of xyzlut.cpp (BSD). A range r there means
///          the point origin + (r − n)·direction, n being the distance of the origin from the
///          lidar's zero.
namespace fathom {

/// The rays of a turn, in metres: ray i·columns + v is of beam i in column v.
///
/// path     where the sensor is: column v measures v/(columns·turns_per_second) after `start`.
///          nullptr: the sensor stands at the world's zero.
/// start    in seconds.
/// Threads  0: all.
/// Fails    InputError if the path does not cover the turn, if the sensor has no turns_per_second
///          on a path with more than one pose, or if a ray is beyond binary64.
std::vector<Ray> lidar_rays(const LidarSensor& sensor, const Trajectory* path, double start,
                            int threads = 0);

}  // namespace fathom
