// render --deep, render --cryptomatte, visible and coplanar; OpenImageIO reads the maps.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "run_program.h"
#include "test_folder.h"
#include "tests/places.h"

namespace fathom::test {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

const std::string meshes = source_dir() / "data/meshes/";

class Surfaces : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_.write("cubes.json", R"({"meshes": [{"file": ")" + meshes + R"(cube.obj", "name": "one"},
      {"file": ")" + meshes + R"(cube.obj", "name": "two",
       "transform": [[0.75, 0.25, 0.5, 0.625], [-0.25, 1, 0.375, 0.5],
                     [-0.5, 0.125, 0.75, 0.25]]}]})");
  }
  std::string answer(const std::vector<std::string>& arguments) const {
    const Outcome outcome = run_fathom(arguments, {.folder = folder_.path()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.out;
  }
  /// Renders two cubes that go through each other.
  void render(const std::string& map, std::vector<std::string> more) const {
    more.insert(more.begin(), {"render", "cubes.json", "--size", "72x54", "-o", map});
    answer(more);
  }
  void run_python(const std::string& script) const {
    const Outcome outcome = run({python, "-c", script}, {.folder = folder_.path()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
  }

  TestFolder folder_;
};

const std::string reading = R"(
import numpy as np
import OpenImageIO as oiio
def channels_of(name):
    image = oiio.ImageInput.open(name)
    spec = image.spec()
    def channel(c, kind=oiio.FLOAT):
        i = list(spec.channelnames).index(c)
        return np.asarray(image.read_image(0, 0, i, i + 1, kind)).reshape(spec.height, spec.width)
    return spec, channel
)";

// "Over" is 1-Lipschitz in every alpha, and each is rounded once, to an error of 2⁻²⁵; flattening
// n samples in binary32 makes at most four roundings of numbers up to 1 for each. So the flattened
// alpha lies within (5n + 1)·2⁻²⁵ of the coverage, which is rounded itself.
TEST_F(Surfaces, DeepMapsFlattenToTheCoverage) {
  render("flat.exr", {"--channels", "Z,A,id"});
  render("deep.exr", {"--deep"});
  run_python(reading + R"(
spec, flat = channels_of('flat.exr')
A, Z, ids = flat('A'), flat('Z'), flat('id', oiio.UINT)
image = oiio.ImageInput.open('deep.exr')
assert image.spec().deep
names = list(image.spec().channelnames)
assert sorted(names) == ['A', 'Z', 'ZBack', 'area', 'id']
deep = image.read_native_deep_image()
flattened = oiio.ImageBuf()
assert oiio.ImageBufAlgo.flatten(flattened, oiio.ImageBuf('deep.exr'))
alpha = flattened.get_pixels(oiio.FLOAT)[:, :, list(flattened.spec().channelnames).index('A')]
several = inner = 0
for y in range(spec.height):
    for x in range(spec.width):
        pixel = y * spec.width + x
        n = deep.samples(pixel)
        def value(c, s):
            return deep.deep_value(pixel, names.index(c), s)
        samples = [tuple(value(c, s) for c in ('Z', 'ZBack', 'area', 'A')) +
                   (deep.deep_value_uint(pixel, names.index('id'), s),) for s in range(n)]
        assert samples == sorted(samples, key=lambda s: (s[0], s[1], s[4]))
        assert all(s[0] <= s[1] and 0 < s[2] <= 1 and 0 < s[3] <= 1 for s in samples)
        assert abs(sum(s[2] for s in samples) - A[y, x]) <= (n + 1) * 2**-25
        assert abs(alpha[y, x] - A[y, x]) <= (5 * n + 1) * 2**-25
        assert (n == 0) == (A[y, x] == 0)
        # The surface at the centre is one of them.
        if ids[y, x] != 0xFFFFFFFF:
            at_centre = [s for s in samples if s[4] == ids[y, x]]
            assert len(at_centre) == 1 and at_centre[0][0] <= Z[y, x] <= at_centre[0][1]
        several += n > 1
        inner += n == 1 and A[y, x] == 1
assert several > 100 and inner > 300, (several, inner)
)");
}

TEST_F(Surfaces, DeepMapsSayThatTheyAreSorted) {
  render("deep.exr", {"--deep", "--compression", "rle"});
  const Outcome header = run({"exrheader", folder_ / "deep.exr"});
  EXPECT_THAT(header.out, HasSubstr("deepImageState"));
  EXPECT_THAT(header.out, HasSubstr("fathom.camera"));
}

// The shares of a pixel are rounded once each, and so is A: their sum lies within (n + 1)·2⁻²⁵.
TEST_F(Surfaces, MattesAddUpToTheCoverage) {
  render("map.exr", {"--channels", "A,object", "--cryptomatte"});
  run_python(reading + R"(
import json
spec, channel = channels_of('map.exr')
key = [a.name for a in spec.extra_attribs if a.name.endswith('/manifest')]
assert len(key) == 1 and key[0].startswith('cryptomatte/')
key = key[0][:-len('/manifest')]
assert spec.getattribute(key + '/name') == 'CryptoObject'
assert spec.getattribute(key + '/hash') == 'MurmurHash3_32'
assert spec.getattribute(key + '/conversion') == 'uint32_to_float32'
manifest = json.loads(spec.getattribute(key + '/manifest'))
assert sorted(manifest) == ['one', 'two'], manifest
known = {int(h, 16): name for name, h in manifest.items()}
ids, shares = [], []
for level in range(3):
    for i, c in (('R', 'G'), ('B', 'A')):
        ids.append(channel('CryptoObject%02d.%s' % (level, i)).view(np.uint32))
        shares.append(channel('CryptoObject%02d.%s' % (level, c)).astype(np.float64))
ids, shares = np.array(ids), np.array(shares)
assert ((ids == 0) == (shares == 0)).all()
assert set(np.unique(ids)) == {0} | set(known)
assert (np.diff(shares, axis=0) <= 0).all()
assert (abs(shares.sum(axis=0) - channel('A')) <= 3 * 2**-25).all()
assert ((shares > 0).sum(axis=0) == 2).sum() > 20
# Where one object covers a pixel, it is the object at the centre.
objects = channel('object', oiio.UINT)
whole = shares[0] == 1
assert whole.sum() > 100
for i in np.argwhere(whole):
    assert known[int(ids[0][tuple(i)])] == ['one', 'two'][objects[tuple(i)]]
)");
}

TEST_F(Surfaces, VisibleTellsAreasAsJsonAndCsv) {
  folder_.write("two.obj",
                "v -1 -1 2\nv 1 -1 2\nv 1 1 2\nv -1 1 2\nf 1 2 3 4\n"
                "v 0 -1 1\nv 1 -1 1\nv 1 1 1\nv 0 1 1\nf 5 6 7 8\n");
  folder_.write("camera.json", R"({"width": 8, "height": 6, "projection": "orthographic",
    "fx": 1, "fy": 1, "cx": 4, "cy": 3, "pixel_centre": 0.5,
    "world_to_camera": [[1,0,0,0],[0,1,0,0],[0,0,1,0]]})");
  const Json json =
      Json::parse(answer({"visible", "two.obj", "--camera", "camera.json", "--json"}));
  EXPECT_EQ(json["objects"][0]["visible"], 4.0);
  EXPECT_EQ(json["objects"][0]["ratio"], 1.0);
  // The far square's corners (−1, −1), (1, −1), (1, 1) and (−1, −1), (1, 1), (−1, 1); u ≥ 0 is
  // hidden.
  EXPECT_EQ(json["triangles"][0]["unoccluded"], 2.0);
  EXPECT_EQ(json["triangles"][0]["visible"], 0.5);
  EXPECT_EQ(json["triangles"][1]["visible"], 1.5);
  EXPECT_EQ(json["triangles"][2]["ratio"], 1.0);
  const std::string csv = answer({"visible", "two.obj", "--camera", "camera.json", "--csv"});
  EXPECT_THAT(csv, HasSubstr("object,0,0,\"two\",,4,4,1\n"));
  EXPECT_THAT(csv, HasSubstr("triangle,1,0,\"two\",0,1.5,2,0.75\n"));
  EXPECT_THAT(answer({"visible", "two.obj", "--camera", "camera.json"}),
              HasSubstr("4 triangles: 2 visible, 2 partly, 0 hidden"));
}

TEST_F(Surfaces, CoplanarTellsWhatLiesCloseBehind) {
  folder_.write("two.obj",
                "v -1 -1 2\nv 1 -1 2\nv 1 1 2\nf 1 2 3\n"
                "v -1 -1 2.25\nv 1 -1 2.25\nv 1 1 2.25\nf 4 5 6\n");
  folder_.write("camera.json", R"({"width": 8, "height": 6, "projection": "orthographic",
    "fx": 1, "fy": 1, "cx": 4, "cy": 3, "pixel_centre": 0.5,
    "world_to_camera": [[1,0,0,0],[0,1,0,0],[0,0,1,0]]})");
  const std::vector<std::string> coplanar{"coplanar", "two.obj", "--camera", "camera.json"};
  EXPECT_EQ(answer(coplanar), "0 coplanar pairs within 0\n");
  // Roundings of decimals move planes apart: the answer names the nearest pair.
  folder_.write("decal.obj",
                "v -1 -1 2\nv 1 -1 2\nv 1 1 2\nf 1 2 3\nv -1 -1 2.0000019073486328125\n"
                "v 1 -1 2.0000019073486328125\nv 1 1 2.0000019073486328125\nf 4 5 6\n");
  EXPECT_EQ(
      answer({"coplanar", "decal.obj", "--camera", "camera.json"}),
      "0 coplanar pairs within 0\nnearest pair: triangle 0 (face 0 of decal) before triangle 1 "
      "(face 1 of decal), least distance 1.9073486328125e-06; --within 3e-05 finds 1 pair\n");
  std::vector<std::string> within = coplanar;
  within.insert(within.end(), {"--within", "0.25"});
  EXPECT_EQ(answer(within),
            "triangle 0 (face 0 of two) before triangle 1 (face 1 of two): least distance 0.25, 3 "
            "pixels, columns 3 to 4, "
            "rows 2 to 3\n1 coplanar pair within 0.25\n");
  within.push_back("--json");
  const Json json = Json::parse(answer(within));
  EXPECT_EQ(json["pairs"][0]["separation"], 0.25);
  EXPECT_EQ(json["pairs"][0]["behind"]["face"], 1);
}

TEST_F(Surfaces, CoplanarPairsOfMostPixelsComeFirst) {
  folder_.write("four.obj",
                "v -3 -2 2\nv -2 -2 2\nv -2 -1 2\nf 1 2 3\n"
                "v -3 -2 2\nv -2 -2 2\nv -2 -1 2\nf 4 5 6\n"
                "v -1 -1 2\nv 2 -1 2\nv 2 2 2\nf 7 8 9\n"
                "v -1 -1 2.5\nv 2 -1 2.5\nv 2 2 2.5\nf 10 11 12\n"
                "v -3 1 2\nv -2 1 2\nv -2 2 2\nf 13 14 15\n"
                "v -3 1 2.25\nv -2 1 2.25\nv -2 2 2.25\nf 16 17 18\n");
  folder_.write("camera.json", R"({"width": 8, "height": 6, "projection": "orthographic",
    "fx": 1, "fy": 1, "cx": 4, "cy": 3, "pixel_centre": 0.5,
    "world_to_camera": [[1,0,0,0],[0,1,0,0],[0,0,1,0]]})");
  const Json pairs = Json::parse(answer(
      {"coplanar", "four.obj", "--camera", "camera.json", "--within", "0.5", "--json"}))["pairs"];
  std::vector<std::pair<int, double>> found;
  for (const Json& pair : pairs) found.emplace_back(pair["pixels"], pair["separation"]);
  using Pairs = std::vector<std::pair<int, double>>;
  EXPECT_EQ(found, (Pairs{{6, 0.5}, {1, 0.25}}));
}

}  // namespace
}  // namespace fathom::test
