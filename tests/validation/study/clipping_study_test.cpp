// The study `clipping`: bridging edges that can be measured on paper.

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "apps/study/clipping/beside_cgal.h"
#include "apps/study/study.h"
#include "fathom/failures/errors.h"

namespace fathom::studies {
namespace {

using Json = nlohmann::json;

TEST(ClippingStudy, BridgesOfTheNamedShapes) {
  std::map<std::string, std::string> files;
  for (const StudyFile& file : study_clipping({.samples = 3}, [](double) {}))
    files[file.name] = file.content;
  for (const char* name : {"index.html", "shapes.csv", "random.csv", "bridges.png", "cgal.csv",
                           "cgal.svg", "shape-notch.png", "shape-comb.png", "shape-spiral.svg"})
    EXPECT_FALSE(files[name].empty()) << name;
  EXPECT_EQ(files["shape-comb.png"].substr(1, 3), "PNG");

  const Json summary = Json::parse(files["summary.json"]);
  std::map<std::string, Json> shapes;
  for (const Json& shape : summary["shapes"]) {
    EXPECT_TRUE(shape["areas_agree"]);
    shapes[shape["shape"]] = shape;
  }
  // The comb's window meets three teeth of width 2, 2 apart: twice two gaps of 2, on borders of 8.
  // All lengths are integers, so nothing is rounded.
  EXPECT_EQ(shapes["comb"]["pieces"], 3);
  EXPECT_EQ(shapes["comb"]["bridges"], 8);
  EXPECT_EQ(shapes["comb"]["border"], 24);
  EXPECT_EQ(shapes["comb"]["cuts"], 0);
  // The notch at y = 4 goes from 4/3 to 20/3, there and back: 32/3. A sum of twelve lengths below
  // 16, each within an ulp of 2^-49: far below 1e-12.
  EXPECT_EQ(shapes["notch"]["pieces"], 2);
  EXPECT_NEAR(shapes["notch"]["bridges"].get<double>(), 32.0 / 3, 1e-12);
  EXPECT_EQ(summary["answers_unlike_cgal"], 0);
  EXPECT_EQ(summary["cgal"].size(), 20U);
  for (const Json& row : summary["cgal"]) EXPECT_EQ(row["different"], 0) << row;
  for (const Json& average : summary["random"]) EXPECT_TRUE(average["areas_agree"]);
  EXPECT_THROW(study_clipping({.near = 1}, [](double) {}), UsageError);
}

/// What the pairs give, counted on paper.
TEST(ClippingStudy, PairsBesideCgal) {
  // Each of 9 squares has a corner in common with its moved one: 9 common squares, and 9 that
  // remain. The moved one reaches to the next square and shares a piece of an edge with it, no
  // area.
  const BesideCgal squares = measure_beside_cgal("squares", 72);
  EXPECT_EQ(squares.corners, 72U);
  EXPECT_EQ(squares.polygons, 18U);
  // 16 squares are 8 frames. The triangle has a corner at (1.5, 1.5), between the outermost two
  // squares: it cuts the first frame in two, and all others lie in it.
  const BesideCgal nested = measure_beside_cgal("nested", 64);
  EXPECT_EQ(nested.corners, 64U + 3);
  EXPECT_EQ(nested.polygons, 8U + 1);
  // 10 triangles from a corner in the square, which reaches to x = 5.5, to x = 10: each is cut in
  // two.
  const BesideCgal fan = measure_beside_cgal("fan", 30);
  EXPECT_EQ(fan.corners, 30U + 4);
  EXPECT_EQ(fan.polygons, 20U);
  for (const BesideCgal& row :
       {squares, nested, fan, measure_beside_cgal("grid", 200), measure_beside_cgal("stars", 60)}) {
    EXPECT_EQ(row.different, 0U) << row.kind;
    EXPECT_GT(row.polygons, 0U);
    EXPECT_GT(row.ours_ms, 0);
    EXPECT_GT(row.cgal_ms, 0);
  }
}

}  // namespace
}  // namespace fathom::studies
