#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/apps/run_program.h"
#include "tests/apps/test_folder.h"
#include "tests/places.h"

/// `fathom validate --map`, which starts fathom-validate, as users run it.
namespace fathom::test {
namespace {

using testing::HasSubstr;

const std::string cube = source_dir() / "data/meshes/cube.obj";

/// A folder with an exact map of the cube, its camera, and the same camera half a pixel aside.
class ValidateProgram : public testing::Test {
 protected:
  void SetUp() override {
    render("camera.json", 20, "map.exr");
    render("aside.json", 20.5, "aside.exr");
  }

  void render(const std::string& camera, double cx, const std::string& map) {
    nlohmann::json json{{"width", 40}, {"height", 30}, {"fx", 50},
                        {"fy", 50},    {"cx", cx},     {"cy", 15},
                        {"near", 1},   {"far", 10},    {"pixel_centre", 0.5}};
    json["world_to_camera"] = {{0.8, 0.0, -0.6, 0.1}, {0.2, -0.9, 0.3, 0}, {0.6, 0.3, 0.7, 4}};
    folder.write(camera, json.dump());
    const Outcome outcome =
        run_fathom({"render", cube, "--camera", camera, "-o", map}, {.folder = folder.path()});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }

  Outcome validate(const std::string& map, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"validate",    "--map",   map,          "--camera",
                                       "camera.json", "--model", "gl-unorm24", cube};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_fathom(arguments, {.folder = folder.path()});
  }

  const TestFolder folder;
};

TEST_F(ValidateProgram, FindsAnExactMapGood) {
  const Outcome outcome = validate("map.exr", {"--out", "report"});
  ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out,
              HasSubstr("cube, map gl-unorm24: 1200 equal, z-fight unknown (no triangle "
                        "numbers);"));
  const auto json = nlohmann::json::parse(folder.read("report/report.json"));
  EXPECT_EQ(json["results"][0]["pixels"]["equal"], 1200);
  EXPECT_GT(json["results"][0]["bounds"]["median_relative_width"], 0);
}

TEST_F(ValidateProgram, FindsTheCameraOfAPathByTheNameOfTheMap) {
  const auto named = [&](const std::string& file, const std::string& name) {
    nlohmann::json camera = nlohmann::json::parse(folder.read(file));
    camera["name"] = name;
    return camera;
  };
  folder.write("path.json", nlohmann::json{named("aside.json", "images/other.jpg"),
                                           named("camera.json", "images/map.jpg")}
                                .dump());
  const auto judged = [&](const std::string& map) {
    return run_fathom({"validate", "--map", map, "--channel", "depth", "--camera", "path.json",
                       "--model", "gl-unorm24", cube},
                      {.folder = folder.path()});
  };
  const Outcome outcome = judged("map.exr");
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  EXPECT_THAT(judged("aside.exr").err,
              HasSubstr("--camera: 2 cameras, but none is named like the map 'aside.exr'"));
}

TEST_F(ValidateProgram, NamesAHalfPixelShiftAndListsItsWorstPixels) {
  const Outcome outcome = validate("aside.exr", {"--out", "report"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.out, HasSubstr("the image is shifted by (-0.5, "));
  const auto result = nlohmann::json::parse(folder.read("report/report.json"))["results"][0];
  EXPECT_EQ(result["findings"][0]["kind"], "shift");
  ASSERT_FALSE(result["worst"].empty());
  EXPECT_EQ(result["worst"][0]["corners"].size(), 3U);
}

TEST_F(ValidateProgram, JudgesMapsOfCamerasWithLenses) {
  nlohmann::json lens = nlohmann::json::parse(folder.read("camera.json"));
  for (const char* const limit : {"near", "far"}) lens.erase(limit);
  lens["model"] = "OPENCV";
  for (const char* const key : {"p1", "p2"}) lens[key] = 0.002;
  lens["k1"] = -0.4;
  lens["k2"] = 0.05;
  folder.write("lens.json", lens.dump());
  const auto run = [&](const std::vector<std::string>& arguments) {
    return run_fathom(arguments, {.folder = folder.path()});
  };
  const auto judged = [&](const std::string& map, const std::string& model) {
    return run({"validate", "--map", map, "--camera", "lens.json", "--model", model, cube});
  };
  ASSERT_EQ(run({"render", cube, "--camera", "lens.json", "-o", "lens.exr"}).status, 0);
  const Outcome right = judged("lens.exr", "float32-ray");
  EXPECT_EQ(right.status, 0) << right.out << right.err;
  EXPECT_THAT(right.out, HasSubstr("1200 equal"));
  const Outcome ignored = judged("map.exr", "float32-ray");
  EXPECT_EQ(ignored.status, 1) << ignored.err;
  EXPECT_THAT(ignored.out, HasSubstr("the lens OPENCV is left out"));
  EXPECT_EQ(judged("lens.exr", "gl-float32").status, 2);
  const Outcome against = run({"validate", "--against", "embree", cube, "--camera", "lens.json"});
  EXPECT_EQ(against.status, 2);
  EXPECT_THAT(against.err, HasSubstr("the lens OPENCV: these renderers draw"));
}

/// The pipeline of the textbooks is a renderer like any other: its stored depths are those of its
/// model, and where a polygon offset has moved them, that is found.
TEST_F(ValidateProgram, ExplainsWhatThePipelineStores) {
  const auto unexplained = [&](const std::string& model, std::vector<std::string> more) {
    std::vector<std::string> arguments{"render",   cube,          "--engine",   "pipeline",
                                       "--camera", "camera.json", "--channels", "Z,id",
                                       "-o",       "p.exr"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome drawn = run_fathom(arguments, {.folder = folder.path()});
    EXPECT_EQ(drawn.status, 0) << drawn.err;
    const Outcome judged =
        run_fathom({"validate", "--map", "p.exr", "--channel", "Zdecoded", "--camera",
                    "camera.json", "--model", model, cube, "--out", "report"},
                   {.folder = folder.path()});
    EXPECT_LE(judged.status, 1) << judged.err;
    const auto result = nlohmann::json::parse(folder.read("report/report.json"))["results"][0];
    EXPECT_GT(result["pixels"]["equal"], 200) << judged.out;
    return result["pixels"].value("unexplained", 0) + static_cast<int>(result["findings"].size());
  };
  for (const std::string storage : {"unorm16", "unorm24", "unorm32", "float32"}) {
    EXPECT_EQ(unexplained("gl-" + storage, {"--depth-format", storage, "--mapping", "opengl"}), 0)
        << storage;
  }
  EXPECT_EQ(
      unexplained("gl-float32-reversed", {"--depth-format", "float32", "--mapping", "reversed"}),
      0);
  EXPECT_GT(unexplained("gl-unorm24", {"--depth-format", "unorm24", "--mapping", "opengl",
                                       "--polygon-offset", "0,500"}),
            0);
}

/// As in Python, no model need be named; the report begins with the verdict, and a map has no
/// version.
TEST_F(ValidateProgram, JudgesAMapByTheModelThatFitsWhereNoneIsNamed) {
  const auto run_without_model = [&](const std::string& map) {
    return run_fathom(
        {"validate", "--map", map, "--camera", "camera.json", cube, "--out", "report"},
        {.folder = folder.path()});
  };
  const Outcome good = run_without_model("map.exr");
  EXPECT_EQ(good.status, 0) << good.err;
  EXPECT_THAT(good.out, testing::StartsWith("every pixel is explained\ncube, map auto: "));
  const auto report = nlohmann::json::parse(folder.read("report/report.json"));
  EXPECT_EQ(report["verdict"], "every pixel is explained");
  const nlohmann::json& result = report["results"][0];
  EXPECT_EQ(result["verdict"], "every pixel is explained");
  EXPECT_EQ(result["version"], "");
  EXPECT_EQ(result["file"], "map.exr");
  const Outcome bad = run_without_model("aside.exr");
  EXPECT_EQ(bad.status, 1);
  EXPECT_THAT(bad.out, testing::StartsWith("failed: the image is shifted by (-0.5, "));
  EXPECT_THAT(bad.out, HasSubstr("\n  found: shift\n"));
  EXPECT_THAT(bad.out, HasSubstr("the map contains another camera than --camera; with '--camera "
                                 "aside.exr' it is judged by its own"));
  EXPECT_THAT(good.out, testing::Not(HasSubstr("another camera")));
}

/// A line for each model, and the one that is taken above them.
TEST_F(ValidateProgram, SaysWhatEachModelMakesOfTheMap) {
  const Outcome outcome = run_fathom({"validate", "--map", "map.exr", "--camera", "camera.json",
                                      "--model", "auto", cube, "--out", "report"},
                                     {.folder = folder.path()});
  ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  std::istringstream text(outcome.out);
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  ASSERT_EQ(lines.size(), 7U) << outcome.out;
  EXPECT_EQ(lines[0], "every pixel is explained");
  EXPECT_EQ(lines[2], "  note: taken for float32-ray, the model that fits best (1200 pixels)");
  EXPECT_EQ(lines[6], "    and 4 more; report.json of -o has all");
  EXPECT_THAT(std::vector(lines.begin() + 3, lines.begin() + 6),
              testing::Each(testing::MatchesRegex(
                  "    [a-z0-9-]+: (every pixel is explained, bounds .*|a sample is explained, "
                  "bounds .*|[0-9]+ pixels? of a sample unexplained|[0-9]+ pixels? holds? what its "
                  "storage cannot)")));
  const auto note =
      nlohmann::json::parse(folder.read("report/report.json"))["results"][0]["notes"][0];
  EXPECT_EQ(note["kind"], "model");
  EXPECT_EQ(note["evidence"].size(), 7U);
}

TEST_F(ValidateProgram, HoldsARunAgainstAnEarlierOne) {
  ASSERT_EQ(validate("map.exr", {"--out", "good"}).status, 0);
  ASSERT_EQ(validate("aside.exr", {"--out", "bad"}).status, 1);
  EXPECT_EQ(validate("map.exr", {"--baseline", "bad/report.json"}).status, 0);
  const Outcome worse = validate("aside.exr", {"--baseline", "good/report.json"});
  EXPECT_EQ(worse.status, 1);
  EXPECT_THAT(worse.out, HasSubstr("worse than the baseline: cube, map gl-unorm24: "));
}

TEST_F(ValidateProgram, FailsWithABaselineOnlyWhereSomethingGotWorse) {
  ASSERT_EQ(validate("aside.exr", {"--out", "bad"}).status, 1);
  const Outcome same = validate("aside.exr", {"--baseline", "bad/report.json", "--junit", "j.xml"});
  EXPECT_EQ(same.status, 0) << same.out;
  EXPECT_THAT(same.out, testing::StartsWith("failed: the image is shifted by"));
  EXPECT_THAT(same.out, HasSubstr("baseline: 0 worse, 0 better, 0 changed, 1 same"));
  EXPECT_THAT(folder.read("j.xml"), testing::Not(HasSubstr("<failure")));
  const Outcome test =
      validate("aside.exr", {"--baseline", "bad/report.json", "--ctest", "--out", "test"});
  EXPECT_EQ(test.status, 0);
  EXPECT_THAT(test.out,
              testing::StartsWith("no worse than the baseline: failed: the image is shifted by"));
  // A result that the baseline lacks is judged alone.
  nlohmann::json other = nlohmann::json::parse(folder.read("bad/report.json"));
  other["results"][0]["scene"] = "another";
  folder.write("other.json", other.dump());
  EXPECT_EQ(validate("aside.exr", {"--baseline", "other.json"}).status, 1);
}

TEST_F(ValidateProgram, SaysAndShowsWhatChangedSinceABaseline) {
  ASSERT_EQ(validate("map.exr", {"--out", "good"}).status, 0);
  const Outcome worse = validate("aside.exr", {"--baseline", "good/report.json", "--out", "bad"});
  EXPECT_EQ(worse.status, 1);
  EXPECT_THAT(worse.out, HasSubstr("worse than the baseline: cube, map gl-unorm24: the image is "
                                   "shifted by"));
  EXPECT_THAT(worse.out,
              HasSubstr("baseline: 1 worse, 0 better, 0 changed, 0 same, 0 new, 0 gone"));
  EXPECT_THAT(folder.read("bad/comparison.html"), HasSubstr("\"verdict\":\"worse\""));
  const Outcome better = validate("map.exr", {"--baseline", "bad/report.json"});
  EXPECT_EQ(better.status, 0);
  EXPECT_THAT(better.out, HasSubstr("better than the baseline: cube, map gl-unorm24: no longer: "));
  EXPECT_FALSE(std::filesystem::exists(folder / "good/comparison.html"));
  // Fewer equal pixels are worse though each of them is explained.
  nlohmann::json more_equal = nlohmann::json::parse(folder.read("good/report.json"));
  more_equal["results"][0]["pixels"]["equal"] = 1201;
  folder.write("more.json", more_equal.dump());
  const Outcome fewer =
      validate("map.exr", {"--baseline", "more.json", "--ctest", "--out", "fewer"});
  EXPECT_EQ(fewer.status, 1);
  EXPECT_THAT(fewer.out, testing::StartsWith("worse than the baseline: cube, map gl-unorm24: 1200 "
                                             "equal pixels, 1201 in the baseline\n"));
  // Where nothing is compared, nothing is worse; that is no reason to pass.
  const Outcome other =
      run_fathom({"validate", "--map", "map.exr", "--camera", "camera.json", "--model",
                  "float32-ray", cube, "--baseline", "good/report.json"},
                 {.folder = folder.path()});
  EXPECT_EQ(other.status, 3);
  EXPECT_THAT(other.out, HasSubstr("good/report.json: contains no result of this run"));
}

TEST_F(ValidateProgram, WritesJunitWithTheReportOrNeither) {
  const Outcome outcome = validate("aside.exr", {"--junit", "junit.xml", "--out", "report"});
  EXPECT_EQ(outcome.status, 1);
  const Outcome read = run({python, "-c",
                            "import sys, xml.etree.ElementTree as tree\n"
                            "case = tree.parse(sys.argv[1]).getroot()[0][0]\n"
                            "assert float(case.get('time')) > 0\n"
                            "print(case.get('name'), case.find('failure').get('message'))",
                            folder / "junit.xml"});
  EXPECT_THAT(read.out,
              testing::StartsWith("map gl-unorm24 failed: the image is shifted by (-0.5, "))
      << read.err;
  const Outcome printed = validate("map.exr", {"--junit", "-"});
  EXPECT_EQ(printed.status, 0);
  EXPECT_THAT(printed.out, testing::StartsWith("<?xml"));
  EXPECT_THAT(printed.out, testing::EndsWith("</testsuites>\n"));
  EXPECT_EQ(validate("map.exr", {"--junit", "map.exr/junit.xml", "--out", "other"}).status, 4);
  EXPECT_FALSE(std::filesystem::exists(folder / "other/report.json"));
}

TEST_F(ValidateProgram, TellsCtestTheCauseFirstAndThePictures) {
  const Outcome bad = validate("aside.exr", {"--ctest", "--out", "report"});
  EXPECT_EQ(bad.status, 1);
  EXPECT_THAT(bad.out, testing::StartsWith("failed: the image is shifted by (-0.5, "));
  EXPECT_THAT(bad.out, HasSubstr("<CTestMeasurementFile type=\"image/png\" "
                                 "name=\"Classes of pixels\">" +
                                 folder / "report/classes.png" + "</CTestMeasurementFile>\n"));
  for (const char* name : {"report/classes.png", "report/differences.png"}) {
    EXPECT_THAT(folder.read(name), testing::StartsWith("\x89PNG")) << name;
  }
  const Outcome good = validate("map.exr", {"--ctest", "--out", "report"});
  EXPECT_EQ(good.status, 0);
  EXPECT_THAT(good.out,
              testing::StartsWith("every pixel is explained\ncube, map gl-unorm24: 1200 equal"));
}

/// What a map lacks, or what does not belong to it, is said with what to give instead.
TEST_F(ValidateProgram, SaysWhatToGiveForMapsThatDoNotFit) {
  const auto expect = [&](const Outcome& outcome, int status, const std::string& line) {
    EXPECT_EQ(outcome.status, status) << outcome.out << outcome.err;
    EXPECT_THAT(status == 1 ? outcome.out : outcome.err, HasSubstr(line));
    const auto lines = std::count(outcome.err.begin(), outcome.err.end(), '\n');
    EXPECT_EQ(lines, status == 1 ? 0 : 1) << outcome.err;
  };
  const auto validate_with = [&](const std::string& camera, const std::string& mesh) {
    return run_fathom({"validate", "--map", "map.exr", "--camera", camera, "--model", "gl-unorm24",
                       source_dir() / "data/meshes" / mesh},
                      {.folder = folder.path()});
  };
  nlohmann::json camera = nlohmann::json::parse(folder.read("camera.json"));
  const auto write_camera = [&](const std::string& name, nlohmann::json::object_t changes) {
    nlohmann::json changed = camera;
    changed.update(nlohmann::json(changes));
    folder.write(name, changed.dump());
  };
  write_camera("small.json", {{"width", 20}});
  expect(validate_with("small.json", "cube.obj"), 3,
         "map.exr: has 40x30 pixels, the camera 20x30; expected the camera that it was drawn with");
  nlohmann::json unclipped = camera;
  unclipped.erase("near");
  unclipped.erase("far");
  folder.write("unclipped.json", unclipped.dump());
  expect(validate_with("unclipped.json", "cube.obj"), 2,
         "--model: gl-unorm24 stores depths between near and far, and the camera has not both; "
         "expected the renderer's values");

  const std::string pixels(4 * 3 * 40 * 30, '\0');
  folder.write("rgb.pfm", "PF\n40 30\n-1\n" + pixels);
  expect(
      validate("rgb.pfm"), 3,
      "rgb.pfm: of the map's channels R, G, B none has a name for depths; expected Z, or the name "
      "of the depth channel: --channel NAME");
  expect(validate("map.exr", {"--channel", "Q"}), 3,
         "map.exr: the map has no channel 'Q', only A, Z");

  // Of foreign PNGs of 16 bits nobody knows the unit.
  ASSERT_EQ(run_fathom({"render", cube, "--camera", "camera.json", "-o", "map.png", "--png-scale",
                        "10000"},
                       {.folder = folder.path()})
                .status,
            0);
  ASSERT_EQ(run({"oiiotool", folder / "map.png", "--eraseattrib", "fathom:scale", "-o",
                 folder / "unit.png"})
                .status,
            0);
  expect(validate("unit.png"), 3,
         "unit.png: the map holds integers and does not say how many are a unit of depth: "
         "--png-scale N");
  const Outcome scaled = validate("unit.png", {"--png-scale", "10000"});
  EXPECT_THAT(scaled.out, HasSubstr("1200 equal")) << scaled.err;

  expect(validate("map.exr", {"--png-scale", "1000"}), 2,
         "--png-scale: map.exr holds no 16-bit integers");

  const std::string fits_nowhere =
      "failed: neither outlines nor depths fit: expected the SCENE and the camera that the map was "
      "drawn from, and its channel of depths (";
  expect(validate_with("camera.json", "spot.obj"), 1, fits_nowhere);
  expect(validate_with("camera.json", "teapot.obj"), 1, fits_nowhere);
  EXPECT_THAT(validate_with("camera.json", "teapot.obj").out,
              testing::Not(HasSubstr("missing-triangle")));
  write_camera("away.json", {{"world_to_camera", {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, -9}}}});
  expect(validate_with("away.json", "cube.obj"), 1,
         "failed: SCENE is out of the camera's sight: expected the camera");
  folder.write("empty.pfm", "Pf\n40 30\n-1\n" + pixels.substr(0, 4 * 40 * 30));
  expect(validate("empty.pfm"), 1, "failed: the map shows no surface at all");
}

TEST_F(ValidateProgram, RefusesInOneLine) {
  const auto expect_refused = [](const Outcome& outcome, int status, const std::string& message) {
    EXPECT_EQ(outcome.status, status) << outcome.out;
    EXPECT_THAT(outcome.err, HasSubstr(message));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  };
  expect_refused(validate("none.exr"), 3, "none.exr");
  folder.write("report.json", "{}");
  expect_refused(validate("map.exr", {"--baseline", "report.json"}), 3, "not a report.json");
  folder.write("report.json", "{\"results\":" + std::string(100'000, '['));
  expect_refused(validate("map.exr", {"--baseline", "report.json"}), 3,
                 "not a report.json of fathom validate: nested more than 100 deep");
  const std::string report = "{\"fathom\": \"0.1.0\", \"results\": [";
  folder.write("report.json", report);
  expect_refused(
      validate("map.exr", {"--baseline", "report.json"}), 3,
      "report.json: is cut off: it ends within its JSON; write it again: fathom validate");
  folder.write("file", "");
  expect_refused(validate("map.exr", {"--out", "file"}), 4, "file: cannot make this folder");
  const auto run = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "validate");
    return run_fathom(arguments, {.folder = folder.path()});
  };
  expect_refused(run({"--map", "map.exr", "--camera", "camera.json", "--model", "voxel", cube}), 2,
                 "--model: there is no model 'voxel'");
  expect_refused(run({"--map", "map.exr", "--model", "cycles", cube}), 2,
                 "--camera FILE is missing; if the map contains its camera: --camera map.exr");
  expect_refused(run({"--map", "map.exr", "--camera", "camera.json", "--model", "gl24", cube}), 2,
                 "did you mean 'gl-unorm24'?");
  expect_refused(run({"--map", "map.exr", "--camera", "camera.json", "--model", "matching", cube}),
                 2, "--model matching: judges each renderer of --against by its own model");
  std::filesystem::create_directory(folder / "found");
  folder.write("found/report.json", "");
  expect_refused(validate("map.exr", {"--baseline", "found"}), 3,
                 "found: is a folder, expected its file found/report.json");
  expect_refused(run({"--map", "map.exr", "--camera", "camera.json", "--model", "cycles"}), 2,
                 "SCENE is missing");
  expect_refused(validate("map.exr", {"--ctest"}), 2, "--ctest needs -o DIR");
  expect_refused(run({"--against", "embree", "--scene", "spot", "--ctest", "--out", "o"}), 2,
                 "--ctest goes with --map");
  expect_refused(run({"--colour", "--junit", "o.xml"}), 2, "--junit goes with --map and --against");
}

TEST_F(ValidateProgram, RefusesVariantsThatItDoesNotUnderstand) {
  const auto expect_refused = [&](const std::vector<std::string>& arguments,
                                  const std::string& message) {
    std::vector<std::string> all{"validate"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Outcome outcome = run_fathom(all, {.folder = folder.path()});
    EXPECT_EQ(outcome.status, 2) << outcome.out;
    EXPECT_THAT(outcome.err, HasSubstr(message));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  };
  const auto render = [&](const std::string& renderer, const std::string& variant) {
    return std::vector<std::string>{"--render", renderer, "--variants", variant,    cube,
                                    "--size",   "8x6",    "-o",         "drawn.exr"};
  };
  for (const char* variant : {"unorm24 offset", "unorm24 offset 4x", "unorm24 x samples",
                              "unorm24 samples", "unorm24 reversed reversed", "float16"}) {
    expect_refused(render("opengl", variant), "--variants: opengl has no variant '" +
                                                  std::string(variant) + "', only unorm16, ");
  }
  for (const char* variant : {"own x samples", "own -8 samples", "float16"}) {
    expect_refused(render("vtk", variant),
                   "--variants: vtk has no variant '" + std::string(variant) + "', only own, ");
  }
  expect_refused(render("embree", "robbust"),
                 "--variants: embree has no variant 'robbust', only default and robust");
  expect_refused(render("blender", "eevee"),
                 "--variants: blender has no variant 'eevee', only cycles");
  expect_refused(render("pbrt", "default"),
                 "--render: 'pbrt' is not one of vtk, opengl, embree and blender");
  expect_refused({"--against", "embree,pbrt", "--scene", "sphere"},
                 "--against: 'pbrt' is not one of vtk, opengl, embree and blender");
  // One that is understood does not excuse one that is not.
  expect_refused({"--against", "embree", "--scene", "sphere", "--variants", "robust,defualt"},
                 "--variants: none of the renderers has a variant 'defualt'; there are default, "
                 "robust");
}

/// A renderer's files lie in TMPDIR, whose name no shell reads.
TEST_F(ValidateProgram, AFolderForTemporaryFilesIsNoCommand) {
  folder.write("rotation.json",
               R"({"width": 40, "height": 30, "fx": 50, "fy": 50, "cx": 20, "cy": 15, "near": 1,
 "far": 10, "pixel_centre": 0.5, "world_to_camera": [[1,0,0,0],[0,1,0,0],[0,0,1,4]]})");
  const std::string quoted = folder / "x'; touch hacked; '";
  std::filesystem::create_directory(quoted);
  folder.write("blender", "#!/bin/sh\necho \"Error: $*\"\ntest \"$1\" = --version\n");
  std::filesystem::permissions(folder / "blender", std::filesystem::perms::owner_all);
  const Outcome outcome = run_fathom(
      {"validate", "--render", "blender", cube, "--camera", "rotation.json", "-o", "theirs.exr"},
      {.folder = folder.path(), .prepare = [&] {
         ::setenv("TMPDIR", quoted.c_str(), 1);
         ::setenv("PATH", (folder.path().string() + ":/usr/bin:/bin").c_str(), 1);
       }});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, HasSubstr("--python " + quoted));
  EXPECT_FALSE(std::filesystem::exists(folder / "hacked"));
  EXPECT_TRUE(std::filesystem::is_empty(quoted));
}

}  // namespace
}  // namespace fathom::test
