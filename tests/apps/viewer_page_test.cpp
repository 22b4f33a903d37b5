// The page of `fathom view`, as it is written; tests/browser shows it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <string>

#include "apps/view/page.h"
#include "fathom/failures/errors.h"

namespace fathom::view {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

/// A map without two equal values.
std::vector<ViewedMap> some_maps() {
  ViewedMap viewed;
  viewed.name = "ramp.npy";
  viewed.map.width = 600;
  viewed.map.height = 20;
  Samples<float> values(std::size_t{600} * 20);
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = 1 + static_cast<float>(k * k) / 7;
  viewed.map.channels.push_back({"Z", std::move(values)});
  return {viewed};
}

std::string page_of(const std::vector<ViewedMap>& maps, std::uint64_t most_bytes) {
  std::string page;
  write_page(
      maps, Questions::none, [&](std::string_view part) { page += part; }, {}, most_bytes);
  return page;
}

TEST(ViewerPage, IsRefusedWhereItWouldBeTooLarge) {
  const std::vector<ViewedMap> maps = some_maps();
  const std::string page = page_of(maps, most_page_bytes);
  EXPECT_EQ(page_of(maps, page.size()), page);
  EXPECT_THAT(
      [&] { page_of(maps, page.size() - 1); },
      ThrowsMessage<OutputError>(AllOf(StartsWith("the maps need a page of more than 0.0 GiB"),
                                       HasSubstr("fathom convert --channel"))));
}

TEST(ViewerPage, ReportsHowMuchIsDone) {
  std::vector<double> shares;
  write_page(
      some_maps(), Questions::none, [](std::string_view) {},
      [&](double share) { shares.push_back(share); });
  EXPECT_THAT(shares, ::testing::ElementsAre(0.5, 1.0));  // of two tiles
}

/// Directions that no neighbour predicts: X, Y and Z of unit vectors, rounded to binary32.
ViewedMap some_directions() {
  ViewedMap viewed;
  viewed.name = "directions.npz";
  viewed.map.width = 512;
  viewed.map.height = 64;
  constexpr std::size_t pixels = std::size_t{512} * 64;
  std::array<Samples<float>, 3> parts;
  parts.fill(Samples<float>(pixels));
  std::mt19937 random(51);
  for (std::size_t k = 0; k < pixels; ++k) {
    const double z = 2 * static_cast<double>(random()) / 4294967296.0 - 1;
    const double angle = static_cast<double>(random()), radius = std::sqrt(1 - z * z);
    const std::array vector{radius * std::cos(angle), radius * std::sin(angle), z};
    for (std::size_t part = 0; part < 3; ++part) {
      parts[part][k] = static_cast<float>(vector[part]);
    }
  }
  for (std::size_t part = 0; part < 3; ++part) {
    viewed.map.channels.push_back({std::string("N.") + "XYZ"[part], std::move(parts[part])});
  }
  return viewed;
}

/// The bytes of a plane's text.
std::size_t size_of_plane(const std::string& page, const std::string& id) {
  const std::size_t begin = page.find("id=\"" + id + "\">");
  return page.find("</script>", begin) - begin;
}

// Two numbers and the sign of the third determine it; its last bits remain.
TEST(ViewerPage, TheThirdPartOfDirectionsTakesLittleRoom) {
  const std::string page = page_of({some_directions()}, most_page_bytes);
  EXPECT_LT(size_of_plane(page, "m0-c2-0-0"), size_of_plane(page, "m0-c0-0-0") * 3 / 5);
}

/// As many directions as there are triangles, each at pixels all over the map.
ViewedMap some_triangles() {
  ViewedMap viewed = some_directions();
  std::mt19937 random(52);
  Samples<std::uint32_t> triangles(std::get<Samples<float>>(viewed.map.channels[0].values).size());
  for (std::uint32_t& triangle : triangles) triangle = random() % 1000;
  for (ImageChannel& channel : viewed.map.channels) {
    auto& part = std::get<Samples<float>>(channel.values);
    const Samples<float> of_triangle = part;
    for (std::size_t k = 0; k < part.size(); ++k) part[k] = of_triangle[triangles[k]];
  }
  viewed.map.channels.push_back({"id", std::move(triangles)});
  return viewed;
}

TEST(ViewerPage, HoldsTheDirectionOfATriangleOnce) {
  ViewedMap viewed = some_triangles();
  const std::string page = page_of({viewed}, most_page_bytes);
  viewed.map.channels.pop_back();
  const std::string without_triangles = page_of({viewed}, most_page_bytes);
  for (const char* part : {"m0-c0-0-0", "m0-c1-0-0", "m0-c2-0-0"}) {
    EXPECT_LT(size_of_plane(page, part), size_of_plane(without_triangles, part) / 5) << part;
  }
}

/// Depths of planes of random directions, in blocks of 4 × 4 pixels, from 5 to 15 units away.
ViewedMap some_planes() {
  ViewedMap viewed;
  viewed.name = "planes.exr";
  DepthMap& map = viewed.map;
  map.width = 256;
  map.height = 256;
  viewed.camera = Camera{};
  Camera& camera = *viewed.camera;
  camera.width = map.width;
  camera.height = map.height;
  camera.projection.fx = camera.projection.fy = 200;
  camera.projection.cx = camera.projection.cy = 128;
  camera.world_to_camera = {{{0, 1, 0, 2}, {-1, 0, 0, 3}, {0, 0, 1, 4}}};
  Samples<float> depths(std::size_t{256} * 256);
  std::array<Samples<float>, 3> parts;
  parts.fill(depths);
  constexpr std::size_t blocks = 64;
  std::mt19937 random(53);
  const auto fraction = [&] { return static_cast<double>(random()) / 4294967296.0; };
  for (std::size_t block = 0; block < blocks * blocks; ++block) {
    const double a = fraction() - 0.5, b = fraction() - 0.5, height = 5 + 5 * fraction();
    const double length = std::sqrt(a * a + b * b + 1);
    for (std::size_t k = 0; k < 16; ++k) {
      const std::size_t x = block % blocks * 4 + k % 4, y = block / blocks * 4 + k / 4;
      const double u = (static_cast<double>(x) - 127.5) / 200;
      const double v = (static_cast<double>(y) - 127.5) / 200;
      const std::size_t pixel = y * 256 + x;
      depths[pixel] = static_cast<float>(height / (a * u + b * v + 1));
      // From the camera to the world: (x, y, z) becomes (−y, x, z).
      parts[0][pixel] = static_cast<float>(-b / length);
      parts[1][pixel] = static_cast<float>(a / length);
      parts[2][pixel] = static_cast<float>(1 / length);
    }
  }
  map.channels.push_back({"Z", std::move(depths)});
  for (std::size_t part = 0; part < 3; ++part) {
    map.channels.push_back({std::string("N.") + "XYZ"[part], std::move(parts[part])});
  }
  return viewed;
}

// 15 of 16 depths differ from the predicted ones in the last bits only.
TEST(ViewerPage, PredictsDepthsByTheirPlanes) {
  ViewedMap viewed = some_planes();
  const std::string page = page_of({viewed}, most_page_bytes);
  viewed.camera.reset();
  const std::string without_camera = page_of({viewed}, most_page_bytes);
  EXPECT_LT(size_of_plane(page, "m0-c0-0-0"), size_of_plane(without_camera, "m0-c0-0-0") / 3);
}

}  // namespace
}  // namespace fathom::view
