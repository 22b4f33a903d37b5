#pragma once

#include <span>
#include <string>
#include <vector>

#include "fathom/files/file_bytes.h"
#include "fathom/rays/ray.h"
#include "fathom/rays/sight.h"

/// Files of rays and of pairs of points, with six numbers in each row. "-" is standard input.
///   CSV   a heading with the names of the columns, in any order, then a line for each row; each
///         number is rounded once to binary64
///   NPY   an array of shape N×6, of binary64 or binary32
/// Fails    InputError "FILE: line N: …" or "FILE: row N: …": other columns, a number that is not
///          finite, no row.
namespace fathom::app {

/// Reads rays, with the columns x, y, z (origin) and dx, dy, dz (direction).
/// Fails    as above; InputError for a direction of 0.
std::vector<Ray> read_rays(const std::string& file);

/// Rays as an NPY file of binary64 numbers.
files::Bytes npy_of_rays(std::span<const Ray> rays);

struct SightPairs {
  std::vector<SightPoint> eyes, points;
};

/// Reads pairs of an eye and a point, with the columns x, y, z (eye) and either px, py, pz (point)
/// or, in CSV, triangle, v and w (point of a triangle, as SurfacePoint).
/// Fails    as above; InputError for a triangle that is not a whole number.
SightPairs read_pairs(const std::string& file);

}  // namespace fathom::app
