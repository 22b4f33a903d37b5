#include "fathom/image/map_formats.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "fathom/failures/errors.h"

namespace fathom {
namespace {

std::string refusal(const char* path) {
  try {
    (void)require_map_format(path);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

TEST(MapFormats, SuffixesLeadToFormats) {
  std::set<std::string_view> suffixes, names;
  for (const MapFormatDescription& format : map_format_table) {
    EXPECT_EQ(&description_of(format.format), &format);
    EXPECT_TRUE(names.insert(format.name).second) << format.name;
    EXPECT_FALSE(format.suffixes[0].empty()) << format.name;
    for (const std::string_view suffix : format.suffixes) {
      if (suffix.empty()) continue;
      EXPECT_TRUE(suffixes.insert(suffix).second) << suffix;
      EXPECT_EQ(map_format_of("a/b.c" + std::string(suffix)), format.format);
    }
  }
  EXPECT_EQ(suffixes.size(), 8U);
}

TEST(MapFormats, NoSuffixIsNoFormat) {
  for (const char* path : {"", "map", ".exr", "map.", "map.exr/", "map.jpg", "map.exr.gz"})
    EXPECT_EQ(map_format_of(path), std::nullopt) << path;
}

TEST(MapFormats, ListsForMessages) {
  EXPECT_EQ(suffixes_of_maps(), ".exr, .pfm, .png, .npy, .npz, .bin or .tif");
  EXPECT_EQ(suffixes_of_maps(" and "), ".exr, .pfm, .png, .npy, .npz, .bin and .tif");
  EXPECT_EQ(suffixes_of_float_maps(), ".exr, .pfm, .npy, .npz, .bin or .tif");
  EXPECT_EQ(suffixes_of_complete_maps(), ".exr and .npz");
  EXPECT_EQ(suffixes_for_any_channel(), ".exr, .npy or .npz");
  EXPECT_EQ(names_of_readable_maps(), "OpenEXR, PFM, PNG, NPY, NPZ or COLMAP");
  EXPECT_EQ(refusal("a.jpg"),
            "a.jpg: expected a name that ends in .exr, .pfm, .png, .npy, .npz, .bin or .tif");
  EXPECT_EQ(refusal("a.TIFF"), "");
}

TEST(MapFormats, WhatEachHolds) {
  using enum MapFormat;
  for (const MapFormat format : {exr, npz, tiff}) EXPECT_TRUE(holds_all_channels(format));
  for (const MapFormat format : {pfm, png, npy, colmap}) EXPECT_FALSE(holds_all_channels(format));
  EXPECT_TRUE(keeps_all_channels(exr) && keeps_all_channels(npz) && !keeps_all_channels(tiff));
  EXPECT_TRUE(holds_parts(npy) && holds_parts(colmap) && !holds_parts(pfm) && !holds_parts(exr));
  EXPECT_TRUE(has_zero_for_none(png) && has_zero_for_none(colmap) && !has_zero_for_none(tiff));
}

TEST(MapFormats, GreatestSizes) {
  for (const MapFormatDescription& format : map_format_table) {
    const bool is_limited = format.greatest_side != any_side || format.pixels_beyond != any_pixels;
    EXPECT_EQ(is_limited, !format.limit.empty()) << format.name;
  }
  EXPECT_NO_THROW(require_size(MapFormat::exr, 0x3FFFFFFF, 1, "a.exr"));
  EXPECT_THROW(require_size(MapFormat::exr, 1, 0x40000000, "a.exr"), OutputError);
  EXPECT_NO_THROW(require_size(MapFormat::png, 1, 0x7FFFFFFF, "a.png"));
  EXPECT_THROW(require_size(MapFormat::png, 0x80000000, 1, "a.png"), OutputError);
  EXPECT_NO_THROW(require_size(MapFormat::npy, 0xFFFFFFFF, 0xFFFFFFFF, "a.npy"));
}

}  // namespace
}  // namespace fathom
