#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fathom/failures/errors.h"
#include "fathom/image/files/map_codecs.h"
#include "fathom/image/surface.h"
#include "tests/image/map_samples.h"
#include "tests/image/run_program.h"

/// Dense maps of COLMAP's: bytes, what each value means, hostile files, and a reader in NumPy.
namespace fathom {
namespace {

using namespace image;
using namespace files;
using ::testing::HasSubstr;
using namespace fathom::checks;

Bytes bytes_of(const std::string& text) {
  Bytes bytes;
  append(bytes, text);
  return bytes;
}

std::vector<const ImageChannel*> all_of(const DepthMap& map) {
  std::vector<const ImageChannel*> channels;
  for (const ImageChannel& channel : map.channels) channels.push_back(&channel);
  return channels;
}

Bytes encoded(const DepthMap& map) {
  return encode_colmap(map, all_of(map), "a.bin");
}

std::string refusal_of(const std::string& text) {
  try {
    decode_map(bytes_of(text), "a.bin");
  } catch (const InputError& failure) {
    return failure.what();
  }
  return "it was read";
}

std::string unwritten(const DepthMap& map) {
  try {
    (void)encoded(map);
  } catch (const OutputError& failure) {
    return failure.what();
  }
  return "it was written";
}

DepthMap normals_of(const std::vector<float>& x, const std::vector<float>& y,
                    const std::vector<float>& z) {
  DepthMap map = map_of(static_cast<std::uint32_t>(x.size()), 1, "Nc.X", x);
  map.channels.push_back({"Nc.Y", y});
  map.channels.push_back({"Nc.Z", z});
  return map;
}

TEST(Colmap, StandsTopRowFirstAndLittleEndianWithZeroForNone) {
  const DepthMap map = map_of(2, 2, "Z", std::vector<float>{1, 2, inf, 1.5f});
  const std::string file("2&2&1&\0\0\x80\x3f\0\0\0\x40\0\0\0\0\0\0\xc0\x3f", 22);
  EXPECT_EQ(encoded(map), bytes_of(file));
  EXPECT_EQ(bits_of(decode_map(bytes_of(file), "a.bin").channels.at(0)), bits_of(map.channels[0]));
}

TEST(Colmap, NormalsArePlanesOneAfterTheOther) {
  const DepthMap map = normals_of({0, 0.6f}, {0, 0}, {0, -0.8f});
  const Bytes bytes = encoded(map);
  EXPECT_EQ(bytes.size(), 6u + 24u);
  EXPECT_EQ(ByteView(bytes).first(6).size(), 6u);
  const DepthMap back = decode_map(bytes, "a.bin");
  ASSERT_EQ(back.channels.size(), 3u);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_EQ(back.channels[c].name, map.channels[c].name);
    EXPECT_EQ(bits_of(back.channels[c]), bits_of(map.channels[c]));
  }
}

TEST(Colmap, EveryBackgroundIsZero) {
  const Bytes expected = encoded(map_of(3, 1, "Z", std::vector<float>{1, inf, 2}));
  for (const double background : {0.0, 7.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(
        encoded(with_background(map_of(3, 1, "Z", std::vector<float>{1, inf, 2}), background)),
        expected)
        << background;
  // What identifiers say counts before the depth.
  DepthMap map = map_of(3, 1, "Z", std::vector<float>{1, 5, 2});
  map.channels.push_back({"id", Samples<std::uint32_t>{0, no_surface, 0}});
  EXPECT_EQ(encode_colmap(map, {&map.channels[0]}, "a.bin"), expected);
}

TEST(Colmap, WhatItCannotHoldIsRefused) {
  EXPECT_EQ(unwritten(map_of(1, 1, "distance", std::vector<float>{1})),
            "a.bin: a COLMAP map holds planar depth, channel Z, or normals in the camera frame, "
            "channel Nc, not 'distance'");
  EXPECT_THAT(unwritten(map_of(1, 1, "Z", std::vector<double>{1})), HasSubstr("binary32 numbers"));
  DepthMap overflowed = map_of(2, 1, "Z", std::vector<float>{1, inf});
  overflowed.channels.push_back({"id", Samples<std::uint32_t>{0, 1}});
  try {
    (void)encode_colmap(overflowed, {&overflowed.channels[0]}, "a.bin");
    FAIL() << "a depth that overflowed became none";
  } catch (const OutputError& failure) {
    EXPECT_THAT(failure.what(), HasSubstr("a.bin: pixel (1, 0): depth inf cannot be"));
  }
  DepthMap zero = map_of(2, 1, "Z", std::vector<float>{1, 0});
  zero.channels.push_back({"id", Samples<std::uint32_t>{0, 1}});
  EXPECT_THROW((void)encode_colmap(zero, {&zero.channels[0]}, "a.bin"), OutputError);
  EXPECT_THAT(unwritten(normals_of({inf}, {0}, {0})), HasSubstr("a normal with inf"));
}

TEST(Colmap, HostileFilesAreRefusedInALine) {
  const auto with = [](const std::string& header, float value) {
    std::string text = header;
    text.append(reinterpret_cast<const char*>(&value), sizeof value);
    return text;
  };
  EXPECT_EQ(refusal_of(with("1&1&1&", 2)), "it was read");
  EXPECT_EQ(refusal_of(with("1&1&1&", -0.0f)), "it was read");
  const char* const number = "expected a width, a height and a number of channels";
  for (const char* text : {"1&", "1&1", "1&1&", "1&1&1", "0&1&1&", "1&0&1&", "1&1&x&abcd",
                           "1& 1&1&abcd", "1&-1&1&abcd", "1&+1&1&abcd", "4294967296&1&1&",
                           "99999999999999999999&1&1&", "1&1&99999999999999999999&"})
    EXPECT_THAT(refusal_of(text), HasSubstr(number)) << text;
  for (const char* text : {"1&1&0&", "1&1&2&abcdabcd", "1&1&4294967295&"})
    EXPECT_THAT(refusal_of(text), HasSubstr("expected 1, of depths, or 3, of normals")) << text;
  EXPECT_EQ(refusal_of("4294967295&4294967295&3&abcd"),
            "a.bin: truncated or overlong COLMAP map: expected 4294967295×4294967295 pixels of 12 "
            "bytes, found 4 bytes");
  EXPECT_THAT(refusal_of("1&1&1&abc"), HasSubstr("found 3 bytes"));
  EXPECT_THAT(refusal_of("1&1&1&abcde"), HasSubstr("found 5 bytes"));
  EXPECT_EQ(refusal_of(with("1&1&1&", -1)),
            "a.bin: pixel (0, 0): depth -1 in a COLMAP map: expected a finite number above 0, or 0 "
            "for none");
  EXPECT_THAT(refusal_of(with("1&1&1&", inf)), HasSubstr("depth inf in"));
  EXPECT_THAT(refusal_of(with("1&1&1&", std::nanf(""))), HasSubstr("depth nan in"));
  EXPECT_THAT(refusal_of(with(std::string("1&1&3&\0\0\0\0\0\0\0\0", 14), std::nanf(""))),
              HasSubstr("pixel (0, 0): a normal with nan"));
}

/// After read_array() of COLMAP's scripts/python/read_write_dense.py: a header that NumPy parses,
/// then Fortran's order of width, height and channels.
constexpr const char* read_array = R"(
import numpy as np
def read_array(path):
    with open(path, 'rb') as file:
        size = np.genfromtxt(file, delimiter='&', max_rows=1, usecols=(0, 1, 2), dtype=int)
        file.seek(0)
        ends = 0
        while ends < 3:
            ends += file.read(1) == b'&'
        values = np.fromfile(file, np.float32)
    return np.transpose(values.reshape(tuple(size), order='F'), (1, 0, 2)).squeeze()
)";

TEST(Colmap, IsReadAsItsOwnScriptDoes) {
  const Folder folder;
  DepthMap map = map_of(5, 3, "Z", std::vector<float>(15));
  for (const char* name : {"Nc.X", "Nc.Y", "Nc.Z"})
    map.channels.push_back({name, Samples<float>(15, 0)});
  for (std::size_t k = 0; k < 15; ++k) {
    const bool seen = k % 4 != 1;
    std::get<Samples<float>>(map.channels[0].values)[k] =
        seen ? 0.1f * static_cast<float>(k + 1) : inf;
    for (std::size_t c = 1; seen && c < 4; ++c)
      std::get<Samples<float>>(map.channels[c].values)[k] =
          0.5f - 0.03f * static_cast<float>(c * 15 + k);
  }
  write_map(map, folder / "depth.bin", MapFormat::colmap, {.channel = "Z"});
  write_map(map, folder / "normal.bin", MapFormat::colmap, {.channel = "Nc"});
  write_map(map, folder / "map.npz", MapFormat::npz);
  const Outcome outcome =
      run("cd '" + (folder / "").string() + "' && /usr/bin/python3 -c \"" + read_array + R"(
maps = np.load('map.npz')
depth, normal = read_array('depth.bin'), read_array('normal.bin')
assert depth.shape == (3, 5) and normal.shape == (3, 5, 3), (depth.shape, normal.shape)
assert np.array_equal(depth, np.where(np.isfinite(maps['Z']), maps['Z'], 0))
assert np.array_equal(normal, maps['Nc'])
print('equal')
")");
  EXPECT_EQ(outcome.output, "equal\n");
}

}  // namespace
}  // namespace fathom
