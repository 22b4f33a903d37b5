#include "fathom/camera/camera_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <clocale>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>

#include "fathom/failures/errors.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr const char* plain =
    R"("width": 640, "height": 480, "fx": 525, "fy": 525.5, "cx": 320, "cy": 240)";
constexpr const char* pose = R"("world_to_camera": [[1,0,0,0],[0,1,0,0],[0,0,1,0]])";

std::vector<Camera> read(const std::string& text) {
  const ScratchFolder folder;
  return read_cameras(folder.write("camera.json", text));
}

Camera with(const std::string& more) {
  return read(std::string("{") + plain + "," + pose + (more.empty() ? "" : "," + more) + "}").at(0);
}

/// Bit for bit: also the sign of a zero counts.
bool same_bits(const Camera& a, const Camera& b) {
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
  const auto numbers = [](const Camera& c) {
    std::vector<double> list{
        c.projection.fx,   c.projection.fy,           c.projection.cx, c.projection.cy,
        c.projection.skew, c.projection.pixel_centre, c.near,          c.far};
    for (const auto& row : c.world_to_camera) list.insert(list.end(), row.begin(), row.end());
    return list;
  };
  const auto x = numbers(a), y = numbers(b);
  for (std::size_t i = 0; i < x.size(); ++i)
    if (bits(x[i]) != bits(y[i])) return false;
  return a.width == b.width && a.height == b.height && a.projection.model == b.projection.model;
}

TEST(CameraJson, DefaultsAreThoseOfTheInterface) {
  const Camera camera = with("");
  EXPECT_EQ(camera.width, 640U);
  EXPECT_EQ(camera.height, 480U);
  EXPECT_EQ(camera.projection.model, ProjectionModel::perspective);
  EXPECT_EQ(camera.projection.fx, 525);
  EXPECT_EQ(camera.projection.fy, 525.5);
  EXPECT_EQ(camera.projection.cx, 320);
  EXPECT_EQ(camera.projection.cy, 240);
  EXPECT_EQ(camera.projection.skew, 0);
  EXPECT_EQ(camera.projection.pixel_centre, 0.5);
  EXPECT_EQ(camera.near, 0);
  EXPECT_EQ(camera.far, std::numeric_limits<double>::infinity());
}

TEST(CameraJson, ReadsEveryKey) {
  const Camera camera = with(
      R"("projection": "orthographic", "skew": -1.5, "pixel_centre": 0, "near": 0.1, "far": 100)");
  EXPECT_EQ(camera.projection.model, ProjectionModel::orthographic);
  EXPECT_EQ(camera.projection.skew, -1.5);
  EXPECT_EQ(camera.projection.pixel_centre, 0);
  EXPECT_EQ(camera.near, 0.1);
  EXPECT_EQ(camera.far, 100);
  EXPECT_EQ(with(R"("far": null)").far, std::numeric_limits<double>::infinity());
}

TEST(CameraJson, TakesA4x4WithTheLastRow0001) {
  const std::string rows = R"("world_to_camera": [[1,2,0,4],[0,1,0,5],[0,0,1,6])";
  const Camera camera = read(std::string("{") + plain + "," + rows + ",[0,0.0,-0.0,1e0]]}").at(0);
  EXPECT_EQ(camera.world_to_camera[0], (std::array<double, 4>{1, 2, 0, 4}));
  EXPECT_EQ(camera.world_to_camera[2], (std::array<double, 4>{0, 0, 1, 6}));
  EXPECT_THAT(
      message_of<InputError>([&] { read(std::string("{") + plain + "," + rows + ",[0,0,0,2]]}"); }),
      HasSubstr("world_to_camera[3]: expected the last row"));
}

TEST(CameraJson, SaysThatAMatrixLooksTransposed) {
  const auto of = [&](const std::string& key, const std::string& rows) {
    return message_of<InputError>(
        [&] { read(std::string("{") + plain + ",\"" + key + "\": " + rows + "}"); });
  };
  const std::string columns = "[[1,0,0,0],[0,1,0,0],[0,0,1,0],[1,2,3,1]]";
  for (const char* key : {"world_to_camera", "camera_to_world"})
    EXPECT_THAT(of(key, columns),
                AllOf(HasSubstr(std::string(key) + "[3]: "), HasSubstr("looks transposed")));
  for (const char* row : {"[1,0,0,5],[0,1,0,0],[0,0,1,0]", "[1,0,0,0],[0,1,0,0],[0,0,1,5]"})
    EXPECT_THAT(of("world_to_camera", std::string("[") + row + ",[1,2,3,1]]"),
                testing::Not(HasSubstr("transposed")));
}

TEST(CameraJson, PixelCenterIsPixelCentre) {
  EXPECT_EQ(with(R"("pixel_center": 0)").projection.pixel_centre, 0);
  EXPECT_THAT(message_of<InputError>([&] { with(R"("pixel_center": 0, "pixel_centre": 0)"); }),
              HasSubstr("both \"pixel_centre\" and \"pixel_center\""));
}

TEST(CameraJson, KIsItsFiveNumbers) {
  const std::string start = R"({"width": 640, "height": 480, "K": )";
  const auto of = [&](const std::string& K, const std::string& more = "") {
    return read(start + K + "," + pose + more + "}").at(0);
  };
  const Camera camera = of("[[525, 1.5, 320], [0, 525.5, 240], [0, 0, 1]]");
  const Camera expected = with(R"("skew": 1.5)");
  EXPECT_TRUE(same_bits(camera, expected)) << to_json(camera);
  const auto fault = [&](const std::string& K, const std::string& more = "") {
    return message_of<InputError>([&] { of(K, more); });
  };
  EXPECT_THAT(fault("[[525,0,320],[1e-9,525,240],[0,0,1]]"), HasSubstr("K[1]: expected 0"));
  EXPECT_THAT(fault("[[525,0,320],[0,525,240],[0,0,2]]"), HasSubstr("K[2]: expected the last row"));
  EXPECT_THAT(fault("[[525,0,320],[0,525,240]]"), HasSubstr("K: expected a list of 3"));
  EXPECT_THAT(fault("[525,0,320]"), HasSubstr("K[0]: expected a list of 3"));
  EXPECT_THAT(fault("[[525,0],[0,525,240],[0,0,1]]"), HasSubstr("K[0]: expected a list of 3"));
  EXPECT_THAT(fault("[[0,0,320],[0,525,240],[0,0,1]]"), HasSubstr("fx is 0"));
  for (const std::string key : {"fx", "fy", "cx", "cy", "skew"})
    EXPECT_THAT(fault("[[525,0,320],[0,525,240],[0,0,1]]", ", \"" + key + "\": 1"),
                HasSubstr("both \"K\" and \"" + key + "\""));
}

TEST(CameraJson, CameraToWorldIsInvertedExactly) {
  const auto of = [&](const std::string& rows, const std::string& more = "") {
    return read(std::string("{") + plain + ",\"camera_to_world\": " + rows + more + "}").at(0);
  };
  // A third is no binary64 number: each entry is rounded once.
  const Camera camera = of("[[3,0,0,1],[0,1,0,-2],[0,0,1,4],[0,0,0,1]]");
  EXPECT_EQ(camera.world_to_camera[0], (std::array<double, 4>{1.0 / 3, 0, 0, -1.0 / 3}));
  EXPECT_EQ(camera.world_to_camera[1], (std::array<double, 4>{0, 1, 0, 2}));
  EXPECT_EQ(camera.world_to_camera[2], (std::array<double, 4>{0, 0, 1, -4}));
  // The inverse of what the library inverts, on a pose of many digits.
  Camera posed = with("");
  posed.world_to_camera = {
      {{0.77, 0.01, 0.63, -0.07}, {-0.14, -0.97, 0.17, 0.1}, {0.6, -0.2, -0.7, 3}}};
  Camera inverted = posed;
  inverted.world_to_camera = camera_to_world(posed.world_to_camera);
  std::string text = to_json(inverted);
  text.replace(text.find("world_to_camera"), 15, "camera_to_world");
  EXPECT_EQ(read(text).at(0).world_to_camera, camera_to_world(inverted.world_to_camera));
  const auto fault = [&](const std::string& rows, const std::string& more = "") {
    return message_of<InputError>([&] { of(rows, more); });
  };
  EXPECT_THAT(fault("[[1,2,3,0],[2,4,6,0],[0,0,1,0]]"), HasSubstr("camera_to_world: is singular"));
  EXPECT_THAT(fault("[[1e-300,0,0,1e300],[0,1,0,0],[0,0,1,0]]"),
              HasSubstr("camera_to_world: its inverse has an entry beyond"));
  EXPECT_THAT(fault("[[1,0,0,0],[0,1,0,0]]"), HasSubstr("camera_to_world: expected 3 rows"));
  EXPECT_THAT(fault("[[1,0,0,0],[0,1,0,0],[0,0,1,0]]", std::string(",") + pose),
              HasSubstr("both \"world_to_camera\" and \"camera_to_world\""));
}

TEST(CameraJson, AFileThatDoesNotSayPixelCentreIsWarnedOfOnce) {
  const std::string start = std::string("{") + plain + "," + pose;
  const std::string silent = start + "}", said = start + ",\"pixel_centre\": 0.5}",
                    spelled = start + ",\"pixel_center\": 0}";
  const auto warnings_of = [](const std::string& text) {
    Warnings warnings;
    (void)read_cameras(text, "camera.json", warnings);
    return warnings;
  };
  using testing::ElementsAre;
  using testing::IsEmpty;
  EXPECT_THAT(warnings_of(silent),
              ElementsAre(AllOf(testing::StartsWith("camera.json: "), HasSubstr("pixel_centre"))));
  EXPECT_THAT(warnings_of("[" + said + "," + silent + "," + silent + "]"), testing::SizeIs(1));
  EXPECT_THAT(warnings_of(said), IsEmpty());
  EXPECT_THAT(warnings_of(spelled), IsEmpty());
  EXPECT_THAT(warnings_of(to_json(read(silent))), IsEmpty());
  const ScratchFolder folder;
  Warnings warnings;
  (void)read_cameras(folder.write("mine.json", silent), warnings);
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("mine.json: does not say")));
}

TEST(CameraJson, NumbersAreRoundedCorrectly) {
  // 2⁵³ + 1 is a tie (to even, downwards); a digit behind it decides otherwise.
  EXPECT_EQ(with(R"("skew": 9007199254740993)").projection.skew, 9007199254740992.0);
  EXPECT_EQ(with(R"("skew": 9007199254740993.0)").projection.skew, 9007199254740992.0);
  EXPECT_EQ(
      with(R"("skew": 9007199254740993.00000000000000000000000000000000000001)").projection.skew,
      9007199254740994.0);
  // Beyond 64 bits.
  EXPECT_EQ(with(R"("skew": 340282366920938463463374607431768211456)").projection.skew, 0x1p128);
  EXPECT_EQ(with(R"("skew": 18446744073709551617)").projection.skew, 0x1p64);
  EXPECT_EQ(with(R"("skew": -18446744073709551617)").projection.skew, -0x1p64);
  EXPECT_EQ(with(R"("skew": 18446744073709550591)").projection.skew, 0x1.fffffffffffffp63);
  // The half of the least subnormal is a tie and becomes 0, more becomes the least subnormal.
  EXPECT_EQ(with(R"("skew": 2.4703282292062327e-324)").projection.skew, 0.0);
  EXPECT_EQ(with(R"("skew": 2.4703282292062328e-324)").projection.skew, 0x1p-1074);
  EXPECT_EQ(with(R"("skew": 1e-400)").projection.skew, 0.0);
}

TEST(CameraJson, ReadsAPath) {
  const std::string camera = std::string("{") + plain + "," + pose + "}";
  EXPECT_EQ(read(std::string("[") + camera + ",\r\n" + camera + "]").size(), 2U);
  EXPECT_THAT(message_of<InputError>([&] {
                read(std::string("[") + camera + "," + camera + "," + "{" + plain + ",\"fz\": 1," +
                     pose + "}]");
              }),
              AllOf(HasSubstr("camera.json: [2]: "), HasSubstr("\"fz\"")));
  EXPECT_THAT(message_of<InputError>([&] { read("[]"); }), HasSubstr("empty"));
}

TEST(CameraJson, NamesFileKeyAndReason) {
  struct Case {
    std::string text;
    const char* expected;
  };
  const std::string start = std::string("{") + plain + ",";
  const std::string all = start + pose + ",";
  const Case cases[] = {
      {"", "line 1: not JSON"},
      {"{\n\"width\": 3,\n\"height\" 4}", "line 3: not JSON"},
      {all + "}", "line 1: not JSON"},
      {all + "\"far\": 1} x", "not JSON"},
      {all + "\"near\": NaN}", "not JSON"},
      {all + "\"near\": Infinity}", "not JSON"},
      {all + "\"near\": .5}", "not JSON"},
      {all + "\"near\": 0x10}", "not JSON"},
      {all + "\"skew\": 1e400}", "skew"},
      {all + "\"skew\": \"1\"}", "skew: is a string, expected a number"},
      {all + "\"skew\": null}", "skew: is null, expected a number"},
      {all + "\"skew\": [1]}", "skew: is a list, expected a number"},
      {all + "\"skew\": true}", "skew: is true or false, expected a number"},
      {all + "\"projection\": \"fisheye\"}", "projection: expected \"perspective\" or"},
      {all + "\"projection\": 1}", "projection: is a number, expected a string"},
      {all + "\"fx\": 2}", "\"fx\" stands twice"},
      {all + "\"focal\": 2}", "unknown key \"focal\""},
      {all + "\"a\\nb\": 2}", "unknown key"},
      {all + "\"near\": -1}", "near is negative"},
      {all + "\"near\": 3, \"far\": 3}", "far is not greater"},
      {start + "\"world_to_camera\": 3}", "world_to_camera: is a number, expected a list"},
      {start + "\"world_to_camera\": [[1,0,0,0],[0,1,0,0]]}", "world_to_camera: expected 3 rows"},
      {start + "\"world_to_camera\": [[1,0,0,0],[0,1,0],[0,0,1,0]]}",
       "world_to_camera[1]: expected a list of 4, found one of 3"},
      {start + "\"world_to_camera\": [[1,0,0,0],[0,1,0,\"0\"],[0,0,1,0]]}",
       "world_to_camera[1][3]: is a string"},
      {start + "\"world_to_camera\": [[1,2,3,0],[2,4,6,0],[0,0,1,0]]}", "singular"},
      {"3", "is a number, expected an object"},
      {"[[]]", "[0]: is a list, expected an object"},
      {"\"\xff\"", "not JSON"},
      {std::string(200, '['), "nested"},
      {std::string(1000000, '['), "nested"},
  };
  for (const auto& [text, expected] : cases)
    EXPECT_THAT(message_of<InputError>([&, &t = text] { read(t); }),
                AllOf(HasSubstr("camera.json: "), HasSubstr(expected)))
        << text.substr(0, 200);
  for (const char* missing : {"width", "height", "fx", "fy", "cx", "cy", "world_to_camera"}) {
    std::string text = start + pose + "}";
    text.replace(text.find(std::string("\"") + missing + "\""), std::strlen(missing) + 2,
                 "\"near\"");
    EXPECT_THAT(message_of<InputError>([&] { read(text); }),
                HasSubstr(std::string("the key \"") + missing + "\" is missing"));
  }
  EXPECT_THAT(message_of<InputError>([&] { read(std::string("{") + plain + "}"); }),
              HasSubstr("the key \"world_to_camera\" is missing"));
  for (const char* size : {"0", "-1", "1.5", "4294967296", "1e300", "\"640\"", "null"}) {
    std::string text = start + pose + "}";
    text.replace(text.find("640"), 3, size);
    EXPECT_THAT(message_of<InputError>([&] { read(text); }), HasSubstr("width: ")) << text;
  }
}

TEST(CameraJson, NamesFilesThatCannotBeRead) {
  const ScratchFolder folder;
  EXPECT_THAT(message_of<InputError>([&] { read_cameras(folder.path()); }),
              HasSubstr(folder.path().string()));
  EXPECT_THAT(message_of<InputError>([&] { read_cameras(folder.path() / "none.json"); }),
              HasSubstr("none.json"));
}

TEST(CameraJson, RoundTripsBitForBit) {
  std::mt19937_64 random(2);
  const auto any_finite = [&] {
    for (;;) {
      const auto x = std::bit_cast<double>(random());
      if (std::isfinite(x)) return x;
    }
  };
  const auto subnormal = [&] { return std::bit_cast<double>(random() & 0x800FFFFFFFFFFFFFULL); };
  std::vector<Camera> cameras;
  for (int i = 0; i < 20000; ++i) {
    const auto number = [&] { return random() % 4 == 0 ? subnormal() : any_finite(); };
    Camera camera;
    camera.width = 1 + static_cast<std::uint32_t>(random() % 0xFFFFFFFF);
    camera.height = 1 + static_cast<std::uint32_t>(random() % 0xFFFFFFFF);
    camera.projection.model =
        random() % 2 == 0 ? ProjectionModel::perspective : ProjectionModel::orthographic;
    camera.projection.fx = number(), camera.projection.fy = number(),
    camera.projection.cx = number(), camera.projection.cy = number();
    camera.projection.skew = number(), camera.projection.pixel_centre = number();
    for (auto& row : camera.world_to_camera)
      for (double& entry : row) entry = number();
    camera.near = std::abs(number());
    if (random() % 2 == 0) camera.far = std::abs(number());
    if (!find_fault(camera)) cameras.push_back(camera);
  }
  ASSERT_GT(cameras.size(), 10000U);
  cameras[0].projection.skew = -0.0;
  cameras[1].projection.cx = 0.0;
  const auto again = read(to_json(cameras));
  ASSERT_EQ(again.size(), cameras.size());
  for (std::size_t i = 0; i < cameras.size(); ++i)
    ASSERT_TRUE(same_bits(again[i], cameras[i])) << to_json(cameras[i]);
}

TEST(CameraJson, NumbersHaveAsFewDigitsAsTheyNeed) {
  Camera camera = with("");
  camera.near = 0.1;
  camera.far = 100000;
  EXPECT_THAT(to_json(camera), HasSubstr("\"near\": 0.1,\n  \"far\": 100000\n"));
  EXPECT_THAT(to_json(camera, Digits::seventeen), HasSubstr("\"near\": 0.10000000000000001,\n"));
  EXPECT_TRUE(same_bits(read(to_json(camera, Digits::seventeen)).at(0), camera));
}

/// A camera file with these members besides size and pose.
Camera with_lens(const std::string& members) {
  return read(R"({"width": 640, "height": 480, )" + members + "," + pose + "}").at(0);
}

TEST(CameraJson, ReadsALensByNamesByParamsAndByKWithDistortion) {
  const Lens opencv{LensModel::opencv, {-0.25, 0.5, 0.125, 1}};
  const std::string model = R"("model": "OPENCV", )";
  const Camera cameras[] = {
      with_lens(model + R"("fx": 525, "fy": 526, "cx": 320, "cy": 240, "k1": -0.25, "k2": 0.5,
                           "p1": 0.125, "p2": 1)"),
      with_lens(model + R"("params": [525, 526, 320, 240, -0.25, 0.5, 0.125, 1])"),
      with_lens(model + R"("K": [[525, 0, 320], [0, 526, 240], [0, 0, 1]],
                           "distortion": [-0.25, 0.5, 0.125, 1])")};
  for (const Camera& camera : cameras) {
    EXPECT_EQ(camera.projection.lens, std::optional(opencv));
    EXPECT_EQ(camera.projection.fx, 525);
    EXPECT_EQ(camera.projection.fy, 526);
    EXPECT_EQ(camera.projection.cx, 320);
    EXPECT_EQ(camera.projection.cy, 240);
  }
  const Camera radial = with_lens(R"("model": "SIMPLE_RADIAL", "f": 500, "cx": 1, "cy": 2,
                                     "k": 0.5, "max_radius": 0.75)");
  EXPECT_EQ(radial.projection.lens, std::optional(Lens{LensModel::simple_radial, {0.5}, 0.75}));
  EXPECT_EQ(radial.projection.fx, 500);
  EXPECT_EQ(radial.projection.fy, 500);
  const Camera skewed = with_lens(R"("model": "OPENCV_14", "params": [5, 6, 1, 2, 1, 2, 3, 4, 5],
                                     "skew": 0.5)");
  EXPECT_EQ(skewed.projection.lens, std::optional(Lens{LensModel::opencv_14, {1, 2, 3, 4, 5}}));
  EXPECT_EQ(skewed.projection.skew, 0.5);
  // Numbers of distortion that are left out are 0: no ray is bent.
  const Camera zero = with_lens(model + R"("fx": 525, "fy": 526, "cx": 320, "cy": 240)");
  EXPECT_TRUE(zero.projection.lens);
  EXPECT_FALSE(bends_rays(zero.projection));
}

TEST(CameraJson, LensesAreWrittenAsTheyAreRead) {
  for (const LensModelEntry& model : lens_models()) {
    if (model.model == LensModel::table) continue;  // its numbers are in another file
    Camera camera = with("");
    camera.projection.fy = camera.projection.fx;
    Lens& lens = camera.projection.lens.emplace(Lens{model.model});
    const bool has_ranges = model.formula == RayFormula::root || model.model == LensModel::ftheta;
    const double least = has_ranges ? 0.1 : -0.6;
    for (std::size_t i = 0; i < model.distortion.size(); ++i)
      lens.distortion[i] = least + 0.1 * static_cast<double>(i);
    const auto again = [&] { return read(to_json(camera)).at(0).projection; };
    EXPECT_EQ(again(), camera.projection) << model.name;
    lens.max_radius = 0.1;
    EXPECT_EQ(again(), camera.projection) << model.name;
  }
}

TEST(CameraJson, ReadsPanoramas) {
  Projection full{.fx = 8, .fy = 4, .cx = 4, .cy = 2};
  full.lens = Lens{LensModel::equirectangular};
  const std::string model = R"("model": "EQUIRECTANGULAR", )";
  for (const char* numbers : {R"("params": [8, 4])", R"("params": [8, 4, 4, 2])",
                              R"("w": 8, "h": 4)", R"("w": 8, "h": 4, "cx": 4, "cy": 2)"})
    EXPECT_EQ(with_lens(model + numbers).projection, full) << numbers;
  const Camera strip =
      with_lens(R"("model": "CYLINDRICAL", "w": 8, "fy": -2, "cx": 1, "cy": 3, "max_radius": 2)");
  Projection expected{.fx = 8, .fy = -2, .cx = 1, .cy = 3};
  expected.lens = Lens{LensModel::cylindrical, {}, 2};
  EXPECT_EQ(strip.projection, expected);
  EXPECT_TRUE(counts_distance(strip.projection));
}

TEST(CameraJson, NamesWhatIsWrongWithAPanorama) {
  const auto fault = [](const std::string& members) {
    return message_of<InputError>([&] { with_lens(members); });
  };
  const std::string model = R"("model": "EQUIRECTANGULAR", )";
  EXPECT_THAT(fault(model + R"("params": [0, 4])"), HasSubstr("w is not greater than 0"));
  EXPECT_THAT(fault(model + R"("params": [8, -4])"), HasSubstr("h is not greater than 0"));
  EXPECT_THAT(fault(model + R"("params": [8, 4, 1])"), HasSubstr("found 3 numbers"));
  EXPECT_THAT(fault(model + R"("w": 8, "h": 4, "cx": 1)"), HasSubstr("\"cy\""));
  EXPECT_THAT(fault(model + R"("w": 8, "h": 4, "skew": 0)"), HasSubstr("unknown key \"skew\""));
  EXPECT_THAT(fault(model + R"("K": [[5, 0, 3], [0, 6, 2], [0, 0, 1]])"),
              HasSubstr("unknown key \"K\""));
  EXPECT_THAT(fault(R"("model": "CYLINDRICAL", "params": [8, 0, 1, 1])"), HasSubstr("fy is 0"));
}

TEST(CameraJson, NamesWhatIsWrongWithALens) {
  const std::string K = R"("fx": 5, "fy": 6, "cx": 3, "cy": 2)", f = R"("f": 5, "cx": 3, "cy": 2)";
  const auto fault = [](const std::string& members) {
    return message_of<InputError>([&] { with_lens(members); });
  };
  EXPECT_THAT(fault(R"("model": "OPENVC", )" + K),
              AllOf(HasSubstr("unknown lens model 'OPENVC'"), HasSubstr("mean 'OPENCV'")));
  EXPECT_THAT(fault(R"("model": "OPENCV", "k3": 0, )" + K), HasSubstr("unknown key \"k3\""));
  EXPECT_THAT(fault(R"("model": "RADIAL", )" + K), HasSubstr("unknown key \"fx\""));
  EXPECT_THAT(fault(R"("model": "RADIAL", "skew": 1, )" + f), HasSubstr("unknown key \"skew\""));
  EXPECT_THAT(fault(R"("model": "OPENCV", "projection": "orthographic", )" + K),
              HasSubstr("projection: an orthographic camera has no lens"));
  EXPECT_THAT(fault(R"("model": "OPENCV", "params": [1, 2, 3, 4, 5])"),
              HasSubstr("params: found 5 numbers, OPENCV has 8"));
  EXPECT_THAT(fault(R"("model": "OPENCV", "params": [1])"), HasSubstr("found 1 number"));
  EXPECT_THAT(fault(R"("model": "OPENCV_14", "distortion": [1, 2, 3], )" + K),
              HasSubstr("found 3 numbers, OPENCV_14 has 4, 5, 8, 12 or 14"));
  EXPECT_THAT(fault(R"("model": "OPENCV", "params": [1, 2, 3, 4, 5, 6, 7, 8], "k1": 1)"),
              HasSubstr("has both \"params\" and \"k1\""));
  EXPECT_THAT(fault(R"("model": "OPENCV", "k1": 1, "distortion": [1, 2, 3, 4], )" + K),
              HasSubstr("has both \"distortion\" and \"k1\""));
  EXPECT_THAT(fault(R"("model": "SIMPLE_RADIAL", "K": [[5, 0, 3], [0, 6, 2], [0, 0, 1]])"),
              HasSubstr("SIMPLE_RADIAL has one focal length and no skew"));
  EXPECT_THAT(fault(R"("model": "OPENCV", "max_radius": 0, )" + K), HasSubstr("max_radius"));
  EXPECT_THAT(fault(R"("model": "OPENCV_14", "tauX": 1.6, )" + K), HasSubstr("tauX"));
  EXPECT_THAT(fault(R"("k1": 1, )" + K), HasSubstr("unknown key \"k1\""));
}

/// Reads a table of 2×1 directions, whatever its file is called.
std::shared_ptr<const DirectionTable> read_any_table(const std::string& file, std::uint32_t width,
                                                     std::uint32_t height) {
  std::vector<double> numbers(std::size_t{3} * width * height, 0.5);
  return std::make_shared<const DirectionTable>(width, height, std::move(numbers),
                                                Source{file, "abc", ""});
}

Camera with_table(const std::string& members, const DirectionReader& reader = read_any_table) {
  Warnings warnings;
  const std::string text =
      R"({"width": 2, "height": 1, "model": "TABLE", )" + members + "," + pose + "}";
  const Camera camera = read_cameras(std::string_view(text), "c.json", warnings, reader).at(0);
  EXPECT_TRUE(warnings.empty());  // a table has no pixel_centre
  return camera;
}

TEST(CameraJson, ATableIsInAFileOfItsOwn) {
  const Camera camera = with_table(R"("directions": "a/b.npy", "directions_sha256": "abc",
                                      "max_radius": 1.5)");
  ASSERT_TRUE(camera.projection.lens && camera.projection.lens->directions);
  EXPECT_EQ(camera.projection.lens->directions->source().path, "a/b.npy");
  EXPECT_EQ(camera.projection.lens->max_radius, 1.5);
  EXPECT_TRUE(bends_rays(camera.projection));
  EXPECT_TRUE(counts_distance(camera.projection));
  Warnings warnings;
  const std::string text = to_json(camera);
  EXPECT_EQ(
      read_cameras(std::string_view(text), "c.json", warnings, read_any_table).at(0).projection,
      camera.projection);
}

TEST(CameraJson, ATableWithoutAReaderIsOnlyNamed) {
  const Camera camera = with_table(R"("directions": "b.npy", "directions_sha256": "abc")", {});
  EXPECT_TRUE(bends_rays(camera.projection));
  EXPECT_FALSE(camera.projection.lens->directions->is_read());
  EXPECT_EQ(find_fault(camera),
            "the table of directions is in the file 'b.npy', which has not been read; give the "
            "camera file that names it");
  EXPECT_EQ(read(to_json(camera)).at(0).projection, camera.projection);
  Camera of_array;
  of_array.width = of_array.height = 1;
  of_array.projection.lens.emplace(Lens{LensModel::table}).directions =
      std::make_shared<const DirectionTable>(1, 1, std::vector<double>{0, 0, 1});
  EXPECT_EQ(find_fault(of_array), std::nullopt);
  const Camera again = read(to_json(of_array)).at(0);
  EXPECT_THAT(find_fault(again).value_or(""), HasSubstr("was an array and is in no file"));
  EXPECT_EQ(to_json(again), to_json(of_array));  // with the hash of the numbers
}

TEST(CameraJson, NamesWhatIsWrongWithATable) {
  const auto fault = [](const std::string& members) {
    return message_of<InputError>([&] { with_table(members); });
  };
  const std::string file = R"("directions": "b.npy")";
  EXPECT_THAT(fault(R"("max_radius": 1)"), HasSubstr("directions"));
  EXPECT_THAT(fault(file + R"(, "origins": "o.npy")"), HasSubstr("origins: not supported yet"));
  EXPECT_THAT(fault(file + R"(, "row_poses": [])"), HasSubstr("row_poses: not supported yet"));
  EXPECT_THAT(fault(file + R"(, "fx": 5)"), HasSubstr("unknown key \"fx\""));
  EXPECT_THAT(fault(file + R"(, "pixel_centre": 0)"), HasSubstr("unknown key \"pixel_centre\""));
  EXPECT_THAT(fault(file + R"(, "directions_sha256": "abd")"),
              HasSubstr("directions_sha256: the file 'b.npy' has the SHA-256 abc, expected abd"));
  EXPECT_THAT(fault(file + R"(, "projection": "orthographic")"),
              HasSubstr("an orthographic camera has no lens"));
  Camera camera = with_table(file);
  camera.projection.fx = -1;
  EXPECT_EQ(find_fault(camera), "TABLE has no fx, fy, cx, cy, skew and pixel_centre");
  camera.projection = {};
  camera.projection.lens = Lens{LensModel::table};
  EXPECT_EQ(find_fault(camera), "TABLE has no table of directions");
  camera.projection.lens = Lens{LensModel::opencv};
  camera.projection.lens->directions = read_any_table("b.npy", 2, 1);
  EXPECT_EQ(find_fault(camera), "OPENCV has a table of directions, which only TABLE has");
}

TEST(CameraJson, ASingleCameraIsWrittenAsAnObject) {
  const Camera camera = with("");
  const std::string text = to_json(std::vector{camera});
  EXPECT_EQ(text, to_json(camera));
  EXPECT_EQ(text.front(), '{');
  EXPECT_EQ(text.back(), '}');
  EXPECT_TRUE(same_bits(read(text).at(0), camera));
}

TEST(CameraJson, NamesAreKeptAsText) {
  Camera camera;
  camera.width = camera.height = 4;
  for (const char* name : {"left/0001.jpg", "a \"b\"\n\x01", "é"}) {
    camera.name = name;
    EXPECT_EQ(read_cameras(to_json(camera), "camera").at(0).name, name);
  }
  // What is no UTF-8 becomes U+FFFD: a camera file is text.
  camera.name = "a\xff";
  EXPECT_EQ(read_cameras(to_json(camera), "camera").at(0).name, "a\xef\xbf\xbd");
  camera.name.clear();
  EXPECT_EQ(to_json(camera).find("name"), std::string::npos);
}

}  // namespace
}  // namespace fathom
