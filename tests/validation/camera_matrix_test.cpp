#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "fathom/attribution/model/renderer_input.h"
#include "validation/vtk/drawn_by_vtk.h"

namespace fathom::validation {
namespace {

using attribution::clip_from_held;
using attribution::RasterModel;

Camera odd_camera() {
  Camera camera{.width = 160, .height = 90};
  camera.projection.fx = 150;
  camera.projection.fy = -130;  // mirrored
  camera.projection.cx = 70.25;
  camera.projection.cy = 48.5;
  camera.projection.skew = 12;
  camera.world_to_camera = {{{0.9, 0.1, -0.2, 0.1}, {-0.1, 1.1, 0.3, -0.2}, {0.2, -0.3, 0.8, 4}}};
  camera.near = 0.5;
  camera.far = 20;
  return camera;
}

RasterModel shifted_and_scaled() {
  return {.shift = {0.25, -3, 7}, .scale = {2, 0.3, 11}};
}

// Two steps of binary32 are more than half a one, which rounding may take, from either side.
TEST(CameraMatrix, IsKnownToAStepOfEachEntry) {
  for (const ProjectionModel projection :
       {ProjectionModel::perspective, ProjectionModel::orthographic}) {
    Camera camera = odd_camera();
    camera.projection.model = projection;
    const RasterModel model = shifted_and_scaled();
    const auto matrix = clip_from_held(camera, model);
    EXPECT_TRUE(is_matrix_of(camera, model, matrix));
    std::size_t changed = 0;
    for (std::size_t i = 0; i < matrix.size(); ++i) {
      if (matrix[i] == 0) continue;
      for (const float limit : {-INFINITY, INFINITY}) {
        auto other = matrix;
        other[i] = std::nextafter(std::nextafter(other[i], limit), limit);
        EXPECT_FALSE(is_matrix_of(camera, model, other)) << i;
        ++changed;
      }
    }
    EXPECT_GE(changed, 2U * 13);  // all but w's row of an orthographic camera
  }
}

TEST(CameraMatrix, IsThatOfTheModelsShiftScaleAndDepths) {
  const Camera camera = odd_camera();
  const RasterModel model = shifted_and_scaled();
  const auto matrix = clip_from_held(camera, model);
  EXPECT_FALSE(is_matrix_of(camera, {}, matrix));
  RasterModel other = model;
  other.shift[1] += 1e-3;
  EXPECT_FALSE(is_matrix_of(camera, other, matrix));
  other = model;
  other.scale[2] *= 1.001;
  EXPECT_FALSE(is_matrix_of(camera, other, matrix));
  other = model;
  other.mapping = Mapping::reversed;
  EXPECT_FALSE(is_matrix_of(camera, other, matrix));
  EXPECT_TRUE(is_matrix_of(camera, other, clip_from_held(camera, other)));
}

TEST(CameraMatrix, IsNotOneThatIsNoNumber) {
  const Camera camera = odd_camera();
  auto matrix = clip_from_held(camera, {});
  matrix[5] = NAN;
  EXPECT_FALSE(is_matrix_of(camera, {}, matrix));
}

}  // namespace
}  // namespace fathom::validation
