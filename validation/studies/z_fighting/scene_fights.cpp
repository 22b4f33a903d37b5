#include "validation/studies/z_fighting/scene_fights.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "fathom/numeric/errors.h"
#include "validation/studies/page.h"
#include "validation/studies/plot.h"

namespace fathom::studies {
namespace {

using Json = nlohmann::ordered_json;

std::string name_of(const DepthFormat& format) {
  return std::string(fathom::name_of(format.mapping)) + "-" +
         std::string(fathom::name_of(format.storage));
}

DepthFormat format_of(const Camera& camera, Mapping mapping, Storage storage) {
  return {mapping, storage, camera.near,
          takes_infinite_far(mapping) ? std::numeric_limits<double>::infinity() : camera.far};
}

/// The formats whose pairs are measured and whose pictures are drawn.
constexpr std::pair<Mapping, Storage> shown[] = {{Mapping::standard, Storage::unorm16},
                                                 {Mapping::standard, Storage::unorm24},
                                                 {Mapping::standard, Storage::float32},
                                                 {Mapping::log, Storage::unorm16},
                                                 {Mapping::reversed, Storage::float32}};

StudyFile csv_of(const std::vector<SceneFights>& all) {
  std::string text =
      "mapping,storage,near,far,surface_pixels,fighting_pixels,greatest_depth_error\n";
  for (const SceneFights& f : all) {
    text += fmt::format("{},{},{:.17g},{:.17g},{},{},{:.9g}\n", fathom::name_of(f.format.mapping),
                        fathom::name_of(f.format.storage), f.format.near, f.format.far,
                        f.surface_pixels, f.fighting, f.greatest_error);
  }
  return {"fights.csv", text};
}

StudyFile csv_of(const std::vector<std::pair<DepthFormat, PairsByDistance>>& all) {
  std::string text = "mapping,storage,distance_up_to,greatest_lost_separation,predicted\n";
  for (const auto& [format, pairs] : all) {
    for (std::size_t i = 0; i < pairs.distances.size(); ++i) {
      text += fmt::format("{},{},{:.9g},{:.9g},{:.9g}\n", fathom::name_of(format.mapping),
                          fathom::name_of(format.storage), pairs.distances[i],
                          pairs.greatest_lost[i], pairs.predicted[i]);
    }
  }
  return {"separations.csv", text};
}

Plot separation_plot(const std::vector<std::pair<DepthFormat, PairsByDistance>>& all) {
  Plot plot{"separation",
            "Greatest separation that is lost, measured, and the width of a bin, predicted",
            "distance (scene units)",
            "separation (scene units)",
            true,
            true,
            {}};
  for (const auto& [format, pairs] : all) {
    Series measured{name_of(format) + ", measured", {}},
        predicted{name_of(format) + ", predicted", {}};
    for (std::size_t i = 0; i < pairs.distances.size(); ++i) {
      if (pairs.greatest_lost[i] > 0) {
        measured.points.emplace_back(pairs.distances[i], pairs.greatest_lost[i]);
      }
      if (pairs.predicted[i] > 0 && std::isfinite(pairs.predicted[i])) {
        predicted.points.emplace_back(pairs.distances[i], pairs.predicted[i]);
      }
    }
    plot.series.push_back(measured);
    plot.series.push_back(predicted);
  }
  std::erase_if(plot.series, [](const Series& s) { return s.points.empty(); });
  return plot;
}

StudyFile page_of(const SceneView& view, const std::vector<SceneFights>& all,
                  const std::vector<std::pair<DepthFormat, PairsByDistance>>& pairs) {
  Page page(fmt::format("Z-fighting in {}, near {:g}, far {:g}", view.name, view.camera.near,
                        view.camera.far));
  page.paragraph(
      "At every pixel all triangles that cover its centre are held against the exact answer. "
      "Depths are exact and rounded once, when they are stored; triangles are drawn in the order "
      "of the file, and the strictly nearer code wins. A pixel fights where another triangle than "
      "the visible one wins so. Triangles of one mesh fight with each other too: at an outline, "
      "where a face turns away, front and back come arbitrarily close.");
  std::vector<std::vector<std::string>> rows;
  for (const Mapping mapping : all_mappings) {
    std::vector<std::string> row{std::string(fathom::name_of(mapping))};
    for (const SceneFights& f : all) {
      if (f.format.mapping == mapping) {
        row.push_back(fmt::format("{} ({:.3f} %)", f.fighting, 100 * f.share()));
      }
    }
    rows.push_back(row);
  }
  std::vector<std::string> head{"fighting pixels"};
  for (const Storage storage : all_storages) head.emplace_back(fathom::name_of(storage));
  page.heading("Every format").table(head, rows);
  page.heading("Least safe separation");
  page.paragraph(
      "Of all pairs of the visible surface and one behind it: the greatest separation along the "
      "view at which the two are stored alike, by distance. Predicted is the width of the bin at "
      "the far end of the class of distances, which no lost separation can exceed; how near the "
      "measured ones come to it depends on which separations the scene has.");
  if (has_points(separation_plot(pairs))) {
    page.plot("separation", "Separations that are lost, by distance");
  } else {
    page.paragraph("In this view no surface lies behind another.");
  }
  page.heading("Where");
  for (const auto& [format, measured] : pairs) {
    page.picture("fights-" + name_of(format), name_of(format) + ": 1 where the wrong surface wins");
    page.picture("error-" + name_of(format), name_of(format) + ": decoded minus exact depth");
  }
  page.heading("Files").paragraph(
      "fights.csv: every format. separations.csv: pairs by distance. summary.json: all of it.");
  return page.file();
}

}  // namespace

BufferedScene buffer_scene(const SceneView& view, const DepthMap& visible,
                           const DepthFormat& format) {
  BufferedScene buffered{{.format = format}, visible};
  buffered.fights.fighting =
      add_depth_buffer(buffered.map, view.scene, view.camera, {format, true, {}}).fighting;
  const auto& id = *buffered.map.values<std::uint32_t>("id");
  const auto& error = *buffered.map.values<float>("Zerror");
  for (std::size_t i = 0; i < id.size(); ++i) {
    if (id[i] == no_surface) continue;
    ++buffered.fights.surface_pixels;
    buffered.fights.greatest_error =
        std::max(buffered.fights.greatest_error, static_cast<double>(std::abs(error[i])));
  }
  return buffered;
}

std::vector<StudyFile> pictures_of(const std::string& name, const BufferedScene& buffered) {
  const auto& fight = *buffered.map.values<std::uint32_t>("Zfight");
  const auto& error = *buffered.map.values<float>("Zerror");
  const auto& id = *buffered.map.values<std::uint32_t>("id");
  DepthMap map;
  map.width = buffered.map.width;
  map.height = buffered.map.height;
  const std::string format = std::string(fathom::name_of(buffered.fights.format.mapping)) + " " +
                             std::string(fathom::name_of(buffered.fights.format.storage));
  const std::string wrong = "wrong surface, " + format, off = "depth error, " + format;
  map.channels = {{"id", id}, {wrong, Samples<float>(fight.begin(), fight.end())}, {off, error}};
  const double end = std::max(buffered.fights.greatest_error, 1e-30);
  return {picture("fights-" + name, map,
                  {.channel = wrong, .colours = ColourMap::grey, .low = 0, .high = 1}),
          picture("error-" + name, map,
                  {.channel = off, .colours = ColourMap::viridis, .low = -end, .high = end})};
}

std::vector<StudyFile> study_scene_fights(const StudyOptions& options,
                                          const std::function<void(double)>& tick) {
  if (options.separation || options.samples) {
    throw UsageError("the study z-fighting takes no --separation and no --samples with --scene");
  }
  SceneView view = *options.scene;
  view.camera = with_range(view, options);
  require_meaningful(format_of(view.camera, Mapping::standard, Storage::unorm16));
  require_gnuplot();
  const DepthMap visible = visible_map(view);

  std::vector<SceneFights> all;
  for (const Mapping mapping : all_mappings) {
    for (const Storage storage : all_storages) {
      all.push_back(buffer_scene(view, visible, format_of(view.camera, mapping, storage)).fights);
      tick(0.6 * static_cast<double>(all.size()) / 54);
    }
  }
  const std::vector<LayeredSample> samples = layered_samples(view);
  std::vector<std::pair<DepthFormat, PairsByDistance>> pairs;
  std::vector<StudyFile> files;
  const auto append = [&](std::vector<StudyFile> more) {
    std::move(more.begin(), more.end(), std::back_inserter(files));
  };
  for (const auto& [mapping, storage] : shown) {
    const DepthFormat format = format_of(view.camera, mapping, storage);
    pairs.emplace_back(format, pairs_by_distance(samples, format));
    append(pictures_of(name_of(format), buffer_scene(view, visible, format)));
  }
  tick(0.9);

  Json summary{{"study", "z-fighting"},
               {"scene", view.name},
               {"near", view.camera.near},
               {"far", view.camera.far},
               {"width", view.camera.width},
               {"height", view.camera.height},
               {"layered_samples", samples.size()}};
  for (const SceneFights& f : all) {
    summary["formats"].push_back({{"mapping", fathom::name_of(f.format.mapping)},
                                  {"storage", fathom::name_of(f.format.storage)},
                                  {"surface_pixels", f.surface_pixels},
                                  {"fighting_pixels", f.fighting},
                                  {"greatest_depth_error", f.greatest_error}});
  }
  for (const auto& [format, measured] : pairs) {
    summary["separations"].push_back({{"mapping", fathom::name_of(format.mapping)},
                                      {"storage", fathom::name_of(format.storage)},
                                      {"distance_up_to", measured.distances},
                                      {"greatest_lost", measured.greatest_lost},
                                      {"predicted", measured.predicted}});
  }
  const Plot plot = separation_plot(pairs);
  if (has_points(plot)) append(draw(plot));
  append({csv_of(all),
          csv_of(pairs),
          {"summary.json", summary.dump(2) + "\n"},
          page_of(view, all, pairs)});
  tick(1);
  return files;
}

}  // namespace fathom::studies
