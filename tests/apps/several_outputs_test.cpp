// Several files from one run of `fathom render`: each has the bytes that a run of its own gives.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "run_program.h"
#include "sample_files.h"
#include "test_folder.h"
#include "tests/places.h"

namespace fathom::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class SeveralOutputs : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_.write("square.obj", square_obj);
    folder_.write("camera.json", square_camera);
    expect_done({"camera", "orbit", pair_, "--views", "2", "--size", "60x40", "-o", "path.json"});
  }

  Outcome fathom(const std::vector<std::string>& arguments) const {
    return run_fathom(arguments, {.folder = folder_.path()});
  }
  void expect_done(const std::vector<std::string>& arguments) const {
    const Outcome outcome = fathom(arguments);
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.err, "");
  }
  void expect_refused(const std::vector<std::string>& more, const std::string& said) const {
    std::vector<std::string> arguments{"render", "square.obj", "--camera", "camera.json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = fathom(arguments);
    EXPECT_EQ(outcome.status, 2) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(said));
  }
  void run_python(const std::string& script) const {
    const Outcome outcome = run({python, "-c", script}, {.folder = folder_.path()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
  }

  const std::string pair_ = source_dir() / "data/scenes/pair.json";
  TestFolder folder_;
};

TEST_F(SeveralOutputs, AreThoseOfRunsOfTheirOwn) {
  const std::vector<std::string> views{"render", pair_, "--camera", "path.json"};
  std::vector<std::string> together = views;
  struct Output {
    std::string names, file;
    /// Of --channels, and the options that the format has.
    std::vector<std::string> alone;
  };
  const std::vector<Output> outputs{
      {"normal", "n{index}.png", {"--channels", "N", "--normal-bits", "16"}},
      {"depth", "z{index}.png", {"--channels", "Z", "--png-scale", "500"}},
      {"mask", "m{index}.png", {"--channels", "mask"}},
      {"camera-normal", "c{index}.npy", {"--channels", "Nc", "--dtype", "float64"}},
      {"segmentation", "s{index}.png", {"--channels", "object"}},
      {"Z,id,N", "e{index}.exr", {"--channels", "Z,id,N", "--background", "0"}},
      {"distance",
       "d{index}.npy",
       {"--channels", "distance", "--dtype", "float64", "--background", "0"}},
      {"", "all{index}.npz", {"--channels", "Z,A", "--dtype", "float64", "--background", "0"}},
  };
  for (const Output& output : outputs) {
    const std::string names = output.names.empty() ? "" : output.names + "=";
    together.insert(together.end(), {"-o", names + "together/" + output.file});
    std::vector<std::string> alone = views;
    alone.insert(alone.end(), output.alone.begin(), output.alone.end());
    alone.insert(alone.end(), {"-o", "alone/" + output.file});
    expect_done(alone);
  }
  together.insert(together.end(),
                  {"--png-scale", "500", "--normal-bits", "16", "--dtype", "float64",
                   "--background", "0", "--stats", "stats.json", "--verify", "20"});
  EXPECT_EQ(fathom(together).status, 0);
  for (const Output& output : outputs) {
    for (const char* index : {"0", "1"}) {
      std::string file = output.file;
      file.replace(file.find("{index}"), 7, index);
      EXPECT_TRUE(folder_.read("together/" + file) == folder_.read("alone/" + file)) << file;
    }
  }
  // Codes, binary32 and binary64 are rounded once each, so a view is rendered three times.
  EXPECT_EQ(nlohmann::json::parse(folder_.read("stats.json")).size(), 6u);
}

TEST_F(SeveralOutputs, WithOneTypeOfDepthRenderEachViewOnce) {
  expect_done({"render", pair_, "--camera", "path.json", "-o", "depth=z{index}.png", "-o",
               "mask=m{index}.png", "-o", "normal=n{index}.png", "-o", "id=i{index}.exr", "--stats",
               "stats.json"});
  EXPECT_EQ(nlohmann::json::parse(folder_.read("stats.json")).size(), 2u);
}

TEST_F(SeveralOutputs, OfALensHaveTheDefaultChannelsOfRunsOfTheirOwn) {
  folder_.write("lens.json", camera_with("model", R"("FISHEYE_STEREOGRAPHIC")"));
  const std::vector<std::string> view{"render", "square.obj", "--camera", "lens.json"};
  const auto expect_rendered = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = view;
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_done(arguments);
  };
  expect_rendered({"-o", "alone.exr", "--stats", "alone.json"});
  expect_rendered({"--channels", "mask", "-o", "alone.png"});
  // The first has fewer channels than the second, and the third requests its own.
  expect_rendered({"-o", "first.pfm", "-o", "second.exr", "-o", "mask=third.png"});
  EXPECT_TRUE(folder_.read("second.exr") == folder_.read("alone.exr"));
  EXPECT_TRUE(folder_.read("third.png") == folder_.read("alone.png"));
  EXPECT_THAT(fathom({"info", "second.exr"}).out, HasSubstr("distance"));
  EXPECT_EQ(nlohmann::json::parse(folder_.read("alone.json"))["engine"], "fast");
}

TEST_F(SeveralOutputs, OfALensAreRefusedBeforeTheRenderingWhereEdgesMustBeStraight) {
  folder_.write("lens.json", camera_with("model", R"("FISHEYE_STEREOGRAPHIC")"));
  const auto refused = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"render", "square.obj", "--camera", "lens.json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = fathom(arguments);
    EXPECT_EQ(outcome.status, 2);
    return outcome.err;
  };
  EXPECT_THAT(refused({"-o", "a.exr", "--samples", "4"}), HasSubstr("edges are straight"));
  EXPECT_THAT(refused({"-o", "a.exr", "--cryptomatte"}), HasSubstr("edges are straight"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.exr"));
}

TEST_F(SeveralOutputs, HaveNoCountsNamesAndTextsOfTheOthers) {
  folder_.write("named.obj", "usemtl red\n" + square_obj);
  const std::vector<std::string> coded{"--png-scale", "31900", "--png-beyond", "none"};
  const auto rendered = [&](const std::vector<std::string>& outputs,
                            const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"render", "named.obj", "--camera", "camera.json"};
    arguments.insert(arguments.end(), outputs.begin(), outputs.end());
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = fathom(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.err;
  };
  // At this scale all depths have codes, and the distances of the outer pixels have none.
  const std::string said = rendered(
      {"-o", "depth=z.png", "-o", "distance=d.png", "-o", "mask=m.png", "-o", "object=o.png"},
      coded);
  EXPECT_THAT(said, HasSubstr("d.png: 12 of 48 pixels lie deeper"));
  for (const char* file : {"z.png", "m.png", "o.png"}) EXPECT_THAT(said, Not(HasSubstr(file)));
  EXPECT_EQ(rendered({"-o", "depth=alone.png"}, coded), "");
  EXPECT_TRUE(folder_.read("z.png") == folder_.read("alone.png"));
  // Names of materials and the source of Ns belong to the outputs with these channels.
  rendered({"-o", "id=i.exr", "-o", "material,Ns=ns.exr"}, {"--normals", "vertex"});
  rendered({"-o", "id=alone.exr"}, {});
  EXPECT_TRUE(folder_.read("i.exr") == folder_.read("alone.exr"));
  rendered({"-o", "material,Ns=alone.exr"}, {"--normals", "vertex"});
  EXPECT_TRUE(folder_.read("ns.exr") == folder_.read("alone.exr"));
}

TEST_F(SeveralOutputs, ApplyOptionsOrRefuseThem) {
  expect_refused({"-o", "depth=z.png", "-o", "mask=m.png", "--background", "nan"},
                 "--background: it is always 0 in a .png, which z.png is");
  expect_refused({"-o", "depth=z.exr", "-o", "N=n.exr", "--channel-name", "id=Y"},
                 "--channel-name: no .exr or .npz of the outputs has a channel 'id'");
  expect_refused({"-o", "depth=z.pfm", "-o", "N=n.exr", "--channel-name", "Z=Y"},
                 "no .exr or .npz of the outputs has a channel 'Z'");
  expect_refused({"-o", "mask=m.png", "-o", "normal=n.png", "--png-sidecar"},
                 "--png-sidecar is for depths and numbers");
  // A name applies to the outputs that have the channel, also next to one with the default
  // channels.
  const std::vector<std::string> view{"--camera", "camera.json", "--channel-name", "N.X=Y"};
  expect_done(
      {"render", "square.obj", "-o", "z.exr", "-o", "N=n.exr", view[0], view[1], view[2], view[3]});
  expect_done({"render", "square.obj", "-o", "N=alone.exr", view[0], view[1], view[2], view[3]});
  EXPECT_TRUE(folder_.read("n.exr") == folder_.read("alone.exr"));
}

TEST_F(SeveralOutputs, ConvertRefusesTheOptionsThatRenderRefuses) {
  expect_done(
      {"render", "square.obj", "--camera", "camera.json", "--channels", "Z,id,N", "-o", "map.exr"});
  const auto refused = [&](const std::string& channel, const std::vector<std::string>& more,
                           const std::string& said) {
    std::vector<std::string> arguments{"convert", "map.exr", "--channel", channel, "-o", "c.png"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = fathom(arguments);
    EXPECT_EQ(outcome.status, 2) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(said));
  };
  refused("mask", {"--png-sidecar"}, "--png-sidecar is for depths and numbers");
  refused("mask", {"--normal-bits", "8"}, "are for a PNG of N, Nc or Ns");
  refused("mask", {"--from", "Z"}, "--to and --from do not go with a mask");
  refused("Z", {"--normal-bits", "8"}, "are for a PNG of N, Nc or Ns");
  refused("N", {"--png-sidecar"}, "--png-sidecar is for depths and numbers");
  refused("N", {"--normal-axes", "opengl"}, "--normal-axes opengl is for Nc");
  expect_done({"convert", "map.exr", "--channel", "mask", "-o", "m.png"});
  const Outcome again = fathom({"convert", "m.png", "-o", "c.png", "--png-sidecar"});
  EXPECT_THAT(again.err, HasSubstr("--png-sidecar is for depths and numbers"));
  EXPECT_THAT(folder_.names(), Not(::testing::Contains("c.png")));
}

TEST_F(SeveralOutputs, MasksAreEightBitsAndNormalsColours) {
  expect_done({"render", "square.obj", "--camera", "camera.json", "-o", "mask=m.png", "-o",
               "normal=n.png", "-o", "camera-normal=gl.png", "--normal-axes", "opengl"});
  run_python(R"(
import numpy as np
import OpenImageIO as oiio
def read(name):
    file = oiio.ImageInput.open(name)
    assert str(file.spec().format) == 'uint8', file.spec().format
    return file.read_image('uint8')
inside = np.zeros((6, 8), bool)
inside[1:5, 2:6] = True
mask, normal, turned = read('m.png'), read('n.png'), read('gl.png')
assert mask.shape == (6, 8, 1) and (mask[..., 0] == np.where(inside, 255, 0)).all()
# The square faces the camera: (0, 0, -1) is (127.5, 127.5, 0), half to even.
assert normal.shape == (6, 8, 3)
assert (normal[inside] == (128, 128, 0)).all() and (normal[~inside] == 0).all()
# With OpenGL's axes it is (0, 0, 1).
assert (turned[inside] == (128, 128, 255)).all() and (turned[~inside] == 0).all()
)");
  // Both are read back.
  expect_done({"convert", "m.png", "-o", "again.png"});
  EXPECT_TRUE(folder_.read("again.png") == folder_.read("m.png"));
  expect_done({"convert", "n.png", "-o", "again.png"});
  EXPECT_TRUE(folder_.read("again.png") == folder_.read("n.png"));
  for (const char* file : {"m.png", "n.png"}) expect_done({"info", file});
  // A map has the same mask and normals.
  expect_done(
      {"render", "square.obj", "--camera", "camera.json", "--channels", "id", "-o", "map.exr"});
  expect_done({"convert", "map.exr", "--channel", "mask", "-o", "again.png"});
  EXPECT_TRUE(folder_.read("again.png") == folder_.read("m.png"));
}

TEST_F(SeveralOutputs, ChannelsMayListWhatOutputsName) {
  const auto render = [this](std::vector<std::string> more) {
    more.insert(more.begin(), {"render", "square.obj", "--camera", "camera.json"});
    expect_done(more);
  };
  const auto expect_same = [this](const std::string& a, const std::string& b) {
    EXPECT_TRUE(folder_.read(a) == folder_.read(b)) << a << ", " << b;
  };
  render({"-o", "mask=m.png", "-o", "depth=z.exr"});
  render({"--channels", "Z,mask", "-o", "mask=listed-m.png", "-o", "depth=listed-z.exr"});
  expect_same("listed-m.png", "m.png");
  expect_same("listed-z.exr", "z.exr");
  // An output without names has the channels of the list, and no mask.
  render({"--channels", "Z,id", "-o", "e.exr"});
  render({"--channels", "Z,mask,id", "-o", "listed-e.exr", "-o", "mask=m2.png"});
  expect_same("listed-e.exr", "e.exr");
  expect_same("m2.png", "m.png");
  render({"--channels", "mask", "-o", "mask=m3.png"});
  expect_same("m3.png", "m.png");
  render({"--channels", "depth", "-o", "Z,id=e2.exr"});
  expect_same("e2.exr", "e.exr");
}

TEST_F(SeveralOutputs, AMaskForEachObject) {
  expect_done({"render", pair_, "--size", "60x40", "-o", "mask=m/{object:02}.png", "-o",
               "object=objects.npy"});
  run_python(R"(
import numpy as np
import OpenImageIO as oiio
objects = np.load('objects.npy')
assert set(np.unique(objects)) == {0, 1, 0xFFFFFFFF}
for k in (0, 1):
    mask = oiio.ImageInput.open(f'm/{k:02}.png').read_image('uint8')[..., 0]
    assert (mask == np.where(objects == k, 255, 0)).all() and mask.any()
)");
  expect_refused({"-o", "depth=z-{object}.png"}, "there is no field '{object}'");
}

TEST_F(SeveralOutputs, NamesThatCannotBe) {
  expect_refused({"-o", "dpeth=z.png"}, "did you mean 'depth'?; a file of this name is");
  expect_refused({"-o", "mask=m.exr"}, "m.exr: a mask is an 8-bit PNG");
  expect_refused(
      {"-o", "mask,Z=m.png"},
      "'mask' needs a separate file: add -o mask=FILE.png, and leave it out of the list");
  expect_refused({"-o", "depth="}, "'depth=' has no file");
  expect_refused({"-o", "depth=a.png", "-o", "mask=a.png"}, "would both be written as a.png");
  const std::string no_mask = "--channels: 'mask' needs a separate file: add -o mask=FILE.png\n";
  expect_refused({"-o", "z.exr", "--channels", "Z,mask"}, no_mask);
  expect_refused({"-o", "depth=z.exr", "--channels", "mask,Z"}, no_mask);
  expect_refused({"-o", "depth=z.exr", "--channels", "mask"}, no_mask);
  expect_refused({"-o", "depth=a.png", "-o", "mask=b.png", "--channels", "Z,normal"},
                 "--channels: 'N' is in no output: add -o N=FILE");
  expect_refused({"-o", "mask=a.png", "--channels", "id"}, "'id' is in no output");
  expect_refused({"-o", "mask=a.png", "--channels", "mask,Z,mask"}, "'mask' is there twice");
  expect_refused({"-o", "z.exr", "--engine", "pipeline", "--channels", "Z,mask"}, no_mask);
  expect_refused({"-o", "depth=a.png", "-o", "mask=b.png", "--compression", "rle"},
                 "--compression is for .exr");
  expect_refused({"-o", "a.exr", "-o", "b.exr", "--samples", "4"}, "--samples is for a single -o");
  expect_refused({"-o", "a.exr", "-o", "b.exr", "--deep"}, "--deep is for a single -o");
  expect_refused({"-o", "normal=n.png", "--normal-axes", "opengl"},
                 "--normal-axes opengl is for Nc");
  expect_refused({"-o", "z.png", "--normal-bits", "8"}, "are for a PNG of N, Nc or Ns");
  expect_refused({"-o", "a.png", "-o", "mask=b.png", "--normal-bits", "8"},
                 "--normal-bits is for a PNG of N, Nc or Ns, and no output is one");
  expect_refused({"-o", "normal=a.png", "-o", "mask=b.png", "--normal-axes", "opengl"},
                 "--normal-axes is for a PNG of Nc, and no output is one");
  expect_refused({"-o", "mask=m.png", "--png-sidecar"}, "--png-sidecar is for depths and numbers");
  // Other names with "=" are files, as before.
  expect_done({"render", "square.obj", "--camera", "camera.json", "-o", "run=3.exr"});
  expect_done({"render", "square.obj", "--camera", "camera.json", "-o", "./depth=3.exr"});
  EXPECT_THAT(folder_.names(), ::testing::IsSupersetOf({"depth=3.exr", "run=3.exr"}));
}

TEST_F(SeveralOutputs, AFirstExrAndALensHaveHintsOnATerminal) {
  expect_done({"camera", "look-at", "--eye", "0,0,4", "--size", "16x12", "--model", "SIMPLE_RADIAL",
               "--distortion", "-0.05", "-o", "lens.json"});
  run_python("program = '" + program_path() + "'\n" + R"(
import os, pty, subprocess
def told(*arguments, camera='camera.json'):
    master, slave = pty.openpty()
    command = [program, 'render', 'square.obj', '--camera', camera, *arguments]
    subprocess.run(command, stderr=slave, check=True)
    os.close(slave)
    os.set_blocking(master, False)
    try:
        return os.read(master, 65536).decode()
    except OSError:
        return ''
assert '--channel-name Z=Y' in told('-o', 'a/z.exr')
assert told('-o', 'a/again.exr') == ''
assert told('-o', 'b/z.npy') == ''
assert told('-o', 'b/n.exr', '--channels', 'N') == ''
assert told('-o', 'c/y.exr', '--channel-name', 'Z=Y') == ''
assert told('-o', 'd/z.exr', '--quiet') == ''
assert '--channels Z,P' in told('-o', 'b/z.npz', camera='lens.json')
assert told('-o', 'b/z.npz', '--channels', 'Z,P', camera='lens.json') == ''
assert told('-o', 'b/z.npz') == ''
)");
}

TEST_F(SeveralOutputs, MapsBecomeOneCloud) {
  expect_done(
      {"render", pair_, "--camera", "path.json", "--channels", "Z,id,N", "-o", "{index}.exr"});
  expect_done({"convert", "0.exr", "1.exr", "-o", "all.ply"});
  expect_done({"convert", "0.exr", "1.exr", "--camera", "path.json", "-o", "again.ply"});
  EXPECT_TRUE(folder_.read("again.ply") == folder_.read("all.ply"));
  for (const char* index : {"0", "1"}) {
    expect_done({"convert", std::string(index) + ".exr", "-o", std::string(index) + ".ply"});
  }
  run_python(R"(
import numpy as np
def read(name):
    header, body = open(name, 'rb').read().split(b'end_header\n', 1)
    types = {'double': '<f8', 'float': '<f4', 'uint': '<u4'}
    fields = [line.split()[1:] for line in header.decode().splitlines()
              if line.startswith('property')]
    return np.frombuffer(body, [(n, types[t]) for t, n in fields])
views, together = [read('0.ply'), read('1.ply')], read('all.ply')
assert together.dtype.names == views[0].dtype.names + ('view',)
assert len(together) == len(views[0]) + len(views[1]) > 100
for k, points in enumerate(views):
    chosen = together[together['view'] == k]
    assert all((chosen[name] == points[name]).all() for name in points.dtype.names)
)");
  const auto convert = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"convert", "0.exr", "1.exr"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return fathom(arguments).err;
  };
  EXPECT_THAT(convert({"-o", "all.npy"}), HasSubstr("several maps make a point cloud"));
  EXPECT_THAT(convert({"-o", "all.ply", "--frame", "camera"}),
              HasSubstr("--frame camera needs a single map"));
  EXPECT_THAT(convert({"-o", "all.ply", "--camera", "camera.json"}),
              HasSubstr("--camera: 1 camera, but none is named like the map '0.exr'"));
  expect_done({"render", pair_, "--camera", "0.exr", "-o", "1.exr"});
  EXPECT_THAT(convert({"-o", "all.ply"}), HasSubstr("1.exr: the maps of a cloud need the same"));
}

}  // namespace
}  // namespace fathom::test
