#include "apps/bench/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "apps/bench/measurement.h"
#include "validation/child/fields.h"

namespace fathom::bench {
namespace {

using testing::HasSubstr;

/// fast takes 2 ms, vtk 5 ms, for 1000 triangles on 200 × 100 pixels.
Comparison comparison() {
  return {{.scene = "sphere-1k", .width = 200, .height = 100, .threads = 2},
          1000,
          {{"fast", "", 9, {1, 2, 4}, 1 << 20, 50},
           {"vtk", "VTK 9.1.0", 70, {4, 6}, 3 << 20, 51},
           {"embree-build", "Embree 3", 8, {1}, 5 << 20, 0}}};
}

TEST(BenchReport, MedianIsTheMiddleOrTheMeanOfTheTwoInTheMiddle) {
  EXPECT_EQ((Measurement{.milliseconds = {1, 2, 9}}.median_ms()), 2);
  EXPECT_EQ((Measurement{.milliseconds = {1, 2, 4, 9}}.median_ms()), 3);
}

TEST(BenchReport, JsonHasTheFiguresOfEachRenderer) {
  const Machine machine{"some processor", 2, 1U << 30, "some system", "some compiler"};
  const auto json = nlohmann::json::parse(to_json(machine, {comparison()}));
  EXPECT_EQ(json["machine"]["processor"], "some processor");
  EXPECT_EQ(json["machine"]["processors"], 2);
  ASSERT_EQ(json["results"].size(), 3U);
  const nlohmann::json& vtk = json["results"][1];
  EXPECT_EQ(vtk["scene"], "sphere-1k");
  EXPECT_EQ(vtk["triangles"], 1000);
  EXPECT_EQ(vtk["width"], 200);
  EXPECT_EQ(vtk["height"], 100);
  EXPECT_EQ(vtk["threads"], 2);
  EXPECT_EQ(vtk["renderer"], "vtk");
  EXPECT_EQ(vtk["median_ms"], 5);
  EXPECT_EQ(vtk["min_ms"], 4);
  EXPECT_EQ(vtk["max_ms"], 6);
  EXPECT_EQ(vtk["ratio_to_fast"], 2.5);
  EXPECT_EQ(vtk["peak_bytes"], 3 << 20);
  EXPECT_EQ(vtk["triangles_per_second"], 200'000);
  EXPECT_EQ(vtk["pixels_per_second"], 4'000'000);
  EXPECT_EQ(json["results"][0]["ratio_to_fast"], 1);
  EXPECT_TRUE(json["results"][2]["pixels_per_second"].is_null());
}

TEST(BenchReport, WithoutFastThereIsNoRatio) {
  Comparison without = comparison();
  without.measurements.erase(without.measurements.begin());
  const auto json = nlohmann::json::parse(to_json({}, {without}));
  EXPECT_TRUE(json["results"][0]["ratio_to_fast"].is_null());
}

TEST(BenchReport, TableIsAligned) {
  EXPECT_EQ(
      table(comparison()),
      "sphere-1k: 1000 triangles, 200x100, 2 threads\n"
      "  renderer        median ms     min ms     max ms   x fast  peak MiB   Mtri/s   Mpix/s\n"
      "  fast                 2.00       1.00       4.00     1.00       1.0      0.5     10.0\n"
      "  vtk                  5.00       4.00       6.00     2.50       3.0      0.2      4.0\n"
      "  embree-build         1.00       1.00       1.00     0.50       5.0        1        -\n"
      "\n");
}

TEST(BenchReport, TableHasRoomForLongNames) {
  Comparison with_long = comparison();
  with_long.measurements[2].renderer = "masked-occlusion-culling";
  const std::string text = table(with_long);
  EXPECT_THAT(text, HasSubstr("\n  renderer                  median ms  "));
  EXPECT_THAT(text, HasSubstr("\n  fast                           2.00  "));
  EXPECT_THAT(text, HasSubstr("\n  masked-occlusion-culling       1.00  "));
}

TEST(BenchReport, MeasurementsComeFromAnotherProcessFieldByField) {
  const auto given = comparison().measurements;
  const std::string bytes = validation::to_bytes(given);
  EXPECT_THAT(bytes, HasSubstr("covered_pixels"));
  const auto read = validation::from_bytes<std::vector<Measurement>>(bytes);
  ASSERT_EQ(read.size(), given.size());
  EXPECT_EQ(read[1].renderer, "vtk");
  EXPECT_EQ(read[1].description, "VTK 9.1.0");
  EXPECT_EQ(read[1].first_ms, 70);
  EXPECT_EQ(read[1].milliseconds, given[1].milliseconds);
  EXPECT_EQ(read[1].peak_bytes, given[1].peak_bytes);
  EXPECT_EQ(read[1].covered_pixels, 51U);
}

}  // namespace
}  // namespace fathom::bench
