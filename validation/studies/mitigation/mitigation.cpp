#include "validation/studies/mitigation/mitigation.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "fathom/numeric/errors.h"
#include "validation/studies/page.h"
#include "validation/studies/plot.h"
#include "validation/studies/z_fighting/scene_fights.h"

namespace fathom::studies {
namespace {

using Json = nlohmann::ordered_json;

constexpr Storage storage = Storage::unorm24;
constexpr double factors[] = {0, -0.5, -1, -2, -4};
constexpr double units[] = {0, -1, -2, -4, -16, -64, -256, -1024, -4096};

/// One cure: the whole scene in another format, or with another near plane.
struct Cure {
  std::string name;
  SceneFights fights;
};

DepthFormat format_of(const Camera& camera, Mapping mapping, Storage stored) {
  return {mapping, stored, camera.near,
          takes_infinite_far(mapping) ? std::numeric_limits<double>::infinity() : camera.far};
}

double nearest_depth(const DepthMap& visible) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const float z : *visible.values<float>("Z")) {
    nearest = std::min(nearest, static_cast<double>(z));
  }
  return nearest;
}

/// The near plane farther and farther, up to what is visible: nothing is cut away.
std::vector<Cure> near_planes(const SceneView& view, const DepthMap& visible) {
  std::vector<Cure> cures;
  const double nearest = 0.999 * nearest_depth(visible);
  for (double near = view.camera.near;; near = std::min(2 * near, nearest)) {
    SceneView moved = view;
    moved.camera.near = near;
    const DepthFormat format = format_of(moved.camera, Mapping::standard, storage);
    cures.push_back(
        {fmt::format("near {:.3g}", near), buffer_scene(moved, visible, format).fights});
    if (near >= nearest) return cures;
  }
}

std::vector<Cure> formats(const SceneView& view, const DepthMap& visible) {
  std::vector<Cure> cures;
  const std::pair<Mapping, Storage> all[] = {{Mapping::standard, storage},
                                             {Mapping::standard, Storage::unorm32},
                                             {Mapping::standard, Storage::float32},
                                             {Mapping::reversed, storage},
                                             {Mapping::reversed, Storage::float32},
                                             {Mapping::reversed_infinite, Storage::float32},
                                             {Mapping::linear, storage},
                                             {Mapping::log, storage},
                                             {Mapping::log, Storage::float32},
                                             {Mapping::log_ulrich, storage}};
  for (const auto& [mapping, stored] : all) {
    cures.push_back({std::string(name_of(mapping)) + " " + std::string(name_of(stored)),
                     buffer_scene(view, visible, format_of(view.camera, mapping, stored)).fights});
  }
  return cures;
}

std::vector<OffsetCount> offsets(const SceneView& view, const std::vector<LayeredSample>& samples,
                                 std::uint32_t first) {
  const OffsetLayers layers(view, samples, format_of(view.camera, Mapping::standard, storage),
                            first);
  std::vector<OffsetCount> counts(std::size(factors) * std::size(units));
  tbb::parallel_for(std::size_t{0}, counts.size(), [&](std::size_t i) {
    counts[i] =
        count_with_offset(layers, {factors[i / std::size(units)], units[i % std::size(units)], 0});
  });
  return counts;
}

BarChart chart_of(const std::string& name, const std::string& title,
                  const std::vector<Cure>& cures) {
  BarChart chart{name, title, "share of surface pixels that fight (%)", {}, {{"fighting", {}}}};
  for (const Cure& cure : cures) {
    chart.categories.push_back(cure.name);
    chart.series[0].heights.push_back(100 * cure.fights.share());
  }
  return chart;
}

Plot offset_plot(const std::vector<OffsetCount>& counts) {
  Plot plot{"offset",
            "Polygon offset: samples that are wrong, by units; hidden surfaces that show are not "
            "fights",
            "-units",
            "samples",
            true,
            false,
            {}};
  for (std::size_t k = 0; k < std::size(factors); ++k) {
    Series fights{fmt::format("factor {:g}: fights", factors[k]), {}},
        shows{fmt::format("factor {:g}: hidden shows", factors[k]), {}};
    for (std::size_t i = 1; i < std::size(units); ++i) {
      const OffsetCount& c = counts[k * std::size(units) + i];
      fights.points.emplace_back(-units[i], c.fights);
      shows.points.emplace_back(-units[i], c.shows_through);
    }
    plot.series.push_back(fights);
    plot.series.push_back(shows);
  }
  return plot;
}

std::string csv_of(const std::vector<Cure>& cures) {
  std::string text;
  for (const Cure& c : cures) {
    text += fmt::format("{},{:.17g},{},{},{:.9g}\n", c.name, c.fights.format.near,
                        c.fights.surface_pixels, c.fights.fighting, c.fights.greatest_error);
  }
  return text;
}

std::string csv_of(const std::vector<OffsetCount>& counts) {
  std::string text = "factor,units,fights,hidden_surfaces_that_show\n";
  for (const OffsetCount& c : counts) {
    text += fmt::format("{:g},{:g},{},{}\n", c.bias.slope_factor, c.bias.constant_factor, c.fights,
                        c.shows_through);
  }
  return text;
}

Json json_of(const std::vector<Cure>& cures) {
  Json list = Json::array();
  for (const Cure& c : cures) {
    list.push_back({{"cure", c.name},
                    {"surface_pixels", c.fights.surface_pixels},
                    {"fighting_pixels", c.fights.fighting}});
  }
  return list;
}

std::vector<std::vector<std::string>> rows_of(const std::vector<Cure>& cures) {
  std::vector<std::vector<std::string>> rows;
  rows.reserve(cures.size());
  for (const Cure& c : cures) {
    rows.push_back({c.name, fmt::format("{}", c.fights.fighting),
                    fmt::format("{:.3f} %", 100 * c.fights.share()),
                    fmt::format("{:.3g}", c.fights.greatest_error)});
  }
  return rows;
}

StudyFile page_of(const SceneView& view, const std::vector<Cure>& nears,
                  const std::vector<Cure>& others, const std::vector<OffsetCount>& counts) {
  Page page(fmt::format("What helps against z-fighting: {}, near {:g}, far {:g}", view.name,
                        view.camera.near, view.camera.far));
  page.paragraph(
      "Before: a standard unorm24 buffer. Depths are exact and rounded once; triangles are drawn "
      "in the order of the file, the strictly nearer code wins, and a pixel fights where that is "
      "not the exactly visible triangle.");
  const std::vector<std::string> head{"", "fighting pixels", "share", "greatest depth error"};
  page.heading("The near plane")
      .paragraph(
          "Twice as far a near plane halves the steps everywhere, up to the nearest visible "
          "surface; nothing is cut away.");
  const auto chart = [&](const char* name, const char* caption, const std::vector<Cure>& cures) {
    if (has_heights(chart_of(name, caption, cures))) {
      page.plot(name, caption);
    } else {
      page.paragraph("No pixel fights, with any of them; a nearer --near shows when they would.");
    }
    page.table(head, rows_of(cures));
  };
  chart("near", "Pixels that fight, by near plane", nears);
  page.heading("Another format");
  chart("formats", "Pixels that fight, by format", others);
  page.heading("Polygon offset");
  if (counts.empty()) {
    page.paragraph(
        "Needs a perspective camera and a scene of two or more objects, whose triangles but for "
        "the first object's are then pulled forward. This scene has not.");
  } else {
    page.paragraph(
        "The triangles of every object but the first are pulled forward by factor times the slope "
        "of their window depth plus units times the least difference of the format. Fights "
        "of these triangles go away, and surfaces that are hidden by something close before them "
        "begin to show: false positives. Where fights remain, surfaces of the first object fight "
        "with each other. A unit is the same window depth everywhere, and so a distance that "
        "grows with the square of the depth: one unit may be enough, and too much far away, where "
        "it is more than the distance to what hides the surface.");
    page.plot("offset", "Wrong samples by units, for each factor");
    std::vector<std::vector<std::string>> rows;
    rows.reserve(counts.size());
    for (const OffsetCount& c : counts) {
      rows.push_back({fmt::format("{:g}", c.bias.slope_factor),
                      fmt::format("{:g}", c.bias.constant_factor), fmt::format("{}", c.fights),
                      fmt::format("{}", c.shows_through)});
    }
    page.table({"factor", "units", "fights", "hidden surfaces that show"}, rows);
  }
  page.heading("Before and after");
  for (const char* name : {"before", "near", "reversed", "log"}) {
    page.picture(std::string("fights-") + name, std::string(name) + ": 1 where it fights");
  }
  return page.file();
}

}  // namespace

std::vector<StudyFile> study_mitigation(const StudyOptions& options,
                                        const std::function<void(double)>& tick) {
  if (options.separation || options.samples) {
    throw UsageError("the study mitigation has no --separation and no --samples");
  }
  SceneView view = options.scene ? *options.scene : panels_with_decals();
  view.camera = with_range(view, options);
  require_meaningful(format_of(view.camera, Mapping::standard, storage));
  require_gnuplot();
  const DepthMap visible = visible_map(view);
  if (!std::isfinite(nearest_depth(visible))) {
    throw UsageError("the camera sees nothing of the scene");
  }
  const std::vector<Cure> nears = near_planes(view, visible);
  tick(0.3);
  const std::vector<Cure> others = formats(view, visible);
  tick(0.6);
  std::vector<OffsetCount> counts;
  if (view.scene.objects.size() > 1 && view.camera.projection == Projection::perspective) {
    const auto first =
        static_cast<std::uint32_t>(view.scene.meshes[view.scene.objects[0].mesh].triangles.size());
    counts = offsets(view, layered_samples(view), first);
  }
  tick(0.9);

  std::vector<StudyFile> files{
      {"near.csv",
       "cure,near,surface_pixels,fighting_pixels,greatest_depth_error\n" + csv_of(nears)},
      {"formats.csv",
       "format,near,surface_pixels,fighting_pixels,greatest_depth_error\n" + csv_of(others)}};
  const auto append = [&](std::vector<StudyFile> more) {
    std::move(more.begin(), more.end(), std::back_inserter(files));
  };
  for (const BarChart& chart :
       {chart_of("near", "Pixels that fight, by near plane (standard unorm24)", nears),
        chart_of("formats", "Pixels that fight, by format", others)}) {
    if (has_heights(chart)) append(draw(chart));
  }
  if (!counts.empty()) {
    append(draw(offset_plot(counts)));
    files.push_back({"offset.csv", csv_of(counts)});
  }
  const auto show = [&](const std::string& name, double near, Mapping mapping, Storage stored) {
    SceneView moved = view;
    moved.camera.near = near;
    files.push_back(
        pictures_of(name, buffer_scene(moved, visible, format_of(moved.camera, mapping, stored)))
            .front());
  };
  show("before", view.camera.near, Mapping::standard, storage);
  show("near", nears.back().fights.format.near, Mapping::standard, storage);
  show("reversed", view.camera.near, Mapping::reversed, Storage::float32);
  show("log", view.camera.near, Mapping::log, storage);

  Json summary{{"study", "mitigation"},         {"scene", view.name},
               {"near", view.camera.near},      {"far", view.camera.far},
               {"near_planes", json_of(nears)}, {"formats", json_of(others)},
               {"offsets", Json::array()}};
  for (const OffsetCount& c : counts) {
    summary["offsets"].push_back({{"factor", c.bias.slope_factor},
                                  {"units", c.bias.constant_factor},
                                  {"fights", c.fights},
                                  {"hidden_surfaces_that_show", c.shows_through}});
  }
  append({{"summary.json", summary.dump(2) + "\n"}, page_of(view, nears, others, counts)});
  tick(1);
  return files;
}

}  // namespace fathom::studies
