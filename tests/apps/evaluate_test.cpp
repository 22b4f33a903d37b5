// evaluate: plates whose distances are plain; Depth L1 beside that of `compare`.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "run_program.h"
#include "test_folder.h"
#include "tests/places.h"

namespace fathom::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;
using Json = nlohmann::json;

/// Squares across the z axis, as an OBJ file.
std::string plates(const std::vector<std::string>& depths) {
  std::string text;
  for (const std::string& z : depths)
    text +=
        "v -1 -1 " + z + "\nv 1 -1 " + z + "\nv 1 1 " + z + "\nv -1 1 " + z + "\nf -4 -3 -2 -1\n";
  return text;
}

class Evaluate : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_.write("truth.obj", plates({"2", "5"}));
    folder_.write("scan.obj", plates({"2.25", "9"}));
    folder_.write("camera.json",
                  R"({"width": 64, "height": 64, "fx": 32, "fy": 32, "cx": 32, "cy": 32,
                      "pixel_centre": 0.5, "world_to_camera": [[1,0,0,0],[0,1,0,0],[0,0,1,0]]})");
  }
  Outcome evaluate(std::vector<std::string> more) const {
    more.insert(more.begin(), {"evaluate", "scan.obj", "--truth", "truth.obj", "--points", "1000"});
    return run_fathom(more, {.folder = folder_.path()});
  }
  Json figures(std::vector<std::string> more) const {
    more.emplace_back("--json");
    const Outcome outcome = evaluate(more);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return Json::parse(outcome.out);
  }

  TestFolder folder_;
};

// The scan's first plate hides its second one; of the truth's second one, a rim is seen beside the
// first if the camera's image is not as narrow as here: the plates at 2 fill it.
TEST_F(Evaluate, WhatTheCameraSees) {
  const Json found = figures({"--camera", "camera.json", "--within", "0.25,0.3"});
  EXPECT_EQ(found["accuracy"]["points"], 1000);
  EXPECT_EQ(found["accuracy"]["seen"], 500);
  EXPECT_EQ(found["accuracy"]["mean"], 0.25);
  EXPECT_EQ(found["accuracy"]["max"], 0.25);
  EXPECT_EQ(found["completeness"]["seen"], 500);
  EXPECT_EQ(found["accuracy"]["shares"],
            Json::parse(R"([{"within": 0.25, "share": 0.0}, {"within": 0.3, "share": 1.0}])"));
  EXPECT_EQ(found["f_scores"],
            Json::parse(R"([{"within": 0.25, "f_score": 0.0}, {"within": 0.3, "f_score": 1.0}])"));
  EXPECT_EQ(found["depth"]["views"], 1);
  EXPECT_EQ(found["depth"]["l1"], 0.25);
}

TEST_F(Evaluate, TheWholeSurfacesWithoutACamera) {
  const Json found = figures({});
  EXPECT_EQ(found["depth"], nullptr);
  EXPECT_EQ(found["accuracy"]["seen"], 1000);
  EXPECT_EQ(found["accuracy"]["mean"], (0.25 + 4) / 2);
  EXPECT_EQ(found["completeness"]["mean"], (0.25 + 2.75) / 2);
}

TEST_F(Evaluate, DepthsAreThoseThatCompareCompares) {
  const Json found = figures({"--camera", "camera.json"})["depth"];
  for (const char* name : {"truth", "scan"}) {
    const std::string file = name;
    const Outcome made = run_fathom({"render", file + ".obj", "--camera", "camera.json",
                                     "--channels", "Z", "-o", file + ".exr"},
                                    {.folder = folder_.path()});
    ASSERT_EQ(made.status, 0) << made.err;
  }
  run_fathom({"compare", "truth.exr", "scan.exr", "--metrics", "--json", "compared.json"},
             {.folder = folder_.path()});
  const Json compared = Json::parse(folder_.read("compared.json"))["channels"][0];
  const Json& metrics = compared["metrics"];
  EXPECT_EQ(found["pixels"]["both"], compared["both"]);
  EXPECT_EQ(found["pixels"]["only_truth"], compared["only_truth"]);
  EXPECT_EQ(found["l1"], metrics["mae"]);
  EXPECT_EQ(found["abs_rel"], metrics["abs_rel"]);
  EXPECT_EQ(found["rmse_log"], metrics["rmse_log"]);
}

TEST_F(Evaluate, IsATableToo) {
  const Outcome outcome = evaluate({"--camera", "camera.json", "--within", "0.3"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, StartsWith("Depth L1 0.25 over the "));
  EXPECT_THAT(outcome.out, HasSubstr("\naccuracy           1000       500        0.25"));
  EXPECT_THAT(outcome.out, HasSubstr("   100.000 %\n"));
}

TEST_F(Evaluate, PointsAreACloudThatOthersRead) {
  const Outcome outcome = evaluate(
      {"--camera", "camera.json", "--accuracy-points", "a.ply", "--completeness-points", "c.ply"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const Outcome read = run({python, "-c", R"(
import numpy as np
for name, z in (("a.ply", 2.25), ("c.ply", 2)):
    head, _, body = open(name, "rb").read().partition(b"end_header\n")
    assert head.startswith(b"ply\nformat binary_little_endian 1.0\n")
    assert b"element vertex 500\n" in head
    names = head.split(b"element vertex 500\n")[1].split()
    assert names == [word for name in (b"x", b"y", b"z", b"quality")
                     for word in (b"property", b"double", name)]
    points = np.frombuffer(body, "<f8").reshape(500, 4)
    assert (points[:, 2] == z).all() and (points[:, 3] == 0.25).all()
)"},
                           {.folder = folder_.path()});
  EXPECT_EQ(read.status, 0) << read.err;
}

/// An ASCII PLY of points with colours, as COLMAP's fused.ply has them. Its header claims `count`.
std::string fused(const std::vector<std::string>& points, std::size_t count) {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex " + std::to_string(count) +
      "\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\n"
      "property float ny\nproperty float nz\nproperty uchar red\nproperty uchar green\n"
      "property uchar blue\nend_header\n";
  for (const std::string& point : points) text += point + " 0 0 1 200 100 50\n";
  return text;
}

class EvaluateCloud : public Evaluate {
 protected:
  void write_cloud(const std::vector<std::string>& points) const {
    folder_.write("fused.ply", fused(points, points.size()));
  }
  Outcome evaluate_cloud(std::vector<std::string> more) const {
    more.insert(more.begin(), {"evaluate", "fused.ply", "--points", "1000"});
    return run_fathom(more, {.folder = folder_.path()});
  }
};

TEST_F(EvaluateCloud, MeasuresPointsAgainstASurface) {
  write_cloud({"0 0 2.5", "0 0 2.75", "1 1 4.75", "0 0 25"});
  const Outcome outcome =
      evaluate_cloud({"--truth", "truth.obj", "--density", "0.3", "--max-distance", "20",
                      "--within", "0.3,0.5", "--json", "--accuracy-points", "a.ply"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const Json found = Json::parse(outcome.out);
  EXPECT_EQ(found["depth"], nullptr);
  const Json& accuracy = found["accuracy"];
  EXPECT_EQ(accuracy["cloud_points"], 4);
  EXPECT_EQ(accuracy["points"], 3);
  EXPECT_EQ(accuracy["seen"], 3);
  EXPECT_EQ(accuracy["outliers"], 1);
  EXPECT_EQ(accuracy["mean"], 0.375);
  EXPECT_EQ(accuracy["shares"][0]["share"], 1 / 3.0);
  EXPECT_EQ(found["completeness"]["points"], 1000);
  EXPECT_FALSE(found["completeness"].contains("cloud_points"));
  EXPECT_EQ(found["overall"], (0.375 + found["completeness"]["mean"].get<double>()) / 2);
  EXPECT_THAT(folder_.read("a.ply"), HasSubstr("element vertex 3\n"));
}

TEST_F(EvaluateCloud, IsATableToo) {
  write_cloud({"0 0 2.5", "0 0 2.75"});
  folder_.write("laser.ply", fused({"0 0 2", "0 0 2.125"}, 2));
  const Outcome outcome = evaluate_cloud({"--truth", "laser.ply", "--density", "0.3",
                                          "--truth-density", "0.1", "--max-distance", "0.4"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out,
              StartsWith("The reconstruction is a cloud of 2 points; 1 left at density "
                         "0.3\nThe truth is a cloud of 2 points; 2 left at density 0.1\n"));
  EXPECT_THAT(outcome.out, HasSubstr("\naccuracy              1         1       0.375 "));
  EXPECT_THAT(outcome.out, HasSubstr("\noverall                                 0.375\n"));
  EXPECT_THAT(outcome.out, HasSubstr("Outliers, 0.4 or farther away: 0 for accuracy, 1 for "
                                     "completeness; only the shares count them\n"));
}

TEST_F(EvaluateCloud, NeedsSoundPoints) {
  const auto refused = [&](const std::string& file, const std::vector<std::string>& more,
                           int status, const char* message) {
    folder_.write("fused.ply", file);
    std::vector<std::string> arguments{"--truth", "truth.obj"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = evaluate_cloud(arguments);
    EXPECT_EQ(outcome.status, status);
    EXPECT_THAT(outcome.err, HasSubstr(message));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  };
  refused(fused({}, 0), {}, 3, "the reconstruction: has neither faces nor points");
  refused(fused({"0 nan 0"}, 1), {}, 3, "fused.ply: line 14: coordinate y is not finite");
  refused(fused({"0 0 0"}, 2), {}, 3, "fused.ply: ");
  refused(fused({"0 0 0"}, 1), {"--density", "0"}, 2, "--density: '0' is not positive");
  refused(fused({"0 0 0"}, 1), {"--truth-density", "1"}, 2,
          "--truth-density: thins a point cloud; the truth has faces");
}

TEST_F(Evaluate, RefusesWhatMakesNoSense) {
  const auto refused = [&](const std::vector<std::string>& more, int status, const char* message) {
    const Outcome outcome = evaluate(more);
    EXPECT_EQ(outcome.status, status);
    EXPECT_THAT(outcome.err, HasSubstr(message));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  };
  refused({"--within", "0"}, 2, "'0' is not positive");
  refused({"--within", "0.1,"}, 2, "--within");
  refused({"--camera", "none.json"}, 3, "none.json");
  folder_.write("line.obj", "v 0 0 0\nv 1 1 1\nf 1 2 2\n");
  const Outcome outcome =
      run_fathom({"evaluate", "scan.obj", "--truth", "line.obj"}, {.folder = folder_.path()});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, HasSubstr("the truth: the surface has no area"));
}

}  // namespace
}  // namespace fathom::test
