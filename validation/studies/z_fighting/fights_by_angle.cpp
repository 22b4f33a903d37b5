#include "validation/studies/z_fighting/fights_by_angle.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "validation/studies/plot.h"
#include "validation/studies/z_fighting/coplanar_pair.h"

namespace fathom::studies {
namespace {

constexpr double degrees[] = {0, 5, 10, 15, 20, 25, 30, 35, 40, 45, 50, 55};
constexpr std::pair<Mapping, Storage> swept[] = {{Mapping::standard, Storage::unorm16},
                                                 {Mapping::standard, Storage::unorm24},
                                                 {Mapping::log, Storage::unorm24},
                                                 {Mapping::reversed, Storage::float32}};

std::string name_of(const DepthFormat& format) {
  return fmt::format("{} {}", fathom::name_of(format.mapping), fathom::name_of(format.storage));
}

FightByAngle measure(const AngleSweep& sweep, const DepthFormat& format, double angle,
                     double distance) {
  const CoplanarPair pair{distance, sweep.separation, std::tan(angle * std::numbers::pi / 180)};
  double premultiplied = std::numeric_limits<double>::quiet_NaN();
  if (format.mapping <= Mapping::opengl) {  // a projection
    const View view = default_view(sweep.near);
    premultiplied =
        fighting_share_in_pipeline({format, view.row, true, {}}, view, pair, sweep.samples);
  }
  return {format,
          angle,
          distance,
          fighting_share(format, pair, sweep.samples),
          premultiplied,
          least_safe_separation(format, pair, sweep.samples),
          predicted_safe_separation(format, pair)};
}

std::string csv_of(const std::vector<FightByAngle>& fights) {
  std::string text =
      "mapping,storage,degrees,distance,wrong_ideal,wrong_pipeline_premultiplied,least_safe_"
      "separation,predicted_safe_separation\n";
  for (const FightByAngle& f : fights) {
    text += fmt::format("{},{},{:g},{:.9g},{:.6g},{},{:.9g},{:.9g}\n",
                        fathom::name_of(f.format.mapping), fathom::name_of(f.format.storage),
                        f.degrees, f.distance, f.ideal,
                        std::isnan(f.premultiplied) ? "" : fmt::format("{:.6g}", f.premultiplied),
                        f.safe, f.predicted);
  }
  return text;
}

/// A line for each format and distance; `value` gives its height, NaN and infinity are left out.
template <typename Value>
std::vector<Series> series_of(const std::vector<FightByAngle>& fights, const char* what,
                              Value value) {
  std::vector<Series> all;
  for (const FightByAngle& f : fights) {
    const std::string label =
        fmt::format("{}, distance {:.3g}{}", name_of(f.format), f.distance, what);
    if (all.empty() || all.back().label != label) all.push_back({label, {}});
    if (std::isfinite(value(f))) all.back().points.emplace_back(f.degrees, value(f));
  }
  std::erase_if(all, [](const Series& s) { return s.points.empty(); });
  return all;
}

}  // namespace

std::vector<FightByAngle> fights_by_angle(const AngleSweep& sweep) {
  const std::size_t angles = std::size(degrees), distances = sweep.distances.size();
  std::vector<FightByAngle> fights(std::size(swept) * distances * angles);
  tbb::parallel_for(std::size_t{0}, fights.size(), [&](std::size_t i) {
    const auto& [mapping, storage] = swept[i / (angles * distances)];
    fights[i] = measure(sweep, {mapping, storage, sweep.near, sweep.far}, degrees[i % angles],
                        sweep.distances[i / angles % distances]);
  });
  return fights;
}

std::vector<StudyFile> files_of(const std::vector<FightByAngle>& fights, const AngleSweep& sweep) {
  std::vector<StudyFile> files{{"angles.csv", csv_of(fights)}};
  const Plot share{"angle-share",
                   fmt::format("Samples where the wrong surface wins, separation {:g}, by tilt",
                               sweep.separation),
                   "tilt (degrees)",
                   "share of samples (%)",
                   false,
                   false,
                   series_of(fights, "", [](const FightByAngle& f) { return 100 * f.ideal; })};
  const Plot safe{"angle-safe",
                  "Least separation without z-fighting, by tilt",
                  "tilt (degrees)",
                  "separation (scene units)",
                  false,
                  true,
                  series_of(fights, "", [](const FightByAngle& f) { return f.safe; })};
  for (const Plot& plot : {share, safe}) {
    if (!has_points(plot)) continue;
    auto drawn = draw(plot);
    std::move(drawn.begin(), drawn.end(), std::back_inserter(files));
  }
  return files;
}

nlohmann::ordered_json json_of(const std::vector<FightByAngle>& fights) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const FightByAngle& f : fights) {
    list.push_back({{"mapping", fathom::name_of(f.format.mapping)},
                    {"storage", fathom::name_of(f.format.storage)},
                    {"degrees", f.degrees},
                    {"distance", f.distance},
                    {"wrong_ideal", f.ideal},
                    {"wrong_pipeline_premultiplied", f.premultiplied},
                    {"least_safe_separation", f.safe},
                    {"predicted_safe_separation", f.predicted}});
  }
  return list;
}

void add_to_page(const std::vector<FightByAngle>& fights, Page& page) {
  page.heading("Angle");
  page.paragraph(
      "The same surfaces, tilted from facing the camera (0 degrees) to 55 degrees. Facing it, "
      "they have one depth each, and all samples are right or all are wrong: whether both depths "
      "fall into one bin is luck. The more they are tilted, the more bins the patch runs through, "
      "and the farther its far side reaches, which decides what separation is safe: stripes, more "
      "and narrower ones. No angle makes a separation safe that a bin can swallow.");
  if (!fights.empty()) {
    page.plot("angle-share", "Share of wrong samples against the tilt, ideal model");
    page.plot("angle-safe", "Least safe separation against the tilt");
  }
}

}  // namespace fathom::studies
