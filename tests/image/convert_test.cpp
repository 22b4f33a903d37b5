#include "fathom/image/convert.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "fathom/failures/errors.h"
#include "fathom/files/byte_order.h"
#include "fathom/image/point_cloud.h"
#include "fathom/numeric/dyadic.h"
#include "fathom/numeric/rounding.h"
#include "tests/image/map_samples.h"

namespace fathom {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using namespace fathom::checks;

/// The ray of pixel (0, 0) is the z axis; its neighbours are 1/fx and 1/fy away.
Camera easy_camera() {
  Camera camera;
  camera.width = 4;
  camera.height = 1;
  camera.projection.cx = 0.5;
  camera.projection.cy = 0.5;
  return camera;
}

TEST(PointAt, ObeysTheSpecification) {
  Camera camera;
  camera.projection.fx = 2;
  camera.projection.fy = 4;
  camera.projection.cx = 1;
  camera.projection.cy = 3;
  camera.projection.skew = 0.5;
  camera.projection.pixel_centre = 0;
  // Forward: U/W = fx·x' + skew·y' + cx + ½ must be i + ½, V/W likewise.
  const auto [x, y, z] = point_at(camera, 7, 5, 8);
  EXPECT_EQ(2 * x / z + 0.5 * y / z + 1.5, 7.5);
  EXPECT_EQ(4 * y / z + 3.5, 5.5);
  EXPECT_EQ(z, 8);
  camera.projection.model = ProjectionModel::orthographic;
  camera.projection.pixel_centre = 0.5;
  const auto p = point_at(camera, 7, 5, 8);
  EXPECT_EQ(2 * p[0] + 0.5 * p[1] + 1, 7.5);
  EXPECT_EQ(4 * p[1] + 3, 5.5);
  EXPECT_EQ(p[2], 8);
}

TEST(Quantities, DistanceAndDepthOfAThreeFourFiveTriangle) {
  Camera camera = easy_camera();
  camera.projection.fx = 4;  // pixel 3 lies (3 + ½ − ½)/4 = ¾ to the right: a ray of length 5/4
  const DepthMap map = map_of(4, 1, "Z", std::vector<float>{8, inf, std::nanf(""), 8});
  const DepthMap distance =
      convert_quantity(map, DepthQuantity::planar_depth, DepthQuantity::ray_distance, camera);
  EXPECT_EQ(*distance.values<float>("distance"), (std::vector<float>{8, inf, inf, 10}));
  const DepthMap back =
      convert_quantity(distance, DepthQuantity::ray_distance, DepthQuantity::planar_depth, camera);
  EXPECT_EQ(*back.values<float>("Z"), (std::vector<float>{8, inf, inf, 8}));
  camera.projection.model = ProjectionModel::orthographic;
  const DepthMap flat =
      convert_quantity(map, DepthQuantity::planar_depth, DepthQuantity::ray_distance, camera);
  EXPECT_EQ(flat.values<float>("distance")->at(3), 8);
}

TEST(Quantities, DisparityIsMiddleburys) {
  Camera camera = easy_camera();
  camera.projection.fx = 100;
  const StereoRig rig{0.5, 4};
  const DepthMap map = map_of(3, 1, "Z", std::vector<double>{10, INFINITY, 2.5});
  const DepthMap d =
      convert_quantity(map, DepthQuantity::planar_depth, DepthQuantity::disparity, camera, rig);
  EXPECT_THAT(*d.values<double>("disparity"), ElementsAre(1, 0, 16));
  EXPECT_EQ(d.texts.at("fathom.background"), "0");
  const DepthMap back =
      convert_quantity(d, DepthQuantity::disparity, DepthQuantity::planar_depth, camera, rig);
  EXPECT_THAT(*back.values<double>("Z"), ElementsAre(10, INFINITY, 2.5));
  EXPECT_EQ(back.texts.count("fathom.background"), 0u);
  const DepthMap unknown = convert_quantity(map, DepthQuantity::planar_depth,
                                            DepthQuantity::disparity, camera, rig, INFINITY);
  EXPECT_THAT(*unknown.values<double>("disparity"), ElementsAre(1, INFINITY, 16));
  const DepthMap behind = map_of(2, 1, "disparity", std::vector<float>{-4, -4.5f});
  try {
    convert_quantity(behind, DepthQuantity::disparity, DepthQuantity::planar_depth, camera, rig);
    FAIL();
  } catch (const InputError& failure) {
    EXPECT_THAT(failure.what(), HasSubstr("pixel (1, 0)"));
  }
  const auto to_disparity = [&](const Camera& c, std::optional<StereoRig> r) {
    convert_quantity(map, DepthQuantity::planar_depth, DepthQuantity::disparity, c, r);
  };
  EXPECT_THROW(to_disparity(camera, std::nullopt), UsageError);
  EXPECT_THROW(to_disparity(camera, StereoRig{0, 0}), UsageError);
  camera.projection.model = ProjectionModel::orthographic;
  EXPECT_THROW(to_disparity(camera, rig), UsageError);
  EXPECT_THROW(
      convert_quantity(map, DepthQuantity::ray_distance, DepthQuantity::disparity, camera, rig),
      UsageError);
}

TEST(Storage, CodesRoundHalfToEvenExactly) {
  // 2.5 → 2 and 3.5 → 4; just above and below 2.5 go their ways.
  const DepthMap map = map_of(6, 1, "Z",
                              std::vector<float>{2.5f, 3.5f, std::nextafterf(2.5f, 3),
                                                 std::nextafterf(2.5f, 2), inf, 65535.25f});
  const DepthMap codes = with_storage(map, "Z", StoredType::scaled_unorm16, 1.0);
  EXPECT_THAT(*codes.values<std::uint16_t>("Z"), ElementsAre(2, 4, 3, 2, 0, 65535));
  EXPECT_EQ(codes.png_scale, 1.0);
  // 0.1 is a little above a tenth: 0.1·25 is above 2.5, though binary64 multiplies it to 2.5.
  ASSERT_EQ(0.1 * 25, 2.5);
  const DepthMap above = map_of(1, 1, "Z", std::vector<double>{25});
  EXPECT_THAT(*with_storage(above, "", StoredType::scaled_unorm16, 0.1).values<std::uint16_t>("Z"),
              ElementsAre(3));
}

/// Depths whose codes lie next to the middle between two integers, on both sides of it.
std::vector<double> depths_near_ties(double scale) {
  std::vector<double> depths;
  for (const double code :
       {1.0, 2.0, 3.0, 4.0, 127.0, 1000.0, 32766.0, 32767.0, 65533.0, 65534.0}) {
    double depth = (code + 0.5) / scale;
    for (int k = 0; k < 3; ++k) depth = std::nextafter(depth, 0.0);
    for (int k = 0; k < 7; ++k, depth = std::nextafter(depth, INFINITY)) depths.push_back(depth);
  }
  return depths;
}

TEST(Storage, CodesAreThoseOfExactProducts) {
  int settled_by_error = 0;
  for (const double scale :
       {0.1, 1.0 / 3, 0.7, 1.0, 3.0, 256.1, 1000.0, 1e9 / 7, 0x1p-900, 1e300}) {
    const std::vector<double> depths = depths_near_ties(scale);
    const DepthMap map = map_of(static_cast<std::uint32_t>(depths.size()), 1, "Z", depths);
    const DepthMap stored = with_storage(map, "Z", StoredType::scaled_unorm16, scale);
    const auto& codes = *stored.values<std::uint16_t>("Z");
    for (std::size_t k = 0; k < depths.size(); ++k) {
      const auto expected = round_to_integer(Dyadic(scale) * Dyadic(depths[k]), 65535);
      ASSERT_TRUE(expected.has_value());
      EXPECT_EQ(codes[k], *expected) << std::hexfloat << scale << " · " << depths[k];
      if (std::nearbyint(scale * depths[k]) != static_cast<double>(*expected)) ++settled_by_error;
    }
  }
  EXPECT_GT(settled_by_error, 20);
}

TEST(Storage, CodesThatDoNotFitAreErrors) {
  for (const float depth : {0.5f, 0.25f, 65535.5f, 1e30f}) {
    const DepthMap map = map_of(2, 1, "Z", std::vector<float>{1, depth});
    try {
      with_storage(map, "Z", StoredType::scaled_unorm16, 1.0);
      FAIL() << depth;
    } catch (const OutputError& failure) {
      EXPECT_THAT(failure.what(), HasSubstr("pixel (1, 0)"));
    }
  }
  const DepthMap map = map_of(1, 1, "Z", std::vector<float>{1});
  EXPECT_THROW(with_storage(map, "Z", StoredType::scaled_unorm16), UsageError);
  EXPECT_THROW(with_storage(map, "Z", StoredType::scaled_unorm16, -1.0), UsageError);
  EXPECT_THROW(with_storage(map, "A", StoredType::binary32), UsageError);
}

TEST(Storage, CodesDecodeWithTheirScaleAndARoundingOnly) {
  DepthMap map = map_of(3, 1, "Z", std::vector<std::uint16_t>{0, 1000, 1});
  EXPECT_THROW(with_storage(map, "Z", StoredType::binary32), InputError);
  map.png_scale = 3000;
  EXPECT_THAT(*with_storage(map, "Z", StoredType::binary32).values<float>("Z"),
              ElementsAre(inf, 1.0f / 3, 1.0f / 3000));
  EXPECT_THAT(*with_storage(map, "Z", StoredType::binary64).values<double>("Z"),
              ElementsAre(INFINITY, 1.0 / 3, 1.0 / 3000));
}

TEST(Storage, AllCodesSurviveDecodingAndEncoding) {
  std::vector<std::uint16_t> codes(65536);
  for (std::size_t k = 0; k < codes.size(); ++k) codes[k] = static_cast<std::uint16_t>(k);
  DepthMap map = map_of(256, 256, "Z", codes);
  map.png_scale = 5000;
  for (const StoredType type : {StoredType::binary32, StoredType::binary64}) {
    const DepthMap depth = with_storage(map, "Z", type);
    const DepthMap back = with_storage(depth, "Z", StoredType::scaled_unorm16, 5000);
    EXPECT_EQ(*back.values<std::uint16_t>("Z"), codes);
  }
}

std::string contents_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(PointCloud, HoldsPointsNormalsAndIdentifiers) {
  const Folder folder;
  Camera camera = easy_camera();
  camera.projection.fx = 4;
  camera.world_to_camera = {{{0, 1, 0, 0}, {-1, 0, 0, 0}, {0, 0, 1, -100}}};
  DepthMap map = map_of(4, 1, "Z", std::vector<float>{8, inf, inf, 8});
  map.channels.push_back({"id", std::vector<std::uint32_t>{5, no_surface, 6, 7}});
  for (const char* axis : {"N.X", "N.Y", "N.Z"})
    map.channels.push_back({axis, std::vector<float>(4, axis[2] == 'X' ? 1.0f : 0.0f)});
  PointCloudOptions options;
  write_point_cloud(map, camera, folder / "a.ply", options);
  const std::string header =
      "ply\nformat binary_little_endian 1.0\ncomment world frame\nelement vertex 2\n"
      "property double x\nproperty double y\nproperty double z\n"
      "property float nx\nproperty float ny\nproperty float nz\nproperty uint id\nend_header\n";
  const std::string file = contents_of(folder / "a.ply");
  ASSERT_EQ(file.substr(0, header.size()), header);
  ASSERT_EQ(file.size(), header.size() + 2 * (24 + 12 + 4));
  const auto* data = reinterpret_cast<const std::byte*>(file.data()) + header.size();
  const auto number = [&](std::size_t at) { return load<double>(data + at, std::endian::little); };
  // Pixel 3: (6, 0, 8) in the camera; the world's y is the camera's x, its x minus the camera's y.
  EXPECT_EQ(number(40), 0);
  EXPECT_EQ(number(48), 6);
  EXPECT_EQ(number(56), 108);
  EXPECT_EQ(load<float>(data + 64, std::endian::little), 1);
  EXPECT_EQ(load<std::uint32_t>(data + 76, std::endian::little), 7u);

  options.frame = PointFrame::camera;
  options.binary64 = false;
  write_point_cloud(map, camera, folder / "a.ply", options);
  const std::string second = contents_of(folder / "a.ply");
  const auto* last = reinterpret_cast<const std::byte*>(second.data()) + second.size() - 28;
  const auto small = [&](std::size_t k) { return load<float>(last + 4 * k, std::endian::little); };
  EXPECT_EQ(small(0), 6);
  EXPECT_EQ(small(1), 0);
  EXPECT_EQ(small(2), 8);
  EXPECT_EQ(small(3), 0);  // the world's x is the camera's −y
  EXPECT_EQ(small(4), -1);
}

TEST(PointCloud, TakesExactPositionsWhereTheMapHasThem) {
  const Folder folder;
  DepthMap map = map_of(1, 1, "Z", std::vector<float>{8});
  for (const char* axis : {"P.X", "P.Y", "P.Z"})
    map.channels.push_back({axis, std::vector<float>{static_cast<float>(axis[2])}});
  write_point_cloud(map, easy_camera(), folder / "a.ply");
  const std::string file = contents_of(folder / "a.ply");
  const auto* data = reinterpret_cast<const std::byte*>(file.data()) + file.size() - 24;
  EXPECT_EQ(load<double>(data, std::endian::little), 'X');
  EXPECT_EQ(load<double>(data + 16, std::endian::little), 'Z');
  EXPECT_THROW(
      write_point_cloud(map_of(1, 1, "A", std::vector<float>{1}), easy_camera(), folder / "b.ply"),
      UsageError);
  EXPECT_THROW(write_point_cloud(map, easy_camera(), "/dev/full"), OutputError);
}

}  // namespace
}  // namespace fathom
