#include <ImfIDManifest.h>
#include <ImfInputFile.h>
#include <ImfStandardAttributes.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "fathom/image/files/renamed_channels.h"
#include "fathom/image/map_files.h"
#include "fathom/image/surface.h"
#include "tests/image/map_samples.h"
#include "tests/image/run_program.h"
#include "tests/places.h"

/// Our files in other programs: OpenImageIO, OpenEXR's exrheader, NumPy.
namespace fathom {
namespace {

using ::testing::HasSubstr;
using namespace fathom::checks;

/// 4×3: depths 1.5, 2, 2.5, … and one background pixel.
DepthMap sample() {
  std::vector<float> z(12);
  std::vector<std::uint32_t> id(12), object(12), material(12);
  for (std::size_t k = 0; k < 12; ++k) {
    z[k] = 1.5f + 0.5f * static_cast<float>(k);
    id[k] = 4000000000u + static_cast<std::uint32_t>(k);
    object[k] = k % 2;
    material[k] = k % 4 == 3 ? no_segment : k % 4 == 0;
  }
  z[11] = inf;
  id[11] = object[11] = material[11] = no_surface;
  DepthMap map = map_of(4, 3, "Z", z);
  map.channels.push_back({"id", id});
  map.channels.push_back({"object", object});
  map.channels.push_back({"material", material});
  map.object_names = {"spot", "ground"};
  map.tables["material"] = {"oak", "steel"};
  map.texts["fathom.camera"] =
      R"({"width": 4, "height": 3, "fx": 2.0, "fy": 2.0, "cx": 2.0, "cy": 1.5})";
  map.numbers["worldToCamera"] = {1, 5, 9, 0, 2, 6, 10, 0, 3, 7, 11, 0, 4, 8, 12, 1};
  map.numbers["worldToNDC"] = {0.5, 0, 0, 0, 0, 0.75, 0, 0, 0.25, 0.5, 1, 1, 0.125, 3, 0, 0};
  return map;
}

DepthMap codes_of_sample() {
  std::vector<std::uint16_t> codes(12);
  for (std::size_t k = 0; k < 11; ++k) codes[k] = static_cast<std::uint16_t>(1500 + 500 * k);
  DepthMap map = map_of(4, 3, "Z", codes);
  map.png_scale = 1000;
  return map;
}

/// map.exr, map.png, map.npy, map.npz and map.pfm of the sample, and for-opencv.exr.
void write_all(const Folder& folder) {
  const DepthMap map = sample();
  WriteOptions options;
  options.channel = "Z";
  write_map(map, folder / "map.exr", MapFormat::exr);
  write_map(map, folder / "map.pfm", MapFormat::pfm, options);
  write_map(map, folder / "map.npy", MapFormat::npy, options);
  write_map(map, folder / "map.npz", MapFormat::npz);
  DepthMap depth = map;
  depth.channels.resize(1);
  write_map(with_channel_names(with_background(depth, 0), {{"Z", "Y"}}), folder / "for-opencv.exr",
            MapFormat::exr);
  write_map(codes_of_sample(), folder / "map.png", MapFormat::png);
}

Outcome in_folder(const Folder& folder, const std::string& command) {
  return run("cd '" + (folder / "").string() + "' && " + command);
}

TEST(OpenImageIO, ReadsExrInEveryCompression) {
  const Folder folder;
  const std::vector<std::pair<Compression, std::string>> all{{Compression::none, "none"},
                                                             {Compression::rle, "rle"},
                                                             {Compression::zips, "zips"},
                                                             {Compression::zip, "zip"},
                                                             {Compression::piz, "piz"}};
  for (const auto& [compression, name] : all) {
    WriteOptions options;
    options.compression = compression;
    write_map(sample(), folder / "map.exr", MapFormat::exr, options);
    const Outcome info = in_folder(folder, "oiiotool --info -v --stats map.exr");
    EXPECT_EQ(info.status, 0) << info.output;
    EXPECT_THAT(info.output, HasSubstr("4 x    3, 4 channel, float/uint/uint/uint openexr"));
    EXPECT_THAT(info.output,
                HasSubstr("channel list: Z (float), id (uint), material (uint), object (uint)"));
    EXPECT_THAT(info.output, HasSubstr("compression: \"" + name + "\""));
    EXPECT_THAT(info.output, HasSubstr("Stats Min: 1.500000"));
    EXPECT_THAT(info.output, HasSubstr("Stats Max: 6.500000"));
    EXPECT_THAT(info.output, HasSubstr("Stats InfCount: 1 0 0"));
    EXPECT_THAT(info.output,
                HasSubstr("worldToCamera: 1, 5, 9, 0, 2, 6, 10, 0, 3, 7, 11, 0, 4, 8, 12, 1"));
    EXPECT_THAT(info.output, HasSubstr("worldToNDC: 0.5, 0, 0, 0, 0, 0.75, 0, 0, 0.25, 0.5, 1, 1, "
                                       "0.125, 3, 0, 0"));
    EXPECT_THAT(info.output, HasSubstr("fathom.objects: \"[\"spot\",\"ground\"]\""));
    EXPECT_EQ(in_folder(folder, "iinfo map.exr").status, 0);
  }
}

TEST(OpenImageIO, ReadsPngAndPfm) {
  const Folder folder;
  write_all(folder);
  const Outcome png = in_folder(folder, "oiiotool --info -v --stats map.png");
  EXPECT_THAT(png.output, HasSubstr("4 x    3, 1 channel, uint16 png"));
  EXPECT_THAT(png.output, HasSubstr("Stats Min: 0 (of 65535)"));
  EXPECT_THAT(png.output, HasSubstr("Stats Max: 6500 (of 65535)"));
  EXPECT_THAT(png.output, HasSubstr("fathom:scale: \"1000\""));
  const Outcome dump = in_folder(folder, "oiiotool --dumpdata map.png");
  EXPECT_THAT(dump.output, HasSubstr("Pixel (1, 2): 6000"));
}

TEST(OpenExr, HeaderAndManifestAreWellFormed) {
  const Folder folder;
  write_all(folder);
  const Outcome header = in_folder(folder, "exrheader map.exr");
  EXPECT_EQ(header.status, 0);
  EXPECT_THAT(header.output, HasSubstr("Z, 32-bit floating-point, sampling 1 1"));
  EXPECT_THAT(header.output, HasSubstr("object, 32-bit unsigned integer, sampling 1 1"));
  EXPECT_THAT(header.output, HasSubstr("compression (type compression): zip, multi-scanline"));
  EXPECT_THAT(header.output, HasSubstr("idManifest (type idmanifest)"));

  const Imf::InputFile file((folder / "map.exr").c_str());
  ASSERT_TRUE(Imf::hasIDManifest(file.header()));
  const Imf::IDManifest manifest(Imf::idManifest(file.header()));
  ASSERT_EQ(manifest.size(), 2u);
  EXPECT_EQ(manifest[0].getChannels(), std::set<std::string>{"object"});
  EXPECT_EQ(manifest[0].getEncodingScheme(), "id");
  ASSERT_EQ(manifest[0].size(), 2u);
  EXPECT_EQ(manifest[0].find(0).text(), std::vector<std::string>{"spot"});
  EXPECT_EQ(manifest[0].find(1).text(), std::vector<std::string>{"ground"});
  EXPECT_EQ(manifest[1].getChannels(), std::set<std::string>{"material"});
  EXPECT_EQ(manifest[1].find(0).text(), std::vector<std::string>{"oak"});
}

TEST(OpenExr, ManifestNamesTheNumbersOfEveryChannelThatHasNames) {
  const Folder folder;
  DepthMap map = map_of(2, 1, "material", std::vector<std::uint32_t>{1, no_segment});
  map.channels.push_back({"object", Samples<std::uint32_t>{0, 1}});
  map.channels.push_back({"label", Samples<std::uint32_t>{7, 8}});
  map.object_names = {"spot", "ground"};
  map.tables = {{"material", {"oak", "steel"}}, {"part", {"lid"}}};
  write_map(map, folder / "map.exr", MapFormat::exr);
  const Imf::InputFile file((folder / "map.exr").c_str());
  const Imf::IDManifest manifest(Imf::idManifest(file.header()));
  // Of channels that are there, whether they are listed so or not.
  ASSERT_EQ(manifest.size(), 2u);
  EXPECT_EQ(manifest[0].getChannels(), std::set<std::string>{"material"});
  EXPECT_EQ(manifest[0].find(1).text(), std::vector<std::string>{"steel"});
  EXPECT_EQ(manifest[1].getChannels(), std::set<std::string>{"object"});
  EXPECT_EQ(manifest[1].find(1).text(), std::vector<std::string>{"ground"});
  const Outcome header = in_folder(folder, "exrheader map.exr");
  EXPECT_THAT(header.output, HasSubstr("fathom.materials (type string): \"[\"oak\",\"steel\"]\""));
}

TEST(NumPy, ReadsEveryTypeOfNpy) {
  const Folder folder;
  write_map(map_of(3, 2, "Z", std::vector<float>{1, 2, 3, 4, 5, inf}), folder / "f4.npy",
            MapFormat::npy);
  write_map(map_of(3, 2, "Z", std::vector<double>{0.1, 2, 3, 4, 5, 6}), folder / "f8.npy",
            MapFormat::npy);
  write_map(map_of(3, 2, "Z", std::vector<std::uint16_t>{1, 2, 3, 4, 5, 65535}), folder / "u2.npy",
            MapFormat::npy);
  write_map(map_of(3, 2, "id", std::vector<std::uint32_t>{1, 2, 3, 4, 5, no_surface}),
            folder / "u4.npy", MapFormat::npy);
  const Outcome outcome = in_folder(folder,
                                    "/usr/bin/python3 -c \"\n"
                                    "import numpy as np\n"
                                    "for t in ['f4', 'f8', 'u2', 'u4']:\n"
                                    "    a = np.load(t + '.npy')\n"
                                    "    print(a.dtype, a.shape, repr(a[0, 0].item()), "
                                    "a[1, 0].item(), a[1, 2].item())\n"
                                    "\"");
  EXPECT_EQ(outcome.output,
            "float32 (2, 3) 1.0 4.0 inf\nfloat64 (2, 3) 0.1 4.0 6.0\n"
            "uint16 (2, 3) 1 4 65535\nuint32 (2, 3) 1 4 4294967295\n");
}

TEST(NumPy, WritesNpyThatWeRead) {
  const Folder folder;
  const Outcome outcome =
      in_folder(folder,
                "/usr/bin/python3 -c \"\n"
                "import numpy as np\n"
                "a = np.arange(6).reshape(2, 3)\n"
                "np.save('a.npy', np.asfortranarray(a.astype('>f8')))\n"
                "np.lib.format.write_array(open('b.npy', 'wb'), a.astype('<f2'), version=(2, 0))\n"
                "np.save('c.npy', a.astype('>u4'))\n"
                "\"");
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  EXPECT_EQ(*read_map(folder / "a.npy").values<double>("Z"),
            (std::vector<double>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(*read_map(folder / "b.npy").values<float>("Z"), (std::vector<float>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(*read_map(folder / "c.npy").values<std::uint32_t>("id"),
            (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5}));
}

TEST(OpenImageIO, WritesExrThatWeRead) {
  const Folder folder;
  write_all(folder);
  for (const char* options :
       {"--compression pxr24 -d half", "--tile 16 16 -d float --compression piz"}) {
    const Outcome outcome =
        in_folder(folder, std::string("oiiotool map.exr --ch Z ") + options + " -o other.exr");
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_EQ(bits_of(*read_map(folder / "other.exr").find("Z")), bits_of(*sample().find("Z")))
        << options;
  }
}

std::string contents_of(const std::string& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

/// All code of the page in one language, in order; but what uses `without`, if that is a word.
std::string code_in(const std::string& page, const std::string& language,
                    const std::string& without = "") {
  std::string code;
  const std::string begin = "```" + language + "\n";
  for (std::size_t at = page.find(begin); at != std::string::npos; at = page.find(begin, at)) {
    at += begin.size();
    const std::string block = page.substr(at, page.find("```", at) - at);
    if (without.empty() || block.find(without) == std::string::npos) code += block;
  }
  return code;
}

TEST(ReadingMaps, PythonOfThePageRuns) {
  const Folder folder;
  write_all(folder);
  const std::string page = contents_of(test::source_dir() / "docs/reading-maps.md");
  // `tests` of scripts/install-dependencies has OpenCV; elsewhere there may be none.
  const bool has_opencv = run("/usr/bin/python3 -c 'import cv2'").status == 0;
  if (!has_opencv) std::cout << "without OpenCV's part: install python3-opencv\n";
  std::ofstream(folder / "page.py") << code_in(page, "python", has_opencv ? "" : "cv2");
  const Outcome outcome = in_folder(folder, "/usr/bin/python3 page.py");
  EXPECT_EQ(outcome.status, 0) << outcome.output;
  // The mean of the points by hand: pixel centres (i − 1.5)/2 and (j − 1)/2 times Z = 1.5 + k/2.
  double mean_x = 0, mean_y = 0, mean_z = 0;
  for (int k = 0; k < 11; ++k) {
    const double z = 1.5 + 0.5 * k;
    mean_x += (k % 4 - 1.5) / 2 * z / 11;
    mean_y += (k / 4 - 1) / 2.0 * z / 11;
    mean_z += z / 11;
  }
  std::istringstream lines(outcome.output);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "nearest 1.5 farthest 6.5 pixels 11");
  std::getline(lines, line);
  EXPECT_EQ(line, "triangles seen 11");
  std::getline(lines, line, '[');
  EXPECT_EQ(line, "points (11, 3) mean ");
  double x = 0, y = 0, z = 0;
  lines >> x >> y >> z;
  // NumPy prints 8 digits.
  EXPECT_NEAR(x, mean_x, 1e-7);
  EXPECT_NEAR(y, mean_y, 1e-7);
  EXPECT_NEAR(z, mean_z, 1e-7);
  std::getline(lines, line);
  std::getline(lines, line);
  EXPECT_EQ(line, "oak is seen at 6 pixels");
  std::getline(lines, line);
  EXPECT_EQ(line, "steel is seen at 3 pixels");
  if (has_opencv) {
    std::getline(lines, line);
    EXPECT_EQ(line, "OpenCV (3, 4) nearest 1.5");
  }
  for (int k = 0; k < 4; ++k) {
    std::getline(lines, line);
    EXPECT_EQ(line, k == 1 ? "nearest 1.5 width 4" : "nearest 1.5");
  }
}

TEST(ReadingMaps, CppOfThePageIsTheProgramThatRuns) {
  const std::string page = contents_of(test::source_dir() / "docs/reading-maps.md");
  EXPECT_EQ(code_in(page, "cpp"),
            contents_of(test::source_dir() / "tests/image/read_map_example.cpp"));
  const Folder folder;
  write_all(folder);
  for (const char* file : {"map.exr", "map.pfm", "map.npy"}) {
    const Outcome outcome =
        in_folder(folder, test::program("read_map_example").string() + " " + file);
    EXPECT_THAT(outcome.output, HasSubstr("0 0 1.5\n1 0 2\n"));
    EXPECT_THAT(outcome.output, HasSubstr("2 2 6.5\n"));
  }
}

}  // namespace
}  // namespace fathom
