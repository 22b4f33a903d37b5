// Maps and cameras that users of the library fill in: what is wrong with one is told in a line, and
// no function takes one that is wrong.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <optional>
#include <ostream>

#include "fathom/failures/errors.h"
#include "fathom/image/compare.h"
#include "fathom/image/convert.h"
#include "fathom/image/cryptomatte.h"
#include "fathom/image/map_files.h"
#include "fathom/image/point_cloud.h"
#include "fathom/image/preview.h"
#include "fathom/image/surface.h"
#include "map_samples.h"

namespace fathom {
namespace {

using ::testing::HasSubstr;

/// A map of 2x1 pixels in which nothing is wrong.
DepthMap good_map() {
  DepthMap map;
  map.width = 2;
  map.height = 1;
  map.channels.push_back({"Z", Samples<float>{1.0F, 2.0F}});
  return map;
}

Camera good_camera() {
  return {.width = 2, .height = 1};
}

DepthMap short_map() {
  DepthMap map = good_map();
  map.channels[0].values = Samples<float>{1.0F};
  return map;
}

struct Fault {
  const char* name;
  std::function<void(DepthMap&)> make;
  std::optional<std::string> message;
};

void PrintTo(const Fault& fault, std::ostream* to) {
  *to << fault.name;
}

class MapFault : public ::testing::TestWithParam<Fault> {};

TEST_P(MapFault, IsNamed) {
  DepthMap map = good_map();
  GetParam().make(map);
  EXPECT_EQ(find_fault(map), GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    All, MapFault,
    ::testing::Values(
        Fault{"None", [](DepthMap&) {}, std::nullopt},
        Fault{"NoColumns", [](DepthMap& map) { map.width = 0; }, "it has no pixels"},
        Fault{"NoRows", [](DepthMap& map) { map.height = 0; }, "it has no pixels"},
        Fault{"NoChannels", [](DepthMap& map) { map.channels.clear(); }, "it has no channels"},
        Fault{"TooFewValues", [](DepthMap& map) { map = short_map(); },
              "channel 'Z' has 1 value, expected one for each of 2 pixels"},
        Fault{"NameWithNul", [](DepthMap& map) { map.channels[0].name.push_back('\0'); },
              "the name of a channel holds a NUL"},
        Fault{"NameTwice", [](DepthMap& map) { map.channels.push_back(map.channels[0]); },
              "it has two channels 'Z'"},
        Fault{"ScaleOfZero", [](DepthMap& map) { map.png_scale = 0; },
              "png_scale is not a positive number"},
        Fault{"NegativeScale", [](DepthMap& map) { map.png_scale = -1; },
              "png_scale is not a positive number"},
        Fault{"InfiniteScale",
              [](DepthMap& map) { map.png_scale = std::numeric_limits<double>::infinity(); },
              "png_scale is not a positive number"},
        Fault{"ScaleThatIsNoNumber", [](DepthMap& map) { map.png_scale = std::nan(""); },
              "png_scale is not a positive number"},
        Fault{"Scale", [](DepthMap& map) { map.png_scale = 1000; }, std::nullopt}),
    [](const auto& fault) { return std::string(fault.param.name); });

/// A function that takes a map and a camera, one of which is wrong.
struct Door {
  const char* name;
  std::function<void(const DepthMap&, const Camera&, const checks::Folder&)> call;
  bool takes_a_camera = false;
};

void PrintTo(const Door& door, std::ostream* to) {
  *to << door.name;
}

class EveryFunction : public ::testing::TestWithParam<Door> {
 protected:
  [[nodiscard]] std::string failure_of(const DepthMap& map, const Camera& camera) const {
    try {
      GetParam().call(map, camera, folder_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  }
  checks::Folder folder_;
};

TEST_P(EveryFunction, TakesWhatIsRight) {
  EXPECT_EQ(failure_of(good_map(), good_camera()), "none");
}

TEST_P(EveryFunction, RefusesAMapThatIsWrong) {
  EXPECT_THAT(failure_of(short_map(), good_camera()), HasSubstr("map: channel 'Z' has 1 value,"));
}

TEST_P(EveryFunction, RefusesACameraThatIsWrong) {
  if (!GetParam().takes_a_camera) return;
  Camera camera = good_camera();
  camera.projection.fy = 0;
  EXPECT_EQ(failure_of(good_map(), camera), "camera: fy is 0, expected any other number");
  camera.projection.fy = 1;
  camera.world_to_camera[1][3] = std::nan("");
  EXPECT_EQ(failure_of(good_map(), camera),
            "camera: world_to_camera has an entry that is not a finite number");
}

INSTANTIATE_TEST_SUITE_P(
    All, EveryFunction,
    ::testing::Values(
        Door{"ComparesATruth",
             [](const auto& map, const auto&, const auto&) { compare_maps(map, good_map()); }},
        Door{"ComparesAnother",
             [](const auto& map, const auto&, const auto&) { compare_maps(good_map(), map); }},
        Door{"DrawsDifferences",
             [](const auto& map, const auto&, const auto&) { draw_differences(good_map(), map); }},
        Door{"ConvertsAQuantity",
             [](const auto& map, const auto& camera, const auto&) {
               convert_quantity(map, DepthQuantity::planar_depth, DepthQuantity::ray_distance,
                                camera);
             },
             true},
        Door{"ConvertsStorage", [](const auto& map, const auto&,
                                   const auto&) { with_storage(map, "Z", StoredType::binary64); }},
        Door{"AddsMattes",
             [](const auto& map, const auto&, const auto&) {
               DepthMap copy = map;
               Mattes mattes;
               mattes.counts = {0, 0};
               add_mattes(copy, mattes);
             }},
        Door{"WritesAMap",
             [](const auto& map, const auto&, const auto& folder) {
               write_map(map, folder / "map.pfm", MapFormat::pfm, {});
             }},
        Door{"WritesPoints",
             [](const auto& map, const auto& camera, const auto& folder) {
               write_point_cloud(map, camera, folder / "points.ply");
             },
             true},
        Door{"DrawsAPreview", [](const auto& map, const auto&, const auto&) { draw_preview(map); }},
        Door{"FindsSurfaces", [](const auto& map, const auto&,
                                 const auto&) { surface_mask(map, map.channels[0]); }}),
    [](const auto& door) { return std::string(door.param.name); });

}  // namespace
}  // namespace fathom
