// Writes points that COLMAP's cameras undistort: the lines of inverted_by_colmap.txt. The build
// does not use it: compile it with the headers of github.com/colmap/colmap, 5d968cf3, Eigen, glog
// and Ceres.
//
// Each line: k1 k2 p1 p2 of a lens OPENCV, a point of the plane in which it distorts, 1 or 0 for
// whether COLMAP finds a ray, and x and y of the ray (x, y, 1) or of the last step, as hexadecimal
// floating-point numbers.

#include <cstdio>
#include <random>

#include "colmap/sensor/models.h"

int main() {
  const double lenses[][4] = {
      {-4.0 / 27, 0, 0, 0}, {-0.2, 0.016, 0.004, -0.003}, {0.5, 0, 0, 0}, {0.1, -0.3, 0.01, 0.02}};
  std::mt19937_64 random(1);
  const auto number = [&](double end) {
    return end * (2 * static_cast<double>(random() >> 11) * 0x1p-53 - 1);
  };
  for (int i = 0; i < 20; ++i) {
    for (const auto& lens : lenses) {
      const double x = number(1), y = number(0.75);
      const double params[] = {1, 1, 0, 0, lens[0], lens[1], lens[2], lens[3]};
      double u = 0, v = 0;
      const bool found = colmap::OpenCVCameraModel::CamFromImg(params, x, y, &u, &v);
      std::printf("%a %a %a %a %a %a %d %a %a\n", lens[0], lens[1], lens[2], lens[3], x, y,
                  found ? 1 : 0, u, v);
    }
  }
}
