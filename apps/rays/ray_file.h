#pragma once

#include <string>
#include <vector>

#include "fathom/rays/ray.h"
#include "fathom/rays/sight.h"

/// Files of rays and of pairs of points: CSV or NPY, as read_rows() reads them (number_rows.h).
/// "-" is standard input.
namespace fathom::app {

/// Reads rays, with the columns x, y, z (origin) and dx, dy, dz (direction).
/// Fails    as read_rows(); InputError for a direction of 0.
std::vector<Ray> read_rays(const std::string& file);

struct SightPairs {
  std::vector<SightPoint> eyes, points;
};

/// Reads pairs of an eye and a point, with the columns x, y, z (eye) and either px, py, pz (point)
/// or, in CSV, triangle, v and w (point of a triangle, as SurfacePoint).
/// Fails    as read_rows(); InputError for a triangle that is not a whole number.
SightPairs read_pairs(const std::string& file);

}  // namespace fathom::app
