// Deep maps as OpenEXR reads them back.
#include "fathom/image/deep_map.h"

#include <ImfDeepFrameBuffer.h>
#include <ImfDeepImageStateAttribute.h>
#include <ImfDeepScanLineInputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <gtest/gtest.h>

#include <cstdlib>

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

INSTANTIATE_TEST_SUITE_P(Compressions, DeepMaps,
                         ::testing::Values(Compression::none, Compression::rle, Compression::zips));

TEST(DeepMapFaults, OtherCompressionsAndPlaces) {
  EXPECT_THROW(write_deep_map(three_pixels(), "/tmp/never.exr", Compression::piz), UsageError);
  EXPECT_THROW(write_deep_map(three_pixels(), "/nonexistent/deep.exr"), OutputError);
}

}  // namespace
}  // namespace fathom
