// Mixing up frames does not compile.
#include "fathom/geometry/frames.h"

#include <gtest/gtest.h>

#include <type_traits>

#include "fathom/camera/camera.h"

namespace fathom {
namespace {

static_assert(!std::is_convertible_v<MeshPoint, WorldPoint>);
static_assert(!std::is_convertible_v<WorldPoint, CameraPoint>);
static_assert(!std::is_convertible_v<CameraPoint, WorldPoint>);
static_assert(!std::is_convertible_v<CameraPoint, HomogeneousImagePoint>);
static_assert(!std::is_invocable_v<decltype(to_camera), const Camera&, MeshPoint>);
static_assert(!std::is_invocable_v<decltype(to_camera), const Camera&, CameraPoint>);
static_assert(!std::is_invocable_v<decltype(to_image), const Camera&, WorldPoint>);
static_assert(!std::is_invocable_v<WorldFromMesh, WorldPoint>);
static_assert(std::is_same_v<std::invoke_result_t<WorldFromMesh, MeshPoint>, WorldPoint>);

TEST(Frames, PointsGoFromFrameToFrame) {
  const WorldPoint world = WorldFromMesh{}(MeshPoint{1, 2, 4});
  Camera camera;
  camera.projection.fx = 3;
  camera.world_to_camera[0][3] = 5;
  const CameraPoint seen = to_camera(camera.world_to_camera, world);
  EXPECT_EQ(seen.x, Dyadic(6));
  const HomogeneousImagePoint image = to_image(camera.projection, seen);
  EXPECT_EQ(image.U, Dyadic(18));
  EXPECT_EQ(image.W, Dyadic(4));
}

}  // namespace
}  // namespace fathom
