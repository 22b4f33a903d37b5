// The study `clipping`: bridging edges that can be measured on paper.

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "fathom/numeric/errors.h"
#include "validation/studies/clipping/clipping.h"

namespace fathom::studies {
namespace {

using Json = nlohmann::json;

TEST(ClippingStudy, BridgesOfTheNamedShapes) {
  std::map<std::string, std::string> files;
  for (const StudyFile& file : study_clipping({.samples = 3}, [](double) {}))
    files[file.name] = file.content;
  for (const char* name : {"index.html", "shapes.csv", "random.csv", "bridges.png",
                           "shape-notch.png", "shape-comb.png", "shape-spiral.svg"})
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
  for (const Json& average : summary["random"]) EXPECT_TRUE(average["areas_agree"]);
  EXPECT_THROW(study_clipping({.near = 1}, [](double) {}), UsageError);
}

}  // namespace
}  // namespace fathom::studies
