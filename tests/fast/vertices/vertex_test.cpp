// The bounds of vertices from both sides: never violated against exact values, and not looser than
// a stated factor.
#include "fathom/fast/vertices/vertex.h"

#include <gtest/gtest.h>

#include "tests/effort.h"
#include "tests/inputs/scene_building.h"
#include "tests/numeric/error_shares.h"
#include "tests/numeric/random_numbers.h"

namespace fathom {
namespace {

using namespace fast;
using checks::Numbers;
using checks::Share;

Camera camera_from(Numbers& n, bool perspective) {
  Camera c = checks::camera_of(1000, 800, 0);
  c.projection.model = perspective ? ProjectionModel::perspective : ProjectionModel::orthographic;
  do {
    c.projection.fx = 700 * (1 + n.unit() / 2);
    c.projection.fy = (n.below(2) ? 1 : -1) * 700 * (1 + n.unit() / 2);
    c.projection.skew = n.below(2) ? n.unit() : 0;
    c.projection.cx = 500 + n.unit();
    for (auto& row : c.world_to_camera) {
      for (double& entry : row) entry = n.below(6) == 0 ? n.wild(20) : n.unit();
    }
    c.world_to_camera[2][3] = n.below(3) == 0 ? n.unit() : 4 + n.unit();
  } while (find_fault(c));
  return c;
}

/// A placed object: its matrix has entries of more than 53 bits once multiplied with the camera's.
Object object_from(Numbers& n) {
  Object object;
  if (n.below(2)) return object;
  object.placed_as_is = false;
  for (auto& row : object.world_from_mesh.rows) {
    for (Dyadic& entry : row) entry = Dyadic(n.unit());
  }
  return object;
}

struct Exact {
  HomogeneousImagePoint image;
  Dyadic D;
};
Exact exact_image(const Object& object, const Camera& camera, const MeshPoint& X) {
  const CameraPoint p = to_camera(camera.world_to_camera, object.world_from_mesh(X));
  return {to_image(camera.projection, p), p.z};
}

class Vertices : public ::testing::TestWithParam<bool> {};

TEST_P(Vertices, BoundsHoldAndAreTight) {
  const bool perspective = GetParam();
  Numbers n(perspective ? 11 : 12);
  Share u, v, q;
  int unusable = 0, behind = 0;
  for (int i = 0; i < 1500; ++i) {
    const Camera camera = camera_from(n, perspective);
    const Object object = object_from(n);
    const VertexTransform transform(object, camera);
    for (int k = 0; k < 20; ++k) {
      const MeshPoint X = n.below(2) ? MeshPoint{n.wild(40), n.wild(40), n.wild(40)}
                                     : MeshPoint{n.unit(), n.unit(), n.unit()};
      const ImageVertex vertex = transform(X);
      const Exact exact = exact_image(object, camera, X);
      if (!vertex.is_usable()) {
        ++unusable;
        behind += vertex.is_behind();
        if (vertex.is_behind()) {
          EXPECT_NE(exact.image.W.sign(), Sign::positive);
        }
        continue;
      }
      ASSERT_EQ(exact.image.W.sign(), Sign::positive);
      u.add(vertex.u, {exact.image.U, exact.image.W}, vertex.position_error());
      v.add(vertex.v, {exact.image.V, exact.image.W}, vertex.position_error());
      q.add(vertex.q, perspective ? Ratio(1.0, exact.D) : Ratio(-exact.D), vertex.q_error());
    }
  }
  EXPECT_GT(u.count(), 5000);
  EXPECT_GT(unusable, 500);
  if (perspective) {
    EXPECT_GT(behind, 500);
  }
  // Not looser than this factor: the greatest errors found reach these shares of their bounds.
  EXPECT_GT(u.publish("u"), 0.25);
  EXPECT_GT(v.publish("v"), 0.25);
  EXPECT_GT(q.publish("q"), 0.25);
}

TEST_P(Vertices, BoundsHoldForFormsOfTheImage) {
  const bool perspective = GetParam();
  Numbers n(perspective ? 13 : 14);
  Share missed;
  for (int i = 0; i < 600 / checks::effort; ++i) {
    const Camera camera = camera_from(n, perspective);
    const Object object = object_from(n);
    const VertexTransform transform(object, camera);
    for (int k = 0; k < 20; ++k) {
      const MeshPoint X{n.unit(), n.unit(), n.unit()};
      const auto forms = transform.forms_of_image(X);
      const auto [U, V, W] = exact_image(object, camera, X).image;
      const Dyadic exact[] = {W, U, W * Dyadic(camera.width) - U, V, W * Dyadic(camera.height) - V};
      for (std::size_t j = 0; j < 5; ++j) missed.add(forms[j].value, exact[j], forms[j].error);
    }
  }
  checks::expect_share(missed.publish("missed_form"), 0.25);
}

INSTANTIATE_TEST_SUITE_P(Fast, Vertices, ::testing::Bool());

/// An entry that is not 0 but rounds to 0 would count as exact.
TEST(Fast, MatricesWithEntriesThatUnderflowAreNotUsable) {
  Camera camera = checks::camera_of(16, 12, 8);
  camera.projection.fx = 2e-162;
  EXPECT_FALSE(VertexTransform(Object{}, camera)({0, 0, 1}).is_usable());  // below 2⁻²⁰⁰
  camera.world_to_camera[0][0] = 1e-162;
  EXPECT_FALSE(VertexTransform(Object{}, camera)({0, 0, 1}).is_usable());  // rounds to 0
  camera.world_to_camera[0] = {0, 1, 0, 0};
  camera.world_to_camera[1] = {1, 0, 0, 0};
  EXPECT_FALSE(VertexTransform(Object{}, camera)({0, 0, 1}).is_usable());
}

TEST(Fast, VerticesOfMagnitudesBeyondTheBoundsAreNotUsable) {
  const Camera camera = checks::camera_of(100, 100, 50);
  const VertexTransform transform(Object{}, camera);
  EXPECT_TRUE(transform({1, 1, 1}).is_usable());
  for (const MeshPoint& X : {MeshPoint{1, 1, 0x1p-61}, MeshPoint{1, 1, 0x1p61},
                             MeshPoint{1e300, 1, 1}, MeshPoint{1e308, 1e308, 1e308},
                             MeshPoint{1, 1, 0}, MeshPoint{1, 1, -1}, MeshPoint{1e8, 1, 1}}) {
    EXPECT_FALSE(transform(X).is_usable()) << X.x << " " << X.y << " " << X.z;
  }
  EXPECT_TRUE(transform({1, 1, -1}).is_behind());
  EXPECT_FALSE(transform({1, 1, 0}).is_behind());
  Camera vast = camera;
  vast.projection.fx = 1e250;
  EXPECT_FALSE(VertexTransform(Object{}, vast)({1, 1, 1}).is_usable());
}

}  // namespace
}  // namespace fathom
