#include "fathom/image/map_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fathom/failures/errors.h"
#include "fathom/image/files/map_codecs.h"
#include "fathom/numeric/rounding.h"
#include "tests/image/map_samples.h"

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

template <class Failure, class Action>
std::string message_of(Action action) {
  try {
    action();
  } catch (const Failure& failure) {
    return failure.what();
  }
  return "nothing was thrown";
}

const std::vector<Compression> all_compressions{
    Compression::none, Compression::rle, Compression::zips, Compression::zip, Compression::piz};

TEST(Exr, KeepsEveryBitOfEveryChannelInEveryCompression) {
  for (const auto& [width, height] : {std::pair{1u, 1u}, {3u, 2u}, {67u, 41u}, {5u, 300u}}) {
    const DepthMap map = full_map(width, height);
    for (const Compression compression : all_compressions) {
      const DepthMap back = decode_map(encode_exr(map, compression, 0, "a.exr"), "a.exr");
      ASSERT_EQ(back.width, width);
      ASSERT_EQ(back.height, height);
      ASSERT_EQ(back.channels.size(), map.channels.size());
      for (const ImageChannel& channel : map.channels) {
        const ImageChannel* other = back.find(channel.name);
        ASSERT_NE(other, nullptr) << channel.name;
        EXPECT_EQ(other->values.index(), channel.values.index());
        EXPECT_EQ(bits_of(*other), bits_of(channel))
            << channel.name << " compression " << static_cast<int>(compression);
      }
    }
  }
}

/// Some chunks cannot be compressed and are in the file as they are.
TEST(Exr, HasTheSameBytesForAnyNumberOfThreads) {
  DepthMap map = full_map(67, 41);
  std::mt19937 random(3);
  auto& values = std::get<Samples<float>>(map.channels.front().values);
  for (float& value : values) value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
  for (const Compression compression : all_compressions) {
    const Bytes one = encode_exr(map, compression, 1, "a.exr");
    EXPECT_EQ(encode_exr(map, compression, 2, "a.exr"), one);
    EXPECT_EQ(encode_exr(map, compression, 7, "a.exr"), one);
    EXPECT_EQ(bits_of(*decode_map(one, "a.exr").find(map.channels.front().name)),
              bits_of(map.channels.front()));
  }
}

TEST(Exr, KeepsWhatTheMapCarries) {
  const DepthMap map = full_map(4, 3);
  const DepthMap back = decode_map(encode_exr(map, Compression::zip, 1, "a.exr"), "a.exr");
  EXPECT_EQ(back.object_names, map.object_names);
  EXPECT_EQ(back.tables, map.tables);
  EXPECT_EQ(back.numbers, map.numbers);
  EXPECT_EQ(back.texts.at("fathom.camera"), map.texts.at("fathom.camera"));
  EXPECT_EQ(back.texts.at("fathom.engine"), "reference");
  EXPECT_THAT(back.texts.at("software"), HasSubstr("Fathom"));
}

TEST(Exr, SaysOfACameraWhatOtherProgramsKnow) {
  DepthMap map = map_of(4, 2, "Z", std::vector<float>(8));
  map.camera = Camera{.width = 4, .height = 2, .projection = {.fx = 2, .fy = 3, .cx = 1, .cy = 1}};
  const Bytes bytes = encode_exr(map, Compression::zip, 1, "a.exr");
  const DepthMap back = decode_map(bytes, "a.exr");
  EXPECT_FALSE(back.camera);
  EXPECT_EQ(back.texts.at("fathom.camera"), texts_of(map).at("fathom.camera"));
  EXPECT_EQ(camera_of(back, "a.exr")->projection.fy, 3);
  const std::map<std::string, std::vector<double>> expected{
      {"worldToCamera", {1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}},
      {"worldToNDC", {0.5, 0, 0, 0, 0, 1.5, 0, 0, 0.25, 0.5, 1, 1, 0, 0, 0, 0}},
      {"pixelAspectRatio", {1.5}},
      {"screenWindowCenter", {0.5, 0}},
      {"screenWindowWidth", {2}}};
  EXPECT_EQ(back.numbers, expected);
  EXPECT_EQ(encode_exr(back, Compression::zip, 1, "a.exr"), bytes);
}

TEST(Exr, BytesDoNotDependOnThreadsOrTime) {
  const DepthMap map = full_map(200, 150);
  const Bytes once = encode_exr(map, Compression::zip, 1, "a.exr");
  EXPECT_EQ(once, encode_exr(map, Compression::zip, 7, "b.exr"));
  EXPECT_EQ(once, encode_exr(map, Compression::zip, 0, "c.exr"));
}

TEST(Exr, LeavesOutNumbersThatItsHeaderCannotHold) {
  DepthMap map = full_map(2, 2);
  map.numbers["worldToCamera"][3] = 1e150;
  map.numbers["worldToNDC"].pop_back();
  map.numbers["screenWindowWidth"] = {-1};
  map.numbers["pixelAspectRatio"] = {-2};
  const DepthMap back = decode_map(encode_exr(map, Compression::zip, 1, "a.exr"), "a.exr");
  EXPECT_EQ(
      back.numbers,
      (std::map<std::string, std::vector<double>>{
          {"screenWindowCenter", {0, 0}}, {"screenWindowWidth", {1}}, {"pixelAspectRatio", {1}}}));
}

TEST(Exr, RefusesBinary64AndCodes) {
  const auto write = [](const DepthMap& map) {
    return message_of<OutputError>([&] { encode_exr(map, Compression::zip, 1, "a.exr"); });
  };
  EXPECT_THAT(write(map_of(1, 1, "Z", std::vector<double>{1})), HasSubstr("a.exr: EXR holds"));
  EXPECT_THAT(write(map_of(1, 1, "Z", std::vector<std::uint16_t>{1})),
              HasSubstr("stored otherwise"));
  DepthMap twice = map_of(1, 1, "Z", std::vector<float>{1});
  twice.channels.push_back(twice.channels.front());
  EXPECT_THAT(write(twice), HasSubstr("two channels"));
}

TEST(Pfm, KeepsEveryBit) {
  const DepthMap map = map_of(17, 9, "Z", random_bits<float>(17 * 9, 5));
  const DepthMap back = decode_map(encode_pfm(map, map.channels[0], "a.pfm"), "a.pfm");
  EXPECT_EQ(back.width, 17u);
  EXPECT_EQ(back.height, 9u);
  EXPECT_EQ(bits_of(back.channels.at(0)), bits_of(map.channels[0]));
}

TEST(Pfm, StandsBottomRowFirstAndLittleEndian) {
  const DepthMap map = map_of(1, 2, "Z", std::vector<float>{1.0f, 2.0f});
  EXPECT_EQ(encode_pfm(map, map.channels[0], "a.pfm"),
            bytes_of(std::string("Pf\n1 2\n-1.0\n\0\0\0\x40\0\0\x80\x3f", 20)));
}

TEST(Pfm, IsReadInBothByteOrdersAndWithThreeChannels) {
  const Bytes big = bytes_of(std::string("Pf 1 2 2.5\n\x40\0\0\0\x3f\x80\0\0", 19));
  const DepthMap map = decode_map(big, "a.pfm");
  EXPECT_EQ(*map.values<float>("Z"), (std::vector<float>{1.0f, 2.0f}));
  EXPECT_EQ(map.texts.at("pfm.scale"), "2.5");
  const Bytes three = bytes_of(std::string("PF\n1 1\n1\n\x3f\x80\0\0\x40\0\0\0\x40\x40\0\0", 21));
  const DepthMap colours = decode_map(three, "a.pfm");
  EXPECT_EQ(*colours.values<float>("R"), std::vector<float>{1.0f});
  EXPECT_EQ(*colours.values<float>("G"), std::vector<float>{2.0f});
  EXPECT_EQ(*colours.values<float>("B"), std::vector<float>{3.0f});
}

TEST(Npy, KeepsEveryBitOfEveryType) {
  const auto check = [](const decltype(ImageChannel::values)& values) {
    const DepthMap map = map_of(13, 7, "Z", values);
    const DepthMap back = decode_map(encode_npy(map, {&map.channels[0]}, "a.npy"), "a.npy");
    EXPECT_EQ(back.width, 13u);
    EXPECT_EQ(back.height, 7u);
    EXPECT_EQ(back.channels.at(0).values.index(), values.index());
    EXPECT_EQ(bits_of(back.channels.at(0)), bits_of(map.channels[0]));
  };
  check(random_bits<float>(91, 6));
  check(random_bits<double>(91, 7));
  check(random_bits<std::uint16_t>(91, 8));
  check(random_bits<std::uint32_t>(91, 9));
}

TEST(Npy, HeaderIsThatOfTheFormat) {
  const DepthMap map = map_of(640, 480, "Z", std::vector<float>(640 * 480));
  const Bytes bytes = encode_npy(map, {&map.channels[0]}, "a.npy");
  const std::string header(reinterpret_cast<const char*>(bytes.data()), 128);
  EXPECT_EQ(header.substr(0, 10), std::string("\x93NUMPY\x01\x00\x76\x00", 10));
  EXPECT_EQ(header.substr(10, 63),
            "{'descr': '<f4', 'fortran_order': False, 'shape': (480, 640), }");
  EXPECT_EQ(header.back(), '\n');
  EXPECT_EQ(bytes.size(), 128u + 4 * 640 * 480);
}

Bytes npy(const std::string& dictionary, const std::string& data) {
  std::string text("\x93NUMPY\x01\x00", 8);
  text += static_cast<char>(dictionary.size());
  text += '\0';
  return bytes_of(text + dictionary + data);
}

TEST(Npy, IsReadInFortranOrderAndBigEndian) {
  const DepthMap map = decode_map(npy("{'descr': '>u2', 'fortran_order': True, 'shape': (2, 3), }",
                                      std::string("\0\1\0\2\0\3\0\4\1\0\0\6", 12)),
                                  "a.npy");
  EXPECT_EQ(map.width, 3u);
  EXPECT_EQ(*map.values<std::uint16_t>("Z"), (std::vector<std::uint16_t>{1, 3, 256, 2, 4, 6}));
  const DepthMap bytes = decode_map(
      npy("{\"shape\": (1, 2,), 'fortran_order':False,'descr':'|u1'}", "\x07\xff"), "a.npy");
  EXPECT_EQ(*bytes.values<std::uint16_t>("Z"), (std::vector<std::uint16_t>{7, 255}));
  const DepthMap halves =
      decode_map(npy("{'descr': '<f2', 'fortran_order': False, 'shape': (1, 2)}",
                     std::string("\x00\x3e\x01\x80", 4)),
                 "a.npy");
  EXPECT_EQ(*halves.values<float>("Z"), (std::vector<float>{1.5f, -0x1p-24f}));
}

TEST(Npy, WidensEveryBinary16) {
  // By the definition of the format: (−1)^s · 2^(e − 15) · 1.f, subnormals 2^−14 · 0.f.
  for (std::uint32_t bits = 0; bits < 65536; ++bits) {
    const float wide = widen_binary16(static_cast<std::uint16_t>(bits));
    const int e = (bits >> 10) & 31, f = bits & 1023;
    EXPECT_EQ(std::signbit(wide), bits >= 0x8000);
    if (e == 31 && f != 0) {
      EXPECT_TRUE(std::isnan(wide));
    } else if (e == 31) {
      EXPECT_TRUE(std::isinf(wide));
    } else {
      const double magnitude =
          e == 0 ? f / 1024.0 * std::exp2(-14) : (1 + f / 1024.0) * std::exp2(e - 15);
      EXPECT_EQ(std::abs(wide), magnitude) << bits;
    }
  }
}

TEST(Png, KeepsEveryCodeScaleAndText) {
  DepthMap map = map_of(31, 11, "distance", random_bits<std::uint16_t>(31 * 11, 10));
  map.png_scale = 1000.1;
  map.texts = {{"fathom.camera", "{\"a\": \"é\"}"}, {"fathom.engine", "reference"}};
  map.object_names = {"spot", "é"};
  map.tables = {{"material", {"oak", std::string("a\0b", 3), "é"}}};
  const DepthMap back = decode_map(encode_png(map, map.channels[0], "a.png"), "a.png");
  ASSERT_NE(back.values<std::uint16_t>("distance"), nullptr);
  EXPECT_EQ(bits_of(back.channels[0]), bits_of(map.channels[0]));
  EXPECT_EQ(back.png_scale, map.png_scale);
  EXPECT_EQ(back.texts.at("fathom.camera"), map.texts.at("fathom.camera"));
  EXPECT_EQ(back.texts.at("fathom.engine"), "reference");
  EXPECT_EQ(back.object_names, map.object_names);
  EXPECT_EQ(back.tables, map.tables);
}

TEST(Png, HoldsIdentifiersThatFit) {
  DepthMap map = map_of(2, 2, "face", std::vector<std::uint32_t>{0, 65534, no_surface, 7});
  const DepthMap back = decode_map(encode_png(map, map.channels[0], "a.png"), "a.png");
  ASSERT_NE(back.values<std::uint32_t>("face"), nullptr);
  EXPECT_EQ(bits_of(back.channels[0]), bits_of(map.channels[0]));
  std::get<Samples<std::uint32_t>>(map.channels[0].values)[3] = 65535;
  EXPECT_EQ(message_of<OutputError>([&] { encode_png(map, map.channels[0], "a.png"); }),
            "a.png: identifier 65535 does not fit a 16-bit PNG: expected at most 65534");
}

/// 65534 says that a visible surface has no material, and so no material has this number.
TEST(Png, HoldsSegmentsThatFit) {
  DepthMap map =
      map_of(2, 2, "label", std::vector<std::uint32_t>{0, 65533, no_segment, no_surface});
  const DepthMap back = decode_map(encode_png(map, map.channels[0], "a.png"), "a.png");
  ASSERT_NE(back.values<std::uint32_t>("label"), nullptr);
  EXPECT_EQ(bits_of(back.channels[0]), bits_of(map.channels[0]));
  std::get<Samples<std::uint32_t>>(map.channels[0].values)[0] = 65534;
  EXPECT_EQ(message_of<OutputError>([&] { encode_png(map, map.channels[0], "a.png"); }),
            "a.png: identifier 65534 does not fit a 16-bit PNG: expected at most 65533");
}

TEST(WriteMap, ChoosesTheChannel) {
  const Folder folder;
  const DepthMap map = full_map(3, 3);
  EXPECT_THAT(
      message_of<UsageError>([&] { write_map(map, folder / "a.pfm", MapFormat::pfm); }),
      HasSubstr("holds one channel, and the map has Z, N.X, object, id; name the one to write"));
  WriteOptions options;
  options.channel = "nothing";
  EXPECT_THAT(
      message_of<UsageError>([&] { write_map(map, folder / "a.pfm", MapFormat::pfm, options); }),
      HasSubstr("no channel 'nothing'"));
  options.channel = "id";
  EXPECT_THAT(
      message_of<OutputError>([&] { write_map(map, folder / "a.pfm", MapFormat::pfm, options); }),
      HasSubstr("PFM holds binary32"));
  options.channel = "N.X";
  write_map(map, folder / "a.pfm", MapFormat::pfm, options);
  EXPECT_EQ(bits_of(read_map(folder / "a.pfm").channels.at(0)), bits_of(*map.find("N.X")));
}

TEST(MapFormats, AreNamedBySuffixAndToldByContent) {
  EXPECT_EQ(map_format_of("a/b.EXR"), MapFormat::exr);
  EXPECT_EQ(map_format_of("b.pfm"), MapFormat::pfm);
  EXPECT_EQ(map_format_of("b.Png"), MapFormat::png);
  EXPECT_EQ(map_format_of("b.npy"), MapFormat::npy);
  EXPECT_EQ(map_format_of("image.jpg.geometric.bin"), MapFormat::colmap);
  EXPECT_EQ(map_format_of("b.tif"), MapFormat::tiff);
  EXPECT_EQ(map_format_of("b.TIFF"), MapFormat::tiff);
  EXPECT_EQ(map_format_of("b.exr.jpg"), std::nullopt);
  EXPECT_EQ(map_format_of("exr"), std::nullopt);
  const Folder folder;
  const DepthMap map = full_map(3, 3);
  write_map(map, folder / "lies.png", MapFormat::exr);
  EXPECT_EQ(read_map(folder / "lies.png").channels.size(), 4u);
}

}  // namespace
}  // namespace fathom
