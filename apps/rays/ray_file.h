#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "apps/rays/number_rows.h"
#include "fathom/files/file_bytes.h"
#include "fathom/rays/ray.h"
#include "fathom/rays/sight.h"

/// Files of rays and of pairs of points, as number_rows.h describes.
/// Fails    as NumberRows.
namespace fathom::app {

/// Reads rays, with the columns x, y, z (origin) and dx, dy, dz (direction), in blocks.
/// Fails    as above; InputError for a direction of 0.
class RayFile {
 public:
  explicit RayFile(const std::string& file);

  /// The next rays, at most `most`; empty at the end of the file.
  std::vector<Ray> next(std::size_t most);

 private:
  NumberRows rows_;
};

/// Reads all rays of a file.
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
