// What goes to Eigen and comes back has the same bits, and fails as the header says.
#include "fathom/eigen_conversions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <random>

#include "fathom/camera/camera_making.h"
#include "tests/numeric/random_numbers.h"

namespace fathom {
namespace {

using checks::any_double;
using ::testing::HasSubstr;

std::uint64_t bits(double x) {
  return std::bit_cast<std::uint64_t>(x);
}

/// Numbers of any exponent, with zeros of both signs and subnormal ones among them.
double any_number(std::mt19937_64& random) {
  switch (random() % 8) {
    case 0:
      return 0.0;
    case 1:
      return -0.0;
    case 2:
      return std::bit_cast<double>(random() >> 12);
    default:
      return any_double(random);
  }
}

Camera any_camera(std::mt19937_64& random) {
  Camera camera;
  for (double* x : {&camera.projection.fx, &camera.projection.fy, &camera.projection.cx,
                    &camera.projection.cy, &camera.projection.skew})
    *x = any_number(random);
  for (auto& row : camera.world_to_camera)
    for (double& x : row) x = any_number(random);
  return camera;
}

void expect_same_pose(const Camera& a, const Camera& b) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 4; ++k)
      ASSERT_EQ(bits(a.world_to_camera[i][k]), bits(b.world_to_camera[i][k])) << i << ", " << k;
}

TEST(EigenConversions, PosesKeepTheirBits) {
  std::mt19937_64 random(311);
  for (int i = 0; i < 1000; ++i) {
    const Camera camera = any_camera(random);
    const Eigen::Affine3d pose = camera_from_world(camera);
    EXPECT_EQ(pose(1, 2), camera.world_to_camera[1][2]);
    EXPECT_EQ(pose.matrix().row(3), Eigen::RowVector4d(0, 0, 0, 1));
    Camera back;
    set_camera_from_world(back, pose);
    expect_same_pose(back, camera);
    back = {};
    set_camera_from_world(back, Eigen::AffineCompact3d(pose));
    expect_same_pose(back, camera);
    back = {};
    set_camera_from_world(back, Eigen::Matrix<double, 3, 4>(pose.affine()));
    expect_same_pose(back, camera);
    back = {};
    set_camera_from_world(back, Eigen::Isometry3d(pose.matrix()));
    expect_same_pose(back, camera);
  }
}

TEST(EigenConversions, PosesMeanTheSame) {
  // At (1, 2, 3), looking along −x with z up: right is +y, down is −z.
  const Camera camera = look_at({1, 2, 3}, {0, 2, 3}, {0, 0, 1});
  const Eigen::Affine3d pose = camera_from_world(camera);
  EXPECT_EQ(pose * Eigen::Vector3d(-4, 3, 1), Eigen::Vector3d(1, 2, 5));
  EXPECT_EQ(world_from_camera(camera) * Eigen::Vector3d(1, 2, 5), Eigen::Vector3d(-4, 3, 1));
}

TEST(EigenConversions, TheInverseIsThatOfTheCamera) {
  std::mt19937_64 random(312);
  for (int i = 0; i < 200; ++i) {
    Camera camera;
    for (auto& row : camera.world_to_camera)
      for (double& x : row) x = any_double(random);
    const auto rows = camera_to_world(camera.world_to_camera);
    const Eigen::Affine3d pose = world_from_camera(camera);
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t k = 0; k < 4; ++k)
        ASSERT_EQ(bits(pose(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(k))),
                  bits(rows[r][k]));
    camera.world_to_camera[2] = camera.world_to_camera[1];
    EXPECT_THROW(world_from_camera(camera), InputError);
  }
}

TEST(EigenConversions, IntrinsicsKeepTheirBits) {
  std::mt19937_64 random(313);
  for (int i = 0; i < 1000; ++i) {
    const Camera camera = any_camera(random);
    const Eigen::Matrix3d K = intrinsic_matrix(camera);
    Camera back;
    back.projection.pixel_centre = 0;
    set_intrinsic_matrix(back, K);
    EXPECT_EQ(bits(back.projection.fx), bits(camera.projection.fx));
    EXPECT_EQ(bits(back.projection.fy), bits(camera.projection.fy));
    EXPECT_EQ(bits(back.projection.cx), bits(camera.projection.cx));
    EXPECT_EQ(bits(back.projection.cy), bits(camera.projection.cy));
    EXPECT_EQ(bits(back.projection.skew), bits(camera.projection.skew));
    EXPECT_EQ(back.projection.pixel_centre, 0);
  }
  Camera camera;
  camera.projection.fx = 5, camera.projection.skew = 6, camera.projection.cx = 7,
  camera.projection.fy = 8, camera.projection.cy = 9;
  Eigen::Matrix3d K;
  K << 5, 6, 7, 0, 8, 9, 0, 0, 1;
  EXPECT_EQ(intrinsic_matrix(camera), K);
}

TEST(EigenConversions, OtherIntrinsicMatricesAreRefused) {
  for (const auto& [row, column] : {std::pair(1, 0), {2, 0}, {2, 1}, {2, 2}}) {
    for (const double wrong : {0x1p-1074, 2.0, std::numeric_limits<double>::quiet_NaN()}) {
      Eigen::Matrix3d K = Eigen::Matrix3d::Identity();
      K(row, column) = wrong;
      Camera camera;
      camera.projection.cx = 3;
      EXPECT_THROW(set_intrinsic_matrix(camera, K), InputError) << row << ", " << column;
      EXPECT_EQ(camera.projection.cx, 3) << "changed all the same";
    }
  }
}

TEST(EigenConversions, PointsKeepTheirBits) {
  std::mt19937_64 random(314);
  for (int i = 0; i < 1000; ++i) {
    const MeshPoint p{any_number(random), any_number(random), any_number(random)};
    const MeshPoint back = to_mesh_point(to_eigen(p));
    EXPECT_EQ(bits(back.x), bits(p.x));
    EXPECT_EQ(bits(back.y), bits(p.y));
    EXPECT_EQ(bits(back.z), bits(p.z));
    const auto array = to_array(to_eigen(p));
    EXPECT_EQ(bits(array[0]), bits(p.x));
    EXPECT_EQ(bits(array[1]), bits(p.y));
    EXPECT_EQ(bits(array[2]), bits(p.z));
  }
}

TEST(EigenConversions, ExactPointsAreRoundedOnce) {
  // Just above the middle of 1 and the next number, by less than binary64 can add to 1.
  const Dyadic x = Dyadic(1.0) + Dyadic(0x1p-53) + Dyadic(0x1p-500), y = -x, z = 3.0;
  const Eigen::Vector3d expected(1 + 0x1p-52, -1 - 0x1p-52, 3);
  EXPECT_EQ(rounded(WorldPoint{x, y, z}), expected);
  EXPECT_EQ(rounded(CameraPoint{x, y, z}), expected);
}

TEST(EigenConversions, PlacementsAreExactOneWayAndRoundedOnceTheOther) {
  std::mt19937_64 random(315);
  for (int i = 0; i < 500; ++i) {
    Eigen::Affine3d placement = Eigen::Affine3d::Identity();
    for (Eigen::Index r = 0; r < 3; ++r)
      for (Eigen::Index k = 0; k < 4; ++k) placement(r, k) = any_number(random);
    const WorldFromMesh exact = to_world_from_mesh(placement);
    EXPECT_EQ(exact.rows[1][3], Dyadic(placement(1, 3)));
    EXPECT_EQ(rounded(exact).matrix(), placement.matrix());
    EXPECT_EQ(to_world_from_mesh(Eigen::AffineCompact3d(placement)).rows, exact.rows);
  }
  WorldFromMesh product;
  product.rows[0][3] = Dyadic(1.0) + Dyadic(0x1p-53) + Dyadic(0x1p-500);
  EXPECT_EQ(rounded(product)(0, 3), 1 + 0x1p-52);
}

TEST(EigenConversions, RowsOfAMeshAreItsOwn) {
  Mesh mesh;
  mesh.vertices = {{1, 2, 3}, {4, 5, 6}, {7, 8, -0.0}, {0.1, 0.2, 0.3}};
  mesh.triangles = {{0, 1, 2}, {3, 1, 0xFFFFFFFE}};
  const Mesh& same = mesh;
  ASSERT_EQ(vertices_of(same).rows(), 4);
  ASSERT_EQ(triangles_of(same).rows(), 2);
  EXPECT_EQ(static_cast<const void*>(vertices_of(same).data()), mesh.vertices.data());
  EXPECT_EQ(static_cast<const void*>(triangles_of(same).data()), mesh.triangles.data());
  EXPECT_EQ(vertices_of(same).row(1), Eigen::RowVector3d(4, 5, 6));
  EXPECT_EQ(triangles_of(same)(1, 2), 0xFFFFFFFE);
  vertices_of(mesh).col(2).setConstant(9);
  triangles_of(mesh)(0, 1) = 3;
  EXPECT_EQ(mesh.vertices[3], (MeshPoint{0.1, 0.2, 9}));
  EXPECT_EQ(mesh.triangles[0], (CornerIndices{0, 3, 2}));
  const Mesh empty;
  EXPECT_EQ(vertices_of(empty).rows(), 0);
  EXPECT_EQ(triangles_of(empty).rows(), 0);
}

TEST(EigenConversions, MeshesComeBackAsTheyWere) {
  std::mt19937_64 random(316);
  Mesh mesh;
  for (int i = 0; i < 300; ++i)
    mesh.vertices.push_back({any_number(random), any_number(random), any_number(random)});
  for (int i = 0; i < 500; ++i)
    mesh.triangles.push_back({static_cast<std::uint32_t>(random() % 300),
                              static_cast<std::uint32_t>(random() % 300),
                              static_cast<std::uint32_t>(random() % 300)});
  // As other programs hold them: column by column, with indices of another type.
  const Eigen::MatrixXd vertices = vertices_of(mesh);
  const Eigen::MatrixXi triangles = triangles_of(mesh).cast<int>();
  const Mesh back = mesh_of(vertices, triangles);
  ASSERT_EQ(back.vertices.size(), mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    ASSERT_EQ(bits(back.vertices[v].x), bits(mesh.vertices[v].x));
    ASSERT_EQ(bits(back.vertices[v].y), bits(mesh.vertices[v].y));
    ASSERT_EQ(bits(back.vertices[v].z), bits(mesh.vertices[v].z));
  }
  EXPECT_EQ(back.triangles, mesh.triangles);
  EXPECT_EQ(back.face_count, 500U);
  EXPECT_EQ(back.face_of(499), 499U);
  // Of float, widened.
  const Eigen::Matrix3f three = Eigen::Matrix3f::Constant(0.1F);
  EXPECT_EQ(mesh_of(three, Eigen::RowVector3i(0, 1, 2)).vertices[2].z, static_cast<double>(0.1F));
}

template <class Vertices, class Triangles>
std::string refusal(const Vertices& vertices, const Triangles& triangles) {
  try {
    mesh_of(vertices, triangles);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(EigenConversions, MeshesThatAreNoneAreRefused) {
  const Eigen::Matrix3d three = Eigen::Matrix3d::Identity();
  const Eigen::RowVector3i one(0, 1, 2);
  EXPECT_EQ(refusal(three, one), "none");
  EXPECT_THAT(refusal(three, Eigen::RowVector3i(0, -1, 2)),
              HasSubstr("triangle 0: there is no vertex -1"));
  EXPECT_THAT(refusal(three, Eigen::RowVector3i(0, 1, 3)), HasSubstr("there is no vertex 3"));
  using Long = Eigen::Matrix<std::int64_t, 1, 3>;
  EXPECT_THAT(refusal(three, Long(0, 1, std::int64_t{1} << 32)),
              HasSubstr("there is no vertex 4294967296"));
  EXPECT_THAT(refusal(three, Eigen::RowVector4i(0, 1, 2, 0)), HasSubstr("M×3"));
  EXPECT_THAT(refusal(Eigen::MatrixXd(3, 2), one), HasSubstr("N×3"));
  for (const double wrong :
       {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    Eigen::Matrix3d vertices = three;
    vertices(1, 2) = wrong;
    EXPECT_THAT(refusal(vertices, one), HasSubstr("vertex 1: a coordinate is not finite"));
  }
}

// Rows of a mesh that is gone at once do not compile.
template <class M>
concept has_rows = requires(M&& mesh) {
  vertices_of(std::forward<M>(mesh));
};
static_assert(has_rows<Mesh&> && has_rows<const Mesh&>);
static_assert(!has_rows<Mesh> && !has_rows<const Mesh>);

}  // namespace
}  // namespace fathom
