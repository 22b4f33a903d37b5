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

}  // namespace
}  // namespace fathom::view
