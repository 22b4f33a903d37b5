#include <ImfChannelList.h>
#include <ImfDeepFrameBuffer.h>
#include <ImfDeepScanLineOutputFile.h>
#include <ImfFrameBuffer.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <ImfTiledOutputFile.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <cstring>

#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/image/files/map_codecs.h"
#include "fathom/image/files/openexr.h"
#include "fathom/image/rgb_image.h"
#include "tests/image/map_samples.h"
#include "tests/places.h"

namespace fathom {
namespace {

using namespace image;
using namespace files;
using ::testing::HasSubstr;
using namespace fathom::checks;

/// The message of the InputError that reading ends in.
std::string refusal_of(ByteView bytes) {
  try {
    decode_map(bytes, "map");
  } catch (const InputError& failure) {
    const std::string message = failure.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_EQ(message.rfind("map: ", 0), 0u) << message;
    return message;
  }
  return "it was read";
}

Bytes small_exr(Compression compression) {
  return encode_exr(full_map(6, 20), compression, 1, "a.exr");
}

std::vector<Bytes> one_of_each() {
  DepthMap codes = map_of(5, 4, "Z", random_bits<std::uint16_t>(20, 1));
  codes.png_scale = 1000;
  const DepthMap floats = map_of(5, 4, "Z", random_bits<float>(20, 2));
  const DepthMap depths = map_of(5, 4, "Z", Samples<float>(20, 2.5f));
  return {small_exr(Compression::none),
          small_exr(Compression::rle),
          small_exr(Compression::zip),
          small_exr(Compression::piz),
          encode_png(codes, codes.channels[0], "a.png"),
          encode_pfm(floats, floats.channels[0], "a.pfm"),
          encode_npy(floats, {&floats.channels[0]}, "a.npy"),
          encode_npz(full_map(6, 20), "a.npz"),
          encode_colmap(depths, {&depths.channels[0]}, "a.bin")};
}

TEST(BadFiles, AreRefusedWhereverTheyAreCutOff) {
  for (const Bytes& bytes : one_of_each()) {
    ASSERT_NO_THROW(decode_map(bytes, "map"));
    for (std::size_t length = 0; length < bytes.size(); ++length)
      ASSERT_NE(refusal_of(ByteView(bytes).first(length)), "it was read")
          << length << " of " << bytes.size();
  }
}

TEST(BadFiles, WithAByteChangedAreReadOrRefusedButNeverWorse) {
  std::mt19937_64 random(seed);
  for (Bytes bytes : one_of_each())
    for (int trial = 0; trial < 1000; ++trial) {
      const std::size_t k = random() % bytes.size();
      const std::byte before = bytes[k];
      bytes[k] = static_cast<std::byte>(random());
      refusal_of(bytes);
      bytes[k] = before;
    }
}

/// Where an attribute's value stands in an EXR file.
std::size_t attribute_at(const Bytes& bytes, const std::string& name, const std::string& type) {
  const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::string key = name + '\0' + type + '\0';
  return text.find(key) + key.size() + 4;
}

void put_int(Bytes& bytes, std::size_t at, std::int32_t value) {
  std::memcpy(&bytes[at], &value, sizeof value);
}

/// Limits the address space, so that an allocation by claim would fail loudly.
class LittleMemory {
 public:
  LittleMemory() {
    getrlimit(RLIMIT_AS, &before_);
    rlimit limit = before_;
    limit.rlim_cur = std::size_t{4} << 30;
    setrlimit(RLIMIT_AS, &limit);
  }
  ~LittleMemory() { setrlimit(RLIMIT_AS, &before_); }
  LittleMemory(const LittleMemory&) = delete;
  LittleMemory& operator=(const LittleMemory&) = delete;

 private:
  rlimit before_{};
};

#if defined(FATHOM_SANITIZED)
using MemoryLimit = int;  // sanitizers reserve terabytes of address space
#else
using MemoryLimit = LittleMemory;
#endif

TEST(BadFiles, ExrOfAClaimedSizeIsRefusedBeforeAllocating) {
  [[maybe_unused]] const MemoryLimit limit{};
  for (const Compression compression : {Compression::none, Compression::zip, Compression::piz}) {
    Bytes bytes = small_exr(compression);
    for (const char* window : {"dataWindow", "displayWindow"}) {
      const std::size_t at = attribute_at(bytes, window, "box2i");
      put_int(bytes, at + 8, 0x3FFFFFF0);
      put_int(bytes, at + 12, 0x3FFFFFF0);
    }
    EXPECT_THAT(refusal_of(bytes), HasSubstr("its header claims 1073741809×1073741809 pixels"));
    // The whole range of 32 bits.
    const std::size_t at = attribute_at(bytes, "dataWindow", "box2i");
    put_int(bytes, at, std::numeric_limits<std::int32_t>::min());
    put_int(bytes, at + 8, std::numeric_limits<std::int32_t>::max());
    EXPECT_THAT(refusal_of(bytes), HasSubstr("its header claims 4294967296×1073741809 pixels"));
    put_int(bytes, at + 8, std::numeric_limits<std::int32_t>::min() + 5);
    EXPECT_THAT(refusal_of(bytes), HasSubstr("its header claims 6×1073741809 pixels"));
  }
}

/// One row is less than a chunk, which is what OpenEXR allocates.
TEST(BadFiles, ExrOfClaimedChunksIsRefusedBeforeAllocating) {
  [[maybe_unused]] const MemoryLimit limit{};
  constexpr std::byte dwab{9};  // 256 lines in a chunk
  Bytes bytes = small_exr(Compression::piz);
  bytes[attribute_at(bytes, "compression", "compression")] = dwab;
  const auto width = static_cast<std::int32_t>(1000 * bytes.size());
  for (const char* window : {"dataWindow", "displayWindow"}) {
    const std::size_t at = attribute_at(bytes, window, "box2i");
    put_int(bytes, at + 8, width - 1);
    put_int(bytes, at + 12, 0);
  }
  EXPECT_THAT(refusal_of(bytes),
              HasSubstr("its header claims " + std::to_string(width) + "×1 pixels"));
}

TEST(BadFiles, PngPfmAndNpyOfAClaimedSizeAreRefusedBeforeAllocating) {
  [[maybe_unused]] const MemoryLimit limit{};
  DepthMap codes = map_of(5, 4, "Z", random_bits<std::uint16_t>(20, 1));
  // libpng checks the header's sum, so a header of that size is written by its own hand:
  // 2000000000×2000000000, 16 bits, grey, with its CRC.
  Bytes png = encode_png(codes, codes.channels[0], "a.png");
  const unsigned char header[] = {0x77, 0x35, 0x94, 0x00, 0x77, 0x35, 0x94, 0x00, 16, 0, 0, 0, 0};
  std::memcpy(&png[16], header, sizeof header);
  std::uint32_t crc = 0xFFFFFFFF;
  for (std::size_t k = 12; k < 29; ++k) {
    crc ^= static_cast<std::uint32_t>(png[k]);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xEDB88320u : 0u);
  }
  crc = ~crc;
  for (std::size_t k = 0; k < 4; ++k) png[29 + k] = static_cast<std::byte>(crc >> (24 - 8 * k));
  EXPECT_THAT(refusal_of(png), HasSubstr("claims 2000000000×2000000000 pixels"));

  Bytes pfm, npy;
  append(pfm, "Pf\n4294967295 4294967295\n-1\nabcd");
  EXPECT_THAT(refusal_of(pfm), HasSubstr("expected 4294967295×4294967295 pixels"));
  append(npy, std::string("\x93NUMPY\1\0\x48\0", 10) +
                  "{'descr': '<f8', 'fortran_order': False, 'shape': (4000000000, 4000000000)}");
  npy[8] = static_cast<std::byte>(npy.size() - 10);
  EXPECT_THAT(refusal_of(npy), HasSubstr("expected 4000000000×4000000000 values"));
}

/// A text of 1.4 GB claimed in a file of 200 bytes; libpng alone would allocate and clear it.
TEST(BadFiles, PngTextOfAClaimedSizeIsNotAllocated) {
  DepthMap codes = map_of(5, 4, "Z", random_bits<std::uint16_t>(20, 1));
  codes.object_names = {"é"};
  Bytes png = encode_png(codes, codes.channels[0], "a.png");
  const std::string text(reinterpret_cast<const char*>(png.data()), png.size());
  const std::size_t chunk = text.find("iTXt");
  ASSERT_NE(chunk, std::string::npos);
  png[chunk - 4] = std::byte{0x54};
  refusal_of(png);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  EXPECT_LT(usage.ru_maxrss, 800000) << "kilobytes";
}

TEST(BadFiles, OfOtherKindsAreNamed) {
  const auto refusal = [](const std::string& text) {
    Bytes bytes;
    append(bytes, text);
    return refusal_of(bytes);
  };
  EXPECT_EQ(refusal(""), "map: not a map: expected an OpenEXR, PFM, PNG, NPY, NPZ or COLMAP file");
  EXPECT_EQ(refusal("P5\n3 3\n255\n"),
            "map: not a map: expected an OpenEXR, PFM, PNG, NPY, NPZ or COLMAP file");
  EXPECT_THAT(refusal("Pf\n0 3\n-1\n"), HasSubstr("a width and height of at least 1"));
  EXPECT_THAT(refusal("Pf\n-3 3\n-1\n"), HasSubstr("a width from 1"));
  EXPECT_THAT(refusal("Pf\n1 1\nnan\nabcd"), HasSubstr("a finite scale"));
  EXPECT_THAT(refusal("Pf\n1 1\n0\nabcd"), HasSubstr("a finite scale"));
  EXPECT_THAT(refusal("Pf\n1 1\n-1\nabcde"), HasSubstr("pixels of 4 bytes, found 5 bytes"));
  EXPECT_THAT(refusal("Pf\n1 1\n-1\na"), ::testing::EndsWith("pixels of 4 bytes, found 1 byte"));
}

DepthMap decode(Bytes bytes) {
  return decode_map(bytes, "map");
}

TEST(OtherExr, TiledHalfIsWidened) {
  std::vector<half> values(70 * 50);
  for (std::size_t k = 0; k < values.size(); ++k)
    values[k].setBits(static_cast<std::uint16_t>(k * 17));
  Imf::Header header(70, 50);
  header.setTileDescription(Imf::TileDescription(16, 16));
  header.channels().insert("ViewLayer.Depth.Z", Imf::Channel(Imf::HALF));
  ByteOutput stream("a.exr");
  {
    Imf::TiledOutputFile file(stream, header);
    Imf::FrameBuffer pixels;
    pixels.insert("ViewLayer.Depth.Z",
                  Imf::Slice(Imf::HALF, reinterpret_cast<char*>(values.data()), 2, 140));
    file.setFrameBuffer(pixels);
    file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
  }
  const DepthMap map = decode(stream.take());
  const auto* read = map.values<float>("ViewLayer.Depth.Z");
  ASSERT_NE(read, nullptr);
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (values[k].isNan())
      EXPECT_TRUE(std::isnan((*read)[k]));
    else
      EXPECT_EQ((*read)[k], static_cast<float>(values[k])) << k;
  }
}

TEST(OtherExr, DeepIsRefused) {
  Imf::Header header(2, 1);
  header.setType(Imf::DEEPSCANLINE);
  header.compression() = Imf::ZIPS_COMPRESSION;
  header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
  ByteOutput stream("a.exr");
  {
    Imf::DeepScanLineOutputFile file(stream, header);
    std::vector<unsigned> counts{0, 0};
    std::vector<float*> samples{nullptr, nullptr};
    Imf::DeepFrameBuffer pixels;
    pixels.insertSampleCountSlice(
        Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts.data()), 4, 8));
    pixels.insert("Z", Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(samples.data()),
                                      sizeof(float*), 2 * sizeof(float*), sizeof(float)));
    file.setFrameBuffer(pixels);
    file.writePixels(1);
  }
  EXPECT_EQ(refusal_of(stream.take()),
            "map: is a deep map, expected scan lines or tiles; 'fathom view', 'fathom preview' and "
            "'fathom info' take it, as do DeepMap.read in Python and read_deep_map in C++");
}

TEST(OtherExr, CroppedAndSubsampledAreRefused) {
  const auto written = [](const Imath::Box2i& data, int sampling) {
    Imf::Header header(Imath::Box2i({0, 0}, {7, 7}), data);
    header.channels().insert("Z", Imf::Channel(Imf::FLOAT, sampling, sampling));
    std::vector<float> values(64);
    ByteOutput stream("a.exr");
    {
      Imf::OutputFile file(stream, header);
      Imf::FrameBuffer pixels;
      pixels.insert("Z", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), 4, 32,
                                    sampling, sampling));
      file.setFrameBuffer(pixels);
      file.writePixels(data.max.y - data.min.y + 1);
    }
    return stream.take();
  };
  EXPECT_EQ(refusal_of(written({{0, 0}, {7, 7}}, 1)), "it was read");
  EXPECT_THAT(refusal_of(written({{1, 2}, {5, 6}}, 1)),
              HasSubstr("the data window (1, 2)–(5, 6) is not the display window (0, 0)–(7, 7)"));
  EXPECT_THAT(refusal_of(written({{0, 0}, {7, 7}}, 2)),
              HasSubstr("subsampled channels are not read"));
}

TEST(Png, PicturesAreNoMaps) {
  const Folder folder;
  write_png(RgbImage(3, 3, {1, 2, 3}), folder / "a.png");
  EXPECT_THAT(refusal_of(InputFile(folder / "a.png").bytes()),
              HasSubstr("a picture, not a depth map"));
}

TEST(Outputs, OfAFullDiskAreErrors) {
  const DepthMap map = full_map(200, 200);
  for (const MapFormat format : {MapFormat::exr, MapFormat::pfm, MapFormat::npy}) {
    WriteOptions options;
    options.channel = "Z";
    try {
      write_map(map, "/dev/full", format, options);
      FAIL() << "a full disk went unnoticed";
    } catch (const OutputError& failure) {
      EXPECT_STREQ(failure.what(), "/dev/full: No space left on device");
    }
  }
  EXPECT_THROW(write_png(RgbImage(300, 300), "/dev/full"), OutputError);
}

/// As a disk that fills up on the way does: the file system takes 20,000 bytes of the file, then
/// no more.
TEST(Outputs, CutShortOnTheWayAreErrors) {
  const Folder folder;
  signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  rlimit limit = before;
  limit.rlim_cur = 20000;
  setrlimit(RLIMIT_FSIZE, &limit);
  const DepthMap map = full_map(200, 200);
  EXPECT_THROW(write_map(map, folder / "a.exr", MapFormat::exr), OutputError);
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_NO_THROW(write_map(map, folder / "a.exr", MapFormat::exr));
}

TEST(Paths, ThatCannotBeUsedAreNamed) {
  const Folder folder;
  const auto reading = [](const std::filesystem::path& path) -> std::string {
    try {
      read_map(path);
    } catch (const InputError& failure) {
      return failure.what();
    }
    return "it was read";
  };
  EXPECT_EQ(reading("/nowhere/a.exr"),
            "/nowhere/a.exr: cannot be opened: No such file or directory");
  EXPECT_EQ(reading("/tmp"), "/tmp: is a directory, expected a file");
  try {
    write_map(full_map(1, 1), "/nowhere/a.exr", MapFormat::exr);
    FAIL();
  } catch (const OutputError& failure) {
    EXPECT_STREQ(failure.what(), "/nowhere/a.exr: No such file or directory");
  }
}

// OpenEXR 3.1 takes four bytes too many for an idManifest; the attribute behind it had a short name
// here, and a length was read where there is none: an allocation of 1.6 GB.
TEST(BadFiles, AnIdManifestDoesNotMakeTheReaderLoseStep) {
  try {
    read_map(test::source_dir() / "tests/fuzz/corpus/map/lost_step.exr");
    FAIL() << "expected an InputError";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("Unexpected data block"));
  }
}

}  // namespace
}  // namespace fathom
