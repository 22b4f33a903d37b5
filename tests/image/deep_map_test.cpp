// Deep maps as OpenEXR reads them back.
#include "fathom/image/deep_map.h"

#include <ImfDeepFrameBuffer.h>
#include <ImfDeepImageStateAttribute.h>
#include <ImfDeepScanLineInputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>

#include "fathom/failures/errors.h"

namespace fathom {
namespace {

DeepMap three_pixels() {
  DeepMap map;
  map.description.width = 3;
  map.description.height = 2;
  map.description.texts["fathom.camera"] = "a camera";
  map.counts = {0, 2, 1, 0, 0, 3};
  for (std::uint32_t k = 0; k < 6; ++k) {
    const auto x = static_cast<float>(k);
    map.samples.push_back({1 + x, 1.5F + x, 0xFFFFFF00 + k, 0.125F * (x + 1), 0.25F / (x + 1)});
  }
  return map;
}

TEST(FlatMap, HasTheNearestSampleAndSumsOfAreas) {
  constexpr float none = std::numeric_limits<float>::infinity();
  const DepthMap map = flat_map(three_pixels());
  EXPECT_EQ(map.width, 3U);
  EXPECT_EQ(map.height, 2U);
  EXPECT_EQ(map.texts.at("fathom.camera"), "a camera");
  const auto expect = [&map](const char* channel, const std::vector<float>& values) {
    const auto* found = map.values<float>(channel);
    ASSERT_NE(found, nullptr) << channel;
    EXPECT_EQ(std::vector<float>(found->begin(), found->end()), values) << channel;
  };
  expect("samples", {0, 2, 1, 0, 0, 3});
  expect("Z", {none, 1, 3, none, none, 4});
  expect("ZBack", {none, 1.5F, 3.5F, none, none, 4.5F});
  expect("A", {0, 0.375F, 0.375F, 0, 0, 0.5F + 0.625F + 0.75F});
  const auto* ids = map.values<std::uint32_t>("id");
  ASSERT_NE(ids, nullptr);
  EXPECT_EQ(std::vector<std::uint32_t>(ids->begin(), ids->end()),
            (std::vector<std::uint32_t>{no_surface, 0xFFFFFF00, 0xFFFFFF02, no_surface, no_surface,
                                        0xFFFFFF03}));
}

class DeepMaps : public ::testing::TestWithParam<Compression> {
 protected:
  DeepMaps() {
    std::string name = std::filesystem::temp_directory_path() / "fathom-deep-XXXXXX";
    folder_ = ::mkdtemp(name.data());
  }
  ~DeepMaps() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_;
};

template <class T>
void read(const std::string& file, const char* channel, Imf::PixelType type,
          const std::vector<std::uint32_t>& counts, std::vector<T>& values) {
  Imf::DeepScanLineInputFile input(file.c_str());
  std::vector<std::uint32_t> found(6);
  std::vector<T*> pointers(6);
  Imf::DeepFrameBuffer pixels;
  pixels.insertSampleCountSlice(
      Imf::Slice(Imf::UINT, reinterpret_cast<char*>(found.data()), 4, 12));
  pixels.insert(channel, Imf::DeepSlice(type, reinterpret_cast<char*>(pointers.data()), sizeof(T*),
                                        3 * sizeof(T*), sizeof(T)));
  input.setFrameBuffer(pixels);
  input.readPixelSampleCounts(0, 1);
  ASSERT_EQ(found, counts);
  values.resize(6);
  T* next = values.data();
  for (std::size_t k = 0; k < 6; ++k) {
    pointers[k] = next;
    next += counts[k];
  }
  input.readPixels(0, 1);
}

TEST_P(DeepMaps, AreReadBackByOpenExr) {
  const DeepMap map = three_pixels();
  const std::string file = folder_ / "deep.exr";
  write_deep_map(map, file, GetParam());
  const Imf::DeepScanLineInputFile input(file.c_str());
  ASSERT_TRUE(Imf::hasDeepImageState(input.header()));
  EXPECT_EQ(Imf::deepImageState(input.header()), Imf::DIS_SORTED);
  EXPECT_NE(input.header().findTypedAttribute<Imf::StringAttribute>("fathom.camera"), nullptr);
  std::vector<float> A, Z, back, area;
  std::vector<std::uint32_t> id;
  read(file, "A", Imf::FLOAT, map.counts, A);
  read(file, "Z", Imf::FLOAT, map.counts, Z);
  read(file, "ZBack", Imf::FLOAT, map.counts, back);
  read(file, "area", Imf::FLOAT, map.counts, area);
  read(file, "id", Imf::UINT, map.counts, id);
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_EQ(A[k], map.samples[k].A);
    EXPECT_EQ(Z[k], map.samples[k].Z);
    EXPECT_EQ(back[k], map.samples[k].ZBack);
    EXPECT_EQ(area[k], map.samples[k].area);
    EXPECT_EQ(id[k], map.samples[k].id);
  }
}

TEST_P(DeepMaps, MayHaveNoSample) {
  DeepMap map = three_pixels();
  map.counts.assign(6, 0);
  map.samples.clear();
  const std::string file = folder_ / "deep.exr";
  write_deep_map(map, file, GetParam());
  std::vector<float> Z;
  read(file, "Z", Imf::FLOAT, map.counts, Z);
}

TEST_P(DeepMaps, AreReadBackBitForBit) {
  for (const bool has_samples : {true, false}) {
    DeepMap map = three_pixels();
    if (!has_samples) {
      map.counts.assign(6, 0);
      map.samples.clear();
    }
    const std::string file = folder_ / "deep.exr";
    write_deep_map(map, file, GetParam());
    const DeepMap found = read_deep_map(file);
    EXPECT_EQ(found.description.width, 3U);
    EXPECT_EQ(found.description.height, 2U);
    EXPECT_EQ(found.description.texts.at("fathom.camera"), "a camera");
    EXPECT_EQ(found.counts, map.counts);
    ASSERT_EQ(found.samples.size(), map.samples.size());
    if (map.samples.empty()) continue;
    EXPECT_EQ(std::memcmp(found.samples.data(), map.samples.data(),
                          map.samples.size() * sizeof(DeepSample)),
              0);
  }
}

std::vector<char> bytes_of_file(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// What reading a file of these bytes reports, without its name; empty: it was read.
std::string refusal_of(const std::string& file, const std::vector<char>& bytes) {
  std::ofstream(file, std::ios::binary)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  try {
    read_deep_map(file);
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_EQ(text.rfind(file + ": ", 0), 0U) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    return text.substr(file.size() + 2);
  }
  return "";
}

TEST_P(DeepMaps, ThatAreTruncatedAreRefused) {
  const std::string file = folder_ / "deep.exr";
  write_deep_map(three_pixels(), file, GetParam());
  std::vector<char> bytes = bytes_of_file(file);
  while (!bytes.empty()) {
    bytes.resize(bytes.size() - std::min<std::size_t>(bytes.size(), 7));
    EXPECT_NE(refusal_of(file, bytes), "") << bytes.size();
  }
}

TEST_P(DeepMaps, ThatAreChangedAnywhereAreReadOrRefused) {
  const std::string file = folder_ / "deep.exr";
  write_deep_map(three_pixels(), file, GetParam());
  const std::vector<char> bytes = bytes_of_file(file);
  for (std::size_t k = 0; k < bytes.size(); k += 5) {
    for (const int change : {1, 0xFF}) {
      std::vector<char> changed = bytes;
      changed[k] = static_cast<char>(changed[k] ^ change);
      refusal_of(file, changed);
    }
  }
}

TEST_P(DeepMaps, ThatClaimMoreThanTheyHoldAreRefused) {
  const std::string file = folder_ / "deep.exr";
  write_deep_map(three_pixels(), file, GetParam());
  std::vector<char> bytes = bytes_of_file(file);
  const std::string window("dataWindow\0box2i", 16);
  const auto at = std::search(bytes.begin(), bytes.end(), window.begin(), window.end());
  ASSERT_NE(at, bytes.end());
  at[16 + 1 + 4 + 10] = 0x7F;  // the third byte of xMax
  EXPECT_NE(refusal_of(file, bytes).find("its header claims"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Compressions, DeepMaps,
                         ::testing::Values(Compression::none, Compression::rle, Compression::zips));

TEST_P(DeepMaps, OfOtherKindsAreRefused) {
  const std::string file = folder_ / "flat.exr";
  DepthMap flat;
  flat.width = flat.height = 1;
  flat.channels.push_back({"Z", Samples<float>(1, 2.5F)});
  write_map(flat, file, MapFormat::exr);
  EXPECT_EQ(refusal_of(file, bytes_of_file(file)),
            "not a deep map: expected an EXR of deep scan lines in one part");
  EXPECT_EQ(refusal_of(file, {'P', 'f'}), "expected a deep map (EXR)");
  EXPECT_THROW(read_deep_map(folder_ / "missing.exr"), InputError);
}

TEST(DeepMapFaults, AFileOfSeveralPartsIsNoDeepMap) {
  const auto begin = [](std::uint8_t flags) {
    return std::vector<std::byte>{std::byte{0x76}, std::byte{0x2F}, std::byte{0x31},
                                  std::byte{0x01}, std::byte{2},    std::byte{flags},
                                  std::byte{0},    std::byte{0}};
  };
  EXPECT_TRUE(is_deep_map(begin(0x08)));
  EXPECT_FALSE(is_deep_map(begin(0x18)));  // any part may be the deep one
  EXPECT_FALSE(is_deep_map(begin(0x10)));
  EXPECT_FALSE(is_deep_map(begin(0)));
}

TEST(DeepMapFaults, OtherCompressionsAndPlaces) {
  EXPECT_THROW(write_deep_map(three_pixels(), "/tmp/never.exr", Compression::piz), UsageError);
  EXPECT_THROW(write_deep_map(three_pixels(), "/nonexistent/deep.exr"), OutputError);
}

}  // namespace
}  // namespace fathom
