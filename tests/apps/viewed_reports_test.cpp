// Reports of `fathom validate` as maps: those that somebody has changed are refused.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <bit>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/page_data.h"
#include "apps/view/page.h"
#include "fathom/failures/errors.h"

namespace fathom::view {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::ordered_json;
using Bytes = std::vector<std::uint8_t>;
using Words = std::vector<std::uint32_t>;

std::string compressed(const Bytes& bytes) {
  uLongf length = ::compressBound(bytes.size());
  Bytes result(length);
  ::compress(result.data(), &length, bytes.data(), bytes.size());
  result.resize(length);
  return app::base64(result);
}

std::string compressed(const Words& words) {
  Bytes bytes;
  for (int shift = 0; shift < 32; shift += 8) {
    for (const std::uint32_t word : words)
      bytes.push_back(static_cast<std::uint8_t>(word >> shift));
  }
  return compressed(bytes);
}

constexpr std::uint32_t one = std::bit_cast<std::uint32_t>(1.0F);

/// A scene of 2 × 1 pixels, and a renderer whose second pixel is an ulp too deep.
struct Report {
  Json maps{{"scenes",
             {{"cube",
               {{"width", 2},
                {"height", 1},
                {"depths", compressed(Words{one, one + 5})},
                {"triangles", compressed(Words{7, 8})}}}}},
            {"maps", Json::array({{{"differences", compressed(Words{0, 1})},
                                   {"classes", compressed(Bytes{0, 1})}}})}};
  Json report{{"results", Json::array({{{"scene", "cube"},
                                        {"renderer", "vtk"},
                                        {"variant", "unorm24"},
                                        {"pixels", {{"equal", 1}, {"edge", 1}}}}})}};

  [[nodiscard]] std::string page() const {
    return "<!DOCTYPE html>\n" + app::script_data("report", report.dump()) +
           app::script_data("maps", maps.dump());
  }
  Json& scene() { return maps["scenes"]["cube"]; }
};

constexpr std::uint64_t enough = 1 << 20;

/// Why a report is refused; empty: it was read.
std::string refusal_of(const std::string& page, std::uint64_t bytes = enough) {
  try {
    maps_of_report(page, "report.html", bytes);
    return {};
  } catch (const InputError& fault) {
    return fault.what();
  }
}

TEST(ViewedReports, HaveTheirMaps) {
  const std::string page = Report().page();
  ASSERT_TRUE(is_report(page));
  const std::vector<ViewedMap> maps = maps_of_report(page, "report.html", enough);
  ASSERT_EQ(maps.size(), 2U);
  EXPECT_EQ(maps[0].name, "cube: exact");
  EXPECT_EQ(maps[1].name, "cube: vtk unorm24");
  const float deeper = std::bit_cast<float>(one + 5), deepest = std::bit_cast<float>(one + 6);
  EXPECT_EQ(*maps[0].map.values<float>("Z"), (Samples<float>{1.0F, deeper}));
  EXPECT_EQ(*maps[0].map.values<std::uint32_t>("id"), (Samples<std::uint32_t>{7, 8}));
  EXPECT_EQ(*maps[1].map.values<float>("Z"), (Samples<float>{1.0F, deepest}));
  EXPECT_EQ(*maps[1].map.values<std::uint32_t>("class"), (Samples<std::uint32_t>{0, 1}));
  EXPECT_THAT(maps[1].map.tables.at("class"), ::testing::ElementsAre("equal", "edge"));
}

TEST(ViewedReports, WithoutMapsAreRefused) {
  EXPECT_FALSE(is_report("<!DOCTYPE html><p>maps"));
  Report none;
  none.maps["scenes"] = Json::object();
  EXPECT_EQ(refusal_of(none.page()),
            "report.html: is not a report of fathom validate: it holds no map");
}

TEST(ViewedReports, OfWrongSizesAreRefused) {
  for (const Json& side :
       {Json(-2), Json(2.0), Json(1e300), Json("2"), Json(nullptr), Json(std::uint64_t{1} << 32),
        Json(0), Json(1), Json(3), Json(4294967295)}) {
    Report report;
    report.scene()["width"] = side;
    EXPECT_NE(refusal_of(report.page()), "") << side;
  }
}

TEST(ViewedReports, OfDamagedValuesAreRefused) {
  for (const char* channel : {"depths", "triangles"}) {
    for (const Json& text : {Json("!"), Json(""), Json("AAAA"), Json(5), Json(compressed(Words{1})),
                             Json(compressed(Words{1, 2, 3}))}) {
      Report report;
      report.scene()[channel] = text;
      EXPECT_THAT(refusal_of(report.page()), HasSubstr("is not a report of fathom validate"))
          << channel << text;
    }
  }
}

TEST(ViewedReports, ThatAreNoReportsAreRefused) {
  const std::vector<std::function<void(Report&)>> faults{
      [](Report& r) { r.maps["maps"] = Json::array(); },
      [](Report& r) { r.maps["maps"][0].erase("classes"); },
      [](Report& r) { r.maps.erase("scenes"); },
      [](Report& r) { r.report = Json::array(); },
      [](Report& r) { r.report["results"][0]["renderer"] = 5; },
      [](Report& r) { r.report["results"][0].erase("pixels"); }};
  for (std::size_t k = 0; k < faults.size(); ++k) {
    Report report;
    faults[k](report);
    EXPECT_THAT(refusal_of(report.page()), HasSubstr("is not a report of fathom validate")) << k;
  }
  const std::string deep = std::string(1000, '[') + std::string(1000, ']');
  EXPECT_THAT(refusal_of("<!DOCTYPE html>\n" + app::script_data("report", deep) +
                         app::script_data("maps", "{}")),
              HasSubstr("is not a report of fathom validate"));
}

TEST(ViewedReports, ThatNeedMoreMemoryThanThereIsAreRefused) {
  EXPECT_EQ(refusal_of(Report().page(), 2 * (24 + 12)), "");
  EXPECT_THAT(refusal_of(Report().page(), 2 * (24 + 12) - 1), HasSubstr("memory"));
  EXPECT_THAT(refusal_of(Report().page(), 2 * 24 - 1), HasSubstr("memory"));
}

}  // namespace
}  // namespace fathom::view
