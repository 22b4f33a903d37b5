#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "fathom/failures/errors.h"
#include "fathom/files/byte_order.h"
#include "fathom/image/files/map_codecs.h"
#include "fathom/image/files/npy_array.h"
#include "fathom/image/files/zip_archive.h"
#include "tests/image/map_samples.h"
#include "tests/image/run_program.h"

/// NPZ, and NPY of pixels with several parts: our own reader and NumPy read them, and ours reads
/// NumPy's.
namespace fathom {
namespace {

using namespace image;
using namespace files;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using namespace fathom::checks;

Outcome python_in(const Folder& folder, const std::string& script) {
  std::ofstream(folder / "script.py") << "import json, numpy as np\n" << script;
  return run("cd '" + (folder / "").string() + "' && /usr/bin/python3 script.py");
}

/// Every type, a whole of three parts, one of two, and parts without a whole.
DepthMap rich_map() {
  DepthMap map = full_map(5, 3);  // Z, N.X, object, id
  map.channels.push_back({"distance", random_bits<double>(15, 5)});
  map.channels.push_back({"N.Y", random_bits<float>(15, 6)});
  map.channels.push_back({"N.Z", random_bits<float>(15, 7)});
  map.channels.push_back({"bary.U", random_bits<float>(15, 8)});
  map.channels.push_back({"bary.V", random_bits<float>(15, 9)});
  map.channels.push_back({"P.X", random_bits<float>(15, 10)});
  return map;
}

TEST(Npz, KeepsEveryBitAndText) {
  const DepthMap map = rich_map();
  const DepthMap back = decode_map(encode_npz(map, "a.npz"), "a.npz");
  EXPECT_EQ(back.width, 5u);
  EXPECT_EQ(back.height, 3u);
  ASSERT_EQ(back.channels.size(), map.channels.size());
  for (const ImageChannel& channel : map.channels) {
    ASSERT_NE(back.find(channel.name), nullptr) << channel.name;
    EXPECT_EQ(back.find(channel.name)->values.index(), channel.values.index());
    EXPECT_EQ(bits_of(*back.find(channel.name)), bits_of(channel)) << channel.name;
  }
  EXPECT_EQ(back.object_names, map.object_names);
  EXPECT_EQ(back.tables, map.tables);
  for (const auto& [name, text] : map.texts) EXPECT_EQ(back.texts.at(name), text);
}

TEST(Npz, BeyondFourGibibytesIsRefusedBeforeAnyWork) {
  EXPECT_NO_THROW(require_size(MapFormat::npz, 32768, 32767, "a.npz"));
  EXPECT_THROW(require_size(MapFormat::npz, 32768, 32768, "a.npz"), OutputError);
  EXPECT_NO_THROW(require_size(MapFormat::exr, 32768, 32768, "a.exr"));
}

TEST(Npz, CodesKeepTheirScale) {
  DepthMap map = map_of(2, 1, "Z", std::vector<std::uint16_t>{0, 65535});
  map.png_scale = 0.1;
  const DepthMap back = decode_map(encode_npz(map, "a.npz"), "a.npz");
  EXPECT_EQ(back.png_scale, 0.1);
  EXPECT_THAT(*back.values<std::uint16_t>("Z"), ElementsAre(0, 65535));
}

TEST(Npz, IsReadByNumPy) {
  const Folder folder;
  const DepthMap map = rich_map();
  write_map(map, folder / "a.npz", MapFormat::npz);
  const Outcome outcome = python_in(folder, R"(
import zipfile
assert zipfile.ZipFile('a.npz').testzip() is None
file = np.load('a.npz')
for name in file:
    print(name, file[name].dtype, file[name].shape)
    if name != 'fathom': file[name].tofile(name + '.raw')
texts = json.loads(file['fathom'].item())
print(texts['fathom.camera'], json.loads(texts['fathom.objects']))
)");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.output,
            "Z float32 (3, 5)\nN float32 (3, 5, 3)\nobject uint32 (3, 5)\nid uint32 (3, 5)\n"
            "distance float64 (3, 5)\nbary float32 (3, 5, 2)\nP.X float32 (3, 5)\n"
            "fathom |S" +
                outcome.output.substr(outcome.output.find("|S") + 2, 3) +
                " ()\n{\"width\": 3} ['spot', 'wall \"é\"', '']\n");
  // Every bit, at its place.
  std::ifstream raw(folder / "N.raw", std::ios::binary);
  for (std::size_t k = 0; k < 15; ++k)
    for (const char* part : {"N.X", "N.Y", "N.Z"}) {
      std::uint32_t bits = 0;
      raw.read(reinterpret_cast<char*>(&bits), 4);
      EXPECT_EQ(bits, bits_of(*map.find(part))[k]);
    }
}

TEST(Npz, OfNumPyIsRead) {
  const Folder folder;
  const Outcome outcome = python_in(folder, R"(
z = np.arange(12, dtype='<f4').reshape(3, 4)
n = np.arange(36, dtype='>f8').reshape(3, 4, 3)
extra = dict(f=np.arange(3.0), names=np.array(['a', 'b']), flag=np.array(True))
np.savez('plain.npz', Z=z, N=np.asfortranarray(n), **extra)
np.savez_compressed('packed.npz', Z=z, N=n, other=n[:, :, :2], **extra)
np.savez('two.npz', depth=z, K=np.eye(3))
np.savez('none.npz', **extra)
)");
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  for (const char* name : {"plain.npz", "packed.npz"}) {
    const DepthMap map = read_map(folder / name);
    EXPECT_EQ(map.width, 4u);
    EXPECT_EQ(map.height, 3u);
    EXPECT_EQ(map.values<float>("Z")->at(7), 7);
    EXPECT_EQ(map.values<double>("N.Y")->at(7), 22) << name;
    EXPECT_EQ(map.find("f"), nullptr);
  }
  EXPECT_EQ(read_map(folder / "packed.npz").values<double>("other.1")->at(7), 22);
  const auto refusal = [&](const char* name) -> std::string {
    try {
      read_map(folder / name);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(refusal("two.npz"), HasSubstr("arrays of two sizes: 'K' has 3×3 pixels"));
  EXPECT_THAT(refusal("none.npz"), HasSubstr("expected arrays of two dimensions"));
}

TEST(Npy, PixelsOfSeveralPartsAreReadByNumPy) {
  const Folder folder;
  const DepthMap map = rich_map();
  write_map(map, folder / "n.npy", MapFormat::npy, {.channel = "N"});
  write_map(map, folder / "b.npy", MapFormat::npy, {.channel = "bary"});
  EXPECT_THROW(write_map(map, folder / "p.npy", MapFormat::npy, {.channel = "P"}), UsageError);
  const Outcome outcome = python_in(folder, R"(
n, b = np.load('n.npy'), np.load('b.npy')
print(n.dtype, n.shape, b.shape, n[1, 2].tobytes().hex())
)");
  const DepthMap back = read_map(folder / "n.npy");
  for (const auto& [ours, theirs] :
       {std::pair("N.X", "vector.0"), std::pair("N.Y", "vector.1"), std::pair("N.Z", "vector.2")})
    EXPECT_EQ(bits_of(*back.find(theirs)), bits_of(*map.find(ours)));
  std::string hex;
  for (const char* part : {"N.X", "N.Y", "N.Z"}) {
    const std::uint64_t bits = bits_of(*map.find(part))[7];
    for (int byte = 0; byte < 4; ++byte) {
      std::array<char, 3> digits{};
      std::snprintf(digits.data(), 3, "%02x", static_cast<unsigned>(bits >> (8 * byte) & 0xFF));
      hex += digits.data();
    }
  }
  EXPECT_EQ(outcome.output, "float32 (3, 5, 3) (3, 5, 2) " + hex + "\n");
}

TEST(Npy, ATrailingOneIsNoPart) {
  const Folder folder;
  python_in(folder,
            "np.save('a.npy', np.ones((2, 3, 1), 'f4'))\n"
            "np.save('b.npy', np.ones((2, 3, 5), 'f4'))\n");
  EXPECT_EQ(read_map(folder / "a.npy").values<float>("Z")->size(), 6u);
  EXPECT_THROW(read_map(folder / "b.npy"), InputError);
}

/// The message of the InputError that reading ends in.
std::string refusal_of(ByteView bytes) {
  try {
    decode_map(bytes, "map");
  } catch (const InputError& failure) {
    return failure.what();
  }
  return "it was read";
}

TEST(Npz, DoesNotTrustItsDirectory) {
  const DepthMap map = map_of(4, 2, "Z", std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8});
  const Bytes whole = encode_npz(map, "a.npz");
  const std::size_t end = whole.size() - 22;
  const std::size_t directory = load<std::uint32_t>(&whole[end + 16], std::endian::little);
  const auto with = [&](std::size_t at, auto value) {
    Bytes changed = whole;
    store(&changed[at], value, std::endian::little);
    return refusal_of(changed);
  };
  EXPECT_EQ(refusal_of(whole), "it was read");
  EXPECT_THAT(with(end, std::uint32_t{0}), HasSubstr("expected a directory at its end"));
  EXPECT_THAT(with(end + 16, std::uint32_t{0xFFFFFFF0}), HasSubstr("directory is longer"));
  EXPECT_THAT(with(end + 16, std::uint32_t{0xFFFFFFFF}), HasSubstr("ZIP64"));
  EXPECT_THAT(with(end + 10, std::uint16_t{3}), HasSubstr("several parts"));
  EXPECT_THAT(with(directory, std::uint32_t{0}), HasSubstr("directory ends early"));
  EXPECT_THAT(with(directory + 8, std::uint16_t{0x801}), HasSubstr("encrypted"));
  EXPECT_THAT(with(directory + 10, std::uint16_t{12}), HasSubstr("method 12"));
  EXPECT_THAT(with(directory + 16, std::uint32_t{1}), HasSubstr("checksum"));
  EXPECT_THAT(with(directory + 24, std::uint32_t{1}), HasSubstr("two sizes"));
  EXPECT_THAT(with(directory + 42, std::uint32_t{1}),
              HasSubstr("not at the place in its directory"));
  EXPECT_THAT(with(directory + 28, std::uint16_t{60000}), HasSubstr("directory ends early"));
  // A value.
  EXPECT_THAT(with(180, std::uint8_t{77}), HasSubstr("checksum"));
}

TEST(Npz, FilesThatOverlapAreRefused) {
  // Two entries for the same bytes, and more of them: a "zip bomb".
  const DepthMap map = map_of(64, 64, "Z", Samples<float>(4096));
  const Bytes whole = encode_npz(map, "a.npz");
  const std::size_t end = whole.size() - 22;
  const std::size_t begin = load<std::uint32_t>(&whole[end + 16], std::endian::little);
  const std::size_t entry = 46 + 5;  // "Z.npy"
  Bytes bomb(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(begin));
  for (char letter = 'A'; letter <= 'Z'; ++letter) {
    append(bomb, ByteView(whole).subspan(begin, entry));
    bomb[bomb.size() - 5] = static_cast<std::byte>(letter);
  }
  const std::size_t new_end = bomb.size();
  append(bomb, ByteView(whole).subspan(end));
  store(&bomb[new_end + 8], std::uint16_t{26}, std::endian::little);
  store(&bomb[new_end + 10], std::uint16_t{26}, std::endian::little);
  store(&bomb[new_end + 12], static_cast<std::uint32_t>(new_end - begin), std::endian::little);
  EXPECT_THAT(refusal_of(bomb), HasSubstr("its files overlap"));
}

TEST(Npz, AConstantMapOfAFewBytesTakesWhatItMay) {
  const Folder folder;
  const Outcome outcome =
      python_in(folder, "np.savez_compressed('a.npz', Z=np.zeros((2000, 2000), 'f4'))\n");
  ASSERT_EQ(outcome.status, 0);
  EXPECT_EQ(read_map(folder / "a.npz").width, 2000u);
  MapMemory memory;
  memory.of_small_file = MemoryAllowance{1000000, "such a small file may unpack to", ""};
  EXPECT_THROW(read_map(folder / "a.npz", memory), InputError);
  memory.of_small_file.reset();
  memory.allowance.bytes = 1000000;
  EXPECT_THROW(read_map(folder / "a.npz", memory), InputError);
}

TEST(Npz, TextsAreOneJsonObject) {
  const auto archive = [](const std::string& text) {
    ZipWriter zip("a.npz");
    const DepthMap map = map_of(1, 1, "Z", std::vector<float>{1});
    zip.add("Z.npy", npy_of_channels({1, 1}, {&map.channels[0]}));
    zip.add("fathom.npy", npy_of_text(text));
    return zip.take();
  };
  EXPECT_EQ(decode_map(archive(R"({"a": "b"})"), "map").texts.at("a"), "b");
  for (const char* text : {"[]", "{", R"({"a": 1})", R"({"fathom:scale": "-1"})", "{} x"})
    EXPECT_THAT(refusal_of(archive(text)), ::testing::StartsWith("map: 'fathom': ")) << text;
}

}  // namespace
}  // namespace fathom
