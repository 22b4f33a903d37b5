// Writes points that COLMAP's camera models distort: the lines of points_of_colmap.txt. The build
// does not use it: compile it with src/colmap/sensor/models.cc of github.com/colmap/colmap,
// 5d968cf3, and the headers of COLMAP, Eigen and Ceres, with -ffp-contract=off.
//
// Each line: the name of a model, its parameters in COLMAP's order, x, y and z of a ray, and its
// image, as hexadecimal floating-point numbers.
#include <cstdio>
#include <random>
#include <vector>

#include "colmap/sensor/models.h"

namespace {

std::mt19937_64 generator(1);

double uniform(double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(generator);
}

/// Lines with the parameters of distortion within `size`, and rays of any length.
template <class Model>
void write_points(double size) {
  for (int i = 0; i < 12; ++i) {
    std::vector<double> params = Model::InitializeParams(0, 0, 0);
    for (const std::size_t index : Model::focal_length_idxs) params[index] = uniform(90, 110);
    for (const std::size_t index : Model::principal_point_idxs) params[index] = uniform(-5, 5);
    for (const std::size_t index : Model::extra_params_idxs) params[index] = uniform(-size, size);
    const double z = uniform(0.5, 2), x = z * uniform(-0.7, 0.7), y = z * uniform(-0.7, 0.7);
    double u = 0, v = 0;
    if (!Model::ImgFromCam(params.data(), x, y, z, &u, &v)) continue;
    std::printf("%s", Model::model_name.c_str());
    for (const double number : params) std::printf(" %a", number);
    std::printf(" %a %a %a %a %a\n", x, y, z, u, v);
  }
}

}  // namespace

int main() {
  using namespace colmap;
  write_points<SimplePinholeCameraModel>(0);
  write_points<PinholeCameraModel>(0);
  write_points<SimpleRadialCameraModel>(0.2);
  write_points<RadialCameraModel>(0.2);
  write_points<OpenCVCameraModel>(0.1);
  write_points<FullOpenCVCameraModel>(0.1);
  write_points<SimpleDivisionCameraModel>(0.3);
  write_points<DivisionCameraModel>(0.3);
  write_points<SimpleFisheyeCameraModel>(0);
  write_points<FisheyeCameraModel>(0);
  write_points<SimpleRadialFisheyeCameraModel>(0.1);
  write_points<RadialFisheyeCameraModel>(0.1);
  write_points<OpenCVFisheyeCameraModel>(0.05);
  write_points<ThinPrismFisheyeCameraModel>(0.05);
  write_points<FOVCameraModel>(1.2);
  write_points<RadTanThinPrismFisheyeModel>(0.02);
}
