#include "fathom/image/files/geotiff.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "fathom/failures/errors.h"
#include "fathom/image/files/map_codecs.h"
#include "fathom/image/surface.h"
#include "tests/image/map_samples.h"
#include "tests/image/run_program.h"

/// GeoTIFFs in GDAL, OpenImageIO and OpenCV, and what is not written.
namespace fathom {
namespace {

using namespace image;
using ::testing::HasSubstr;
using ::testing::Not;
using namespace fathom::checks;

/// Looks down: 3 and 3/2 pixels to the unit, x to the right and y upwards in the image.
Camera from_above() {
  Camera camera{.width = 4, .height = 3, .projection = {.model = ProjectionModel::orthographic}};
  camera.projection.fx = 3;
  camera.projection.fy = 1.5;
  camera.world_to_camera = {{{1, 0, 0, -0.1}, {0, -1, 0, 1e6 + 1.0 / 7}, {0, 0, -1, 10}}};
  return camera;
}

/// More rows than a strip has, and a last strip that is shorter: numbers of every size, some rows
/// equal.
DepthMap plan(std::uint32_t width, std::uint32_t height) {
  const std::size_t count = std::size_t{width} * height;
  std::vector<float> z(count), position(count), a(count);
  std::mt19937_64 random(seed);
  for (std::size_t k = 0; k < count; ++k) {
    const bool seen = k % 7 != 3;
    z[k] = seen ? 100 + std::ldexp(static_cast<float>(random() % 65536), -10) : inf;
    position[k] = seen ? -z[k] : std::nanf("");
    a[k] = seen ? 1 : 0.25f;
  }
  DepthMap map = map_of(width, height, "Z", z);
  map.channels.push_back({"A", a});
  for (const char* name : {"P.X", "P.Y", "P.Z"}) map.channels.push_back({name, position});
  map.texts = {{"note", R"({"width": 3, "a": "<&>&lt;"})"}, {"fathom.engine", "reference"}};
  map.camera = from_above();
  map.camera->width = width;
  map.camera->height = height;
  return map;
}

std::string unwritten(const DepthMap& map) {
  try {
    (void)encode_geotiff(map, {}, 1, "a.tif");
  } catch (const OutputError& failure) {
    return failure.what();
  }
  return "it was written";
}

Outcome python(const Folder& folder, const std::string& script) {
  return run("cd '" + (folder / "").string() + "' && /usr/bin/python3 - <<'END'\n" + script +
             "END\n");
}

const std::string open_in_gdal = R"(
import json
import numpy as np
from osgeo import gdal
gdal.UseExceptions()
maps = np.load('map.npz')
file = gdal.Open('map.tif')
bands = [file.GetRasterBand(i + 1) for i in range(file.RasterCount)]
)";

TEST(GeoTiff, GdalReadsBandsPlaceAndTexts) {
  const Folder folder;
  const DepthMap map = plan(301, 777);
  write_map(map, folder / "map.tif", MapFormat::tiff);
  write_map(map, folder / "map.npz", MapFormat::npz);
  const Outcome outcome = python(folder, open_in_gdal + R"(
assert [band.GetDescription() for band in bands] == ['Z', 'A', 'P.X', 'P.Y', 'P.Z']
assert file.GetGeoTransform() == (0.1, 1 / 3, 0, 1e6 + 1 / 7, 0, -2 / 3), file.GetGeoTransform()
assert file.GetMetadataItem('AREA_OR_POINT') == 'Area'
assert file.GetMetadataItem('note') == '{"width": 3, "a": "<&>&lt;"}'
assert json.loads(file.GetMetadataItem('fathom.camera'))['fx'] == 3
assert file.GetMetadataItem('fathom.engine') == 'reference'
assert file.GetMetadataItem('INTERLEAVE', 'IMAGE_STRUCTURE') == 'BAND'
assert file.GetMetadataItem('COMPRESSION', 'IMAGE_STRUCTURE') == 'DEFLATE'
assert file.GetSpatialRef().IsLocal(), file.GetProjection()
seen = np.isfinite(maps['Z'])
for i, band in enumerate(bands):
    assert band.DataType == gdal.GDT_Float32 and np.isnan(band.GetNoDataValue())
    values = band.ReadAsArray()
    if i == 1:
        assert np.array_equal(values, maps['A'])
        continue
    assert np.array_equal(band.GetMaskBand().ReadAsArray() != 0, seen), i
    truth = maps['Z'] if i == 0 else maps['P'][..., i - 2]
    assert np.array_equal(values[seen], truth[seen]) and np.isnan(values[~seen]).all()
print('equal')
)");
  EXPECT_EQ(outcome.output, "equal\n");
  const Outcome info = run("gdalinfo '" + (folder / "map.tif").string() + "'");
  EXPECT_EQ(info.status, 0);
  EXPECT_THAT(info.output, HasSubstr("Size is 301, 777"));
  EXPECT_THAT(info.output, Not(HasSubstr("Warning")));
}

/// Every bit of them.
std::string as_python(const std::array<double, 6>& numbers) {
  std::string list = "[";
  for (const double each : numbers) {
    char text[40];
    std::snprintf(text, sizeof text, "%a", each);
    list += "float.fromhex('" + std::string(text) + "'), ";
  }
  return list + "]";
}

TEST(GeoTiff, GdalReadsEveryPlace) {
  const Folder folder;
  Camera from_below = from_above(), south_up = from_above(), turned = from_above();
  from_below.projection.fx = -3;
  south_up.world_to_camera[1] = {0, 1, 0, 0.7};
  turned.world_to_camera = {{{0, 0.3, 0, 5}, {0.7, 0, 0, 0.1}, {0, 0, -1, 10}}};
  Camera sheared = turned;
  sheared.world_to_camera[0][0] = 1e9 / 3;
  sheared.projection.skew = 0.2;
  for (const Camera& camera : {from_above(), from_below, south_up, turned, sheared}) {
    const DepthMap map = plan(4, 3);
    const std::array<double, 6> g = world_from_image(camera).value();
    write_map(map, folder / "map.tif", MapFormat::tiff, {.camera = camera});
    write_map(map, folder / "map.npz", MapFormat::npz);
    const Outcome outcome = python(folder, open_in_gdal + "truth = " + as_python(g) +
                                               "\nassert list(file.GetGeoTransform()) == truth, "
                                               "(file.GetGeoTransform(), truth)\nprint('equal')\n");
    EXPECT_EQ(outcome.output, "equal\n");
  }
}

TEST(GeoTiff, TheBackgroundThatAMapNamesIsThatOfAllBands) {
  const Folder folder;
  DepthMap map = plan(5, 4);
  map.channels.push_back({"id", Samples<std::uint32_t>(20, 16777216)});
  std::get<Samples<std::uint32_t>>(map.channels.back().values)[3] = no_surface;
  std::get<Samples<std::uint32_t>>(map.channels.back().values)[10] = no_surface;
  std::get<Samples<std::uint32_t>>(map.channels.back().values)[17] = no_surface;
  write_map(with_background(map, -9999), folder / "map.tif", MapFormat::tiff);
  write_map(map, folder / "map.npz", MapFormat::npz);
  const Outcome outcome = python(folder, open_in_gdal + R"(
seen = np.isfinite(maps['Z'])
for i, band in enumerate(bands):
    assert band.GetNoDataValue() == -9999
    values = band.ReadAsArray()
    assert i == 1 or (values[~seen] == -9999).all() and (values[seen] != -9999).all()
assert (bands[5].ReadAsArray()[seen] == 16777216).all()
print('equal')
)");
  EXPECT_EQ(outcome.output, "equal\n");
}

TEST(GeoTiff, OpenImageIoAndOpenCvReadTheSame) {
  const Folder folder;
  DepthMap map = plan(301, 777);
  write_map(map, folder / "map.tif", MapFormat::tiff);
  write_map(map, folder / "map.npz", MapFormat::npz);
  map.channels.resize(1);
  write_map(map, folder / "z.tif", MapFormat::tiff);
  const Outcome outcome = python(folder, R"(
import cv2
import numpy as np
import OpenImageIO as oiio
maps = np.load('map.npz')
seen = np.isfinite(maps['Z'])
truth = [maps['Z'], maps['A'], *np.moveaxis(maps['P'], 2, 0)]
values = oiio.ImageInput.open('map.tif').read_image('float')
assert values.shape == (777, 301, 5), values.shape
for i, channel in enumerate(truth):
    assert np.array_equal(values[..., i][seen], channel[seen]), i
depth = cv2.imread('z.tif', cv2.IMREAD_UNCHANGED)
assert depth.dtype == np.float32 and depth.shape == (777, 301)
assert np.array_equal(depth[seen], maps['Z'][seen]) and np.isnan(depth[~seen]).all()
print('equal')
)");
  EXPECT_EQ(outcome.output, "equal\n");
}

TEST(GeoTiff, BytesAreTheSameWithAnyNumberOfThreads) {
  const DepthMap map = plan(301, 777);
  EXPECT_EQ(encode_geotiff(map, {}, 1, "a.tif"), encode_geotiff(map, {}, 3, "a.tif"));
}

TEST(GeoTiff, WhatItCannotHoldIsRefused) {
  DepthMap nowhere = plan(4, 3);
  nowhere.camera.reset();
  EXPECT_EQ(unwritten(nowhere),
            "a.tif: a GeoTIFF needs an orthographic camera that looks straight down or up the "
            "world's z axis; .exr holds the map of any camera");
  DepthMap map = plan(4, 3);
  map.channels.push_back({"id", Samples<std::uint32_t>(12, 16777217)});
  EXPECT_EQ(
      unwritten(map),
      "a.tif: pixel (0, 0): channel 'id' has the number 16777217, and binary32 holds those up "
      "to 16777216; .exr holds all");
  map.channels.back() = {"Z", Samples<double>(12)};
  map.channels.back().name = "wide";
  EXPECT_THAT(unwritten(map), HasSubstr("channel 'wide' is stored otherwise"));
  map.channels.pop_back();
  std::get<Samples<float>>(map.channels[2].values)[0] = -5;
  EXPECT_THAT(unwritten(with_background(map, -5)),
              HasSubstr("pixel (0, 0): a surface has the value -5 in channel 'P.X'"));
  map.texts["odd"] = "a\1b";
  EXPECT_EQ(unwritten(map),
            "a.tif: a GeoTIFF cannot hold the text 'odd', which has a control character");
  EXPECT_THROW(require_size(MapFormat::tiff, 32768, 32768, "a.tif"), OutputError);
  EXPECT_NO_THROW(require_size(MapFormat::tiff, 32768, 32767, "a.tif"));
}

TEST(GeoTiff, IsNotRead) {
  for (const auto& magic : {std::string("II*\0", 4), std::string("MM\0*", 4)}) {
    files::Bytes bytes;
    files::append(bytes, magic + "anything");
    try {
      decode_map(bytes, "a.tif");
      FAIL() << "it was read";
    } catch (const InputError& failure) {
      EXPECT_STREQ(failure.what(),
                   "a.tif: TIFF is written, not read: give the map as EXR, NPZ or NPY");
    }
  }
}

}  // namespace
}  // namespace fathom
