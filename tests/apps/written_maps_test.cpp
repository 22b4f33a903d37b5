// How maps are written for other programs, NumPy and OpenCV: the background, names of channels,
// NPZ; and the figures of benchmarks, judged by NumPy.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "run_program.h"
#include "sample_files.h"
#include "test_folder.h"

namespace fathom::test {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

class WrittenMaps : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_.write("square.obj", square_obj);
    folder_.write("camera.json", square_camera);
  }

  Outcome fathom(const std::vector<std::string>& arguments) const {
    return run_fathom(arguments, {.folder = folder_.path()});
  }
  Outcome render(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{"render", "square.obj", "--camera", "camera.json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return fathom(arguments);
  }
  static void expect_done(const Outcome& outcome) {
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.err, "");
  }
  static void expect_refused(const Outcome& outcome, int status, const std::string& said) {
    EXPECT_EQ(outcome.status, status);
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(said));
  }
  /// What a script prints that has the pixels of the square as `inside`.
  std::string python_says(const std::string& script) const {
    const Outcome outcome = run({python, "-c",
                                 "import json, os\nimport numpy as np\n"
                                 "inside = np.zeros((6, 8), bool)\ninside[1:5, 2:6] = True\n" +
                                     script},
                                {.folder = folder_.path()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.out;
  }

  TestFolder folder_;
};

TEST_F(WrittenMaps, BackgroundIsWhatIsAskedFor) {
  expect_done(render({"--background", "0", "-o", "zero.npy"}));
  expect_done(render({"--background", "nan", "-o", "nan.pfm"}));
  expect_done(render({"--background", "inf", "-o", "inf.npy"}));
  expect_done(render({"--background", "-1.5", "--channels", "Z,distance,A", "-o", "minus.npz"}));
  expect_done(render({"--background", "0", "-o", "codes.png"}));
  python_says(R"(
def check(z, background):
    assert (z[inside] == 2).all() and np.array_equal(z[~inside], np.full(32, background), True), z
check(np.load('zero.npy'), 0)
check(np.load('inf.npy'), np.inf)
check(np.frombuffer(open('nan.pfm', 'rb').read()[-192:], '<f4').reshape(6, 8)[::-1], np.nan)
check(np.load('minus.npz')['Z'], -1.5)
distance = np.load('minus.npz')['distance']
assert (distance[~inside] == -1.5).all() and (distance[inside] > 2).all()
assert (np.load('minus.npz')['A'][~inside] == 0).all()
)");
}

TEST_F(WrittenMaps, BackgroundIsReadBack) {
  expect_done(render({"--channels", "Z,N", "-o", "plain.exr"}));
  for (const std::string background : {"0", "nan", "-1", "65504", "0.1"}) {
    for (const std::string name : {"map.exr", "map.npz"}) {
      expect_done(render({"--background", background, "--channels", "Z,N", "-o", name}));
      const Outcome compared = fathom({"compare", "plain.exr", name, "--json", "-"});
      EXPECT_EQ(compared.status, 0) << background << compared.err;
      const Json report = Json::parse(compared.out);
      for (const Json& channel : report["channels"]) EXPECT_EQ(channel["both"], 16) << background;
      const Json info = Json::parse(fathom({"info", name, "--json"}).out);
      EXPECT_EQ(info["channels"]["Z"]["surface_pixels"], 16) << background;
      EXPECT_EQ(info["channels"]["Z"]["min"], 2);
      expect_done(fathom({"convert", name, "-o", "cloud.ply"}));
      EXPECT_THAT(folder_.read("cloud.ply"), HasSubstr("element vertex 16\n"));
      expect_done(fathom({"convert", name, "-o", "codes.png"}));
      expect_done(
          fathom({"convert", name, "--channel", "Z", "--background", "inf", "-o", "back.npy"}));
      expect_done(fathom({"preview", name, "-o", "preview.png"}));
      python_says(R"(
z = np.load('back.npy')
assert (z[inside] == 2).all() and np.isposinf(z[~inside]).all()
)");
    }
  }
}

TEST_F(WrittenMaps, ABackgroundThatIsASurfaceNamesItsPixel) {
  expect_refused(render({"--background", "2", "-o", "map.exr"}), 4,
                 "map.exr: pixel (2, 1): a surface has the value 2 in channel 'Z'");
  expect_refused(render({"--background", "7", "-o", "map.png"}), 2, "always 0 in a .png");
  expect_refused(render({"--background", "far", "-o", "map.exr"}), 2, "'far' is not 0, nan, inf");
  expect_refused(render({"--background", "1e300", "-o", "map.exr"}), 2, "does not fit");
  expect_refused(render({"--background", "0,0,1", "-o", "map.exr"}), 2, "--engine pipeline");
  expect_refused(render({"--deep", "--background", "0", "-o", "map.exr"}), 2, "--background");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "map.exr"));
}

TEST_F(WrittenMaps, DisparityOfTheBackgroundIsZeroOrUnknown) {
  expect_done(render({"-o", "map.exr"}));
  const auto convert = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"convert",   "map.exr",    "--to",
                                       "disparity", "--baseline", "0.5"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return fathom(arguments);
  };
  expect_done(convert({"-o", "zero.npy"}));
  expect_done(convert({"--background", "inf", "-o", "unknown.npy"}));
  expect_done(convert({"-o", "disparity.exr"}));
  expect_refused(convert({"--doffs", "1", "-o", "ambiguous.npy"}), 4,
                 "a surface has the value 0 in channel 'disparity'");
  expect_done(fathom({"convert", "disparity.exr", "--from", "disparity", "--to", "Z", "--baseline",
                      "0.5", "-o", "back.exr"}));
  EXPECT_EQ(fathom({"compare", "map.exr", "back.exr"}).status, 0);
  python_says(R"(
for name, background in (('zero.npy', 0), ('unknown.npy', np.inf)):
    d = np.load(name)
    assert (d[inside] == 1).all() and (d[~inside] == background).all(), d
)");
}

TEST_F(WrittenMaps, OpenCvShowsTheDepth) {
  // `tests` of scripts/install-dependencies has it; elsewhere there may be none.
  if (run({python, "-c", "import cv2"}).status != 0)
    GTEST_SKIP() << "Python has no cv2: install python3-opencv";
  expect_done(render({"--channels", "Z", "--channel-name", "Z=Y", "-o", "y.exr"}));
  expect_done(render(
      {"--channels", "Z,id,N", "--background", "0", "--channel-name", "Z=Y", "-o", "all.exr"}));
  expect_done(render({"--channels", "Z", "-o", "z.exr"}));
  expect_done(render({"--background", "0", "-o", "z.png"}));
  expect_done(fathom({"convert", "z.exr", "--channel-name", "Z=Y", "-o", "converted.exr"}));
  python_says(R"(
os.environ['OPENCV_IO_ENABLE_OPENEXR'] = '1'
import cv2
for name, background in (('y.exr', np.inf), ('all.exr', 0), ('converted.exr', np.inf)):
    z = cv2.imread(name, cv2.IMREAD_UNCHANGED)
    assert z.dtype == np.float32 and z.shape == (6, 8), (name, z.dtype, z.shape)
    assert (z[inside] == 2).all() and (z[~inside] == background).all(), (name, z)
assert (cv2.imread('z.png', cv2.IMREAD_UNCHANGED)[inside] == 2000).all()
# Why the name has to be given: OpenCV does not know Z.
z = cv2.imread('z.exr', cv2.IMREAD_UNCHANGED)
assert z is None or not (z[inside] == 2).any()
)");
  for (const char* name : {"y.exr", "all.exr", "converted.exr"})
    EXPECT_EQ(fathom({"compare", "z.exr", name, "--channel", "Z"}).status, 0) << name;
}

TEST_F(WrittenMaps, NamesOfChannelsThatCannotBe) {
  expect_refused(render({"--channel-name", "id=Y", "-o", "m.exr"}), 2,
                 "--channel-name: the map has no channel 'id'");
  expect_refused(render({"--channel-name", "Z", "-o", "m.exr"}), 2, "as Z=Y is");
  expect_refused(render({"--channel-name", "Z=A", "-o", "m.exr"}), 2, "would be called 'A'");
  expect_refused(render({"--channel-name", "Z=Y", "-o", "m.pfm"}), 2, "is for .exr and .npz");
}

/// A square with a normal of its own at each corner, which nothing but channel Ns looks at.
TEST_F(WrittenMaps, ShadingNormalsAreThoseOfTheFile) {
  folder_.write("normals.obj",
                "v -1 -1 2\nv 1 -1 2\nv 1 1 2\nv -1 1 2\nvn 3 0 -4\n"
                "f 1//1 2//1 3//1 4//1\n");
  const auto rendered = [&](std::vector<std::string> more) {
    std::vector<std::string> command{"render", "normals.obj", "--camera", "camera.json"};
    command.insert(command.end(), more.begin(), more.end());
    return fathom(command);
  };
  expect_done(rendered({"--channels", "Ns,Nc", "-o", "file.npz"}));
  EXPECT_EQ(rendered({"--channels", "Ns,Nc", "-o", "again.npz", "--verify", "all"}).status, 0);
  expect_done(rendered({"--channels", "Ns", "--normals", "vertex", "-o", "vertex.npz"}));
  python_says(R"(
f, v = np.load('file.npz'), np.load('vertex.npz')
assert (f['Ns'][inside] == np.float32([0.6, 0, -0.8])).all() and (f['Ns'][~inside] == 0).all()
assert (f['Nc'][inside] == [0, 0, -1]).all()
assert (abs(v['Ns'][inside]) == [0, 0, 1]).all()
assert 'fathom.normals' not in json.loads(f['fathom'].item())
assert json.loads(v['fathom'].item())['fathom.normals'] == 'vertex'
)");
}

TEST_F(WrittenMaps, NumPyLoadsAllChannelsOfAnNpz) {
  expect_done(render({"--channels", "Z,A,id,N,P,bary", "--dtype", "float64", "-o", "map.npz"}));
  expect_done(render({"--channels", "Z,A,id,N,P,bary", "-o", "map.exr"}));
  expect_done(render({"--channels", "N", "-o", "n.npy"}));
  expect_done(render({"--channels", "bary", "-o", "bary.npy"}));
  expect_done(fathom({"convert", "map.exr", "--channel", "P", "-o", "p.npy"}));
  expect_done(fathom({"convert", "map.exr", "-o", "converted.npz"}));
  expect_done(fathom({"convert", "map.npz", "-o", "back.exr", "--channel", "Z"}));
  python_says(R"(
a = np.load('map.npz')
assert {k: (a[k].dtype.str, a[k].shape) for k in a if k != 'fathom'} == {
    'Z': ('<f8', (6, 8)), 'A': ('<f4', (6, 8)), 'id': ('<u4', (6, 8)), 'N': ('<f4', (6, 8, 3)),
    'P': ('<f4', (6, 8, 3)), 'bary': ('<f4', (6, 8, 2))}
assert (a['Z'][inside] == 2).all() and np.isposinf(a['Z'][~inside]).all()
assert (a['N'][inside] == [0, 0, -1]).all() and (a['N'][~inside] == 0).all()
assert (a['P'][inside][:, 2] == 2).all() and np.isnan(a['P'][~inside]).all()
camera = json.loads(json.loads(a['fathom'].item())['fathom.camera'])
assert (camera['width'], camera['fx']) == (8, 4)
assert np.array_equal(np.load('n.npy'), a['N'])
assert np.array_equal(np.load('bary.npy'), a['bary'], True)
assert np.array_equal(np.load('p.npy'), a['P'], True)
c = np.load('converted.npz')
assert c['Z'].dtype == np.float32 and np.array_equal(c['N'], a['N'])
)");
  const Outcome same = fathom({"compare", "map.exr", "converted.npz", "--json", "-"});
  EXPECT_EQ(same.status, 0);
  EXPECT_EQ(Json::parse(same.out)["channels"].size(), 11u);
  EXPECT_EQ(fathom({"compare", "map.exr", "map.npz"}).status, 0);
  // The camera comes along: a cloud needs no other.
  expect_done(fathom({"convert", "map.npz", "-o", "cloud.ply"}));
  expect_refused(render({"--channels", "Z,N", "-o", "two.npy"}), 2, ".exr and .npz hold them all");
}

TEST_F(WrittenMaps, MetricsAreThoseOfNumPy) {
  const std::string expected = python_says(R"(
random = np.random.default_rng(20261125)
t = random.uniform(0.5, 80, (37, 53)).astype('f4')
d = (t * np.exp(random.normal(0, 0.3, t.shape))).astype('f4')
t[random.random(t.shape) < 0.2] = np.inf
d[random.random(t.shape) < 0.1] = np.nan
np.save('t.npy', t); np.save('d.npy', d)
np.savez('t.npz', disparity=t); np.savez('d.npz', disparity=d)
seen = np.isfinite(t) & np.isfinite(d)
t, d = t[seen].astype('f8'), d[seen].astype('f8')
ratio = np.maximum(t / d, d / t)
difference = np.abs(d - t)
print(json.dumps({
    'depth': {'pixels': int(seen.sum()), 'left_out': 0,
        'abs_rel': (difference / t).mean(), 'sq_rel': (difference**2 / t).mean(),
        'rmse': np.sqrt((difference**2).mean()),
        'rmse_log': np.sqrt(((np.log(d) - np.log(t))**2).mean()), 'mae': difference.mean(),
        'delta_1': (ratio < 1.25).mean(), 'delta_2': (ratio < 1.25**2).mean(),
        'delta_3': (ratio < 1.25**3).mean()},
    'disparity': {'pixels': int(seen.sum()), 'left_out': 0, 'epe': difference.mean(),
        'rmse': np.sqrt((difference**2).mean()), 'bad_0_5': (difference > 0.5).mean(),
        'bad_1': (difference > 1).mean(), 'bad_2': (difference > 2).mean()},
    'within': {'absolute': int((difference <= 1.5).sum()),
        'relative': int((difference / np.maximum(t, d) <= 0.1).sum()),
        'either': int(((difference <= 1.5) | (difference / np.maximum(t, d) <= 0.1)).sum())}}))
)");
  const Json numpy = Json::parse(expected);
  const auto compared = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "compare");
    arguments.insert(arguments.end(), {"--json", "-"});
    return Json::parse(fathom(arguments).out)["channels"][0];
  };
  // NumPy adds pairwise and we from the left: 1,500 sums of one sign are off by 1500·2⁻⁵³ at most.
  const auto expect_same = [](const Json& ours, const Json& theirs) {
    ASSERT_EQ(ours.size(), theirs.size());
    for (const auto& [name, value] : theirs.items())
      EXPECT_NEAR(ours[name].get<double>(), value.get<double>(), 4e-13 * value.get<double>())
          << name;
  };
  expect_same(compared({"t.npy", "d.npy", "--metrics"})["metrics"], numpy["depth"]);
  expect_same(compared({"t.npz", "d.npz", "--metrics"})["disparity_metrics"], numpy["disparity"]);
  expect_same(compared({"t.npy", "d.npy", "--disparity-metrics"})["disparity_metrics"],
              numpy["disparity"]);
  EXPECT_FALSE(compared({"t.npy", "d.npy"}).contains("metrics"));
  const auto within = [&](const std::vector<std::string>& tolerances) {
    std::vector<std::string> arguments{"t.npy", "d.npy"};
    arguments.insert(arguments.end(), tolerances.begin(), tolerances.end());
    const Json channel = compared(arguments);
    return channel["both"].get<int>() - channel["beyond_tolerance"].get<int>();
  };
  EXPECT_EQ(within({"--absolute", "1.5"}), numpy["within"]["absolute"]);
  EXPECT_EQ(within({"--relative", "0.1"}), numpy["within"]["relative"]);
  EXPECT_EQ(within({"--absolute", "1.5", "--relative", "0.1"}), numpy["within"]["either"]);
  EXPECT_THAT(fathom({"compare", "t.npy", "d.npy", "--metrics"}).out, HasSubstr("AbsRel 0.2"));
  EXPECT_THAT(fathom({"compare", "t.npy", "t.npy", "--absolute", "1", "--relative", "0.5"}).out,
              HasSubstr("agree within 1 absolute or 0.5 relative\n"));
  expect_refused(fathom({"compare", "t.npy", "d.npy", "--absolute", "-1"}), 2, "is negative");
}

}  // namespace
}  // namespace fathom::test
