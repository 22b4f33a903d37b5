#include "validation/studies/z_fighting/z_fighting.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "fathom/numeric/errors.h"
#include "validation/studies/page.h"
#include "validation/studies/plot.h"
#include "validation/studies/sampling.h"
#include "validation/studies/z_fighting/coplanar_pair.h"
#include "validation/studies/z_fighting/fights_by_angle.h"
#include "validation/studies/z_fighting/scene_fights.h"

namespace fathom::studies {
namespace {

using Json = nlohmann::ordered_json;

constexpr double tilt = 0.57735026918962573;  // tan 30°
constexpr int distance_count = 25;
constexpr int heat_cells = 36;

struct Pairs {
  double near, far, separation;
  int samples;
  std::vector<double> distances;
};

/// One format at one distance. A pipeline's share is NaN where the mapping is no projection.
struct Fight {
  DepthFormat format;
  double distance;
  double ideal, separate, premultiplied;
  double safe, predicted;
};

DepthFormat format_of(Mapping mapping, Storage storage, double near, double far) {
  return {mapping, storage, near,
          takes_infinite_far(mapping) ? std::numeric_limits<double>::infinity() : far};
}

bool is_projection(Mapping mapping) {
  return mapping <= Mapping::opengl;
}

Fight measure(const DepthFormat& format, const Pairs& scene, double distance) {
  const CoplanarPair pair{distance, scene.separation, tilt};
  const View view = default_view(scene.near);
  const auto in_pipeline = [&](bool premultiplied) {
    if (!is_projection(format.mapping)) return std::numeric_limits<double>::quiet_NaN();
    const PipelineModel model{format, view.row, premultiplied, {}};
    return fighting_share_in_pipeline(model, view, pair, scene.samples);
  };
  return {format,
          distance,
          fighting_share(format, pair, scene.samples),
          in_pipeline(false),
          in_pipeline(true),
          least_safe_separation(format, pair, scene.samples),
          predicted_safe_separation(format, pair)};
}

std::vector<Fight> measure_all(const Pairs& scene, const std::function<void(double)>& tick) {
  std::vector<Fight> fights;
  for (const Mapping mapping : all_mappings) {
    for (const Storage storage : all_storages) {
      const DepthFormat format = format_of(mapping, storage, scene.near, scene.far);
      const std::size_t first = fights.size();
      fights.resize(first + scene.distances.size());
      tbb::parallel_for(std::size_t{0}, scene.distances.size(), [&](std::size_t i) {
        fights[first + i] = measure(format, scene, scene.distances[i]);
      });
      tick(0.7 * static_cast<double>(first) / (54.0 * distance_count));
    }
  }
  return fights;
}

std::string number_or_nothing(double x) {
  return std::isnan(x) ? "" : fmt::format("{:.17g}", x);
}

StudyFile csv_of(const std::vector<Fight>& fights, double separation) {
  std::string text =
      "mapping,storage,distance,separation,wrong_ideal,wrong_pipeline_separate,"
      "wrong_pipeline_premultiplied,least_safe_separation,predicted_safe_separation\n";
  for (const Fight& f : fights) {
    text += fmt::format("{},{},{:.17g},{:.17g},{:.17g},{},{},{:.17g},{:.17g}\n",
                        name_of(f.format.mapping), name_of(f.format.storage), f.distance,
                        separation, f.ideal, number_or_nothing(f.separate),
                        number_or_nothing(f.premultiplied), f.safe, f.predicted);
  }
  return {"fights.csv", text};
}

Json json_of(const std::vector<Fight>& fights) {
  Json list = Json::array();
  for (const Fight& f : fights) {  // NaN and infinity become null
    list.push_back({{"mapping", name_of(f.format.mapping)},
                    {"storage", name_of(f.format.storage)},
                    {"distance", f.distance},
                    {"wrong_ideal", f.ideal},
                    {"wrong_pipeline_separate", f.separate},
                    {"wrong_pipeline_premultiplied", f.premultiplied},
                    {"least_safe_separation", f.safe},
                    {"predicted_safe_separation", f.predicted}});
  }
  return list;
}

Plot safe_plot(const std::vector<Fight>& fights, Storage storage) {
  Plot plot{"safe-" + std::string(name_of(storage)),
            fmt::format("Least separation without z-fighting, {}", name_of(storage)),
            "distance (scene units)",
            "separation (scene units)",
            true,
            true,
            {}};
  for (const Mapping mapping : all_mappings) {
    if (mapping == Mapping::opengl) continue;  // as standard
    Series series{std::string(name_of(mapping)), {}};
    for (const Fight& f : fights) {
      const bool shown = f.format.mapping == mapping && f.format.storage == storage;
      if (shown && std::isfinite(f.safe) && f.safe > 0) {
        series.points.emplace_back(f.distance, f.safe);
      }
    }
    plot.series.push_back(series);
  }
  return plot;
}

Plot share_plot(const std::vector<Fight>& fights, const Pairs& scene) {
  Plot plot{"share",
            fmt::format("Samples where the wrong surface wins, separation {:g}", scene.separation),
            "distance (scene units)",
            "share of samples (%)",
            true,
            false,
            {}};
  const auto add = [&](Mapping mapping, Storage storage, const char* model, auto share) {
    Series series{fmt::format("{} {}, {}", name_of(mapping), name_of(storage), model), {}};
    for (const Fight& f : fights) {
      if (f.format.mapping == mapping && f.format.storage == storage) {
        series.points.emplace_back(f.distance, 100 * share(f));
      }
    }
    plot.series.push_back(series);
  };
  const auto ideal = [](const Fight& f) { return f.ideal; };
  const auto premultiplied = [](const Fight& f) { return f.premultiplied; };
  add(Mapping::standard, Storage::unorm16, "ideal", ideal);
  for (const Storage storage : {Storage::unorm24, Storage::float32}) {
    for (const Mapping mapping : {Mapping::standard, Mapping::reversed}) {
      add(mapping, storage, "ideal", ideal);
      add(mapping, storage, "pipeline", premultiplied);
    }
  }
  return plot;
}

/// The share over distance and separation, for one format.
HeatMap heat_map(const DepthFormat& format, const Pairs& scene) {
  HeatMap map{fmt::format("heat-{}-{}", name_of(format.mapping), name_of(format.storage)),
              fmt::format("Samples where the wrong surface wins, {} {}, ideal model",
                          name_of(format.mapping), name_of(format.storage)),
              "log10 of the distance",
              "log10 of the separation",
              "share of samples (%)",
              {},
              {},
              std::vector<double>(static_cast<std::size_t>(heat_cells) * heat_cells)};
  const double from = std::log10(2 * scene.near), to = std::log10(scene.far / 2);
  for (int i = 0; i < heat_cells; ++i) {
    map.x.push_back(from + (to - from) * i / (heat_cells - 1));
    map.y.push_back(-8 + 8.0 * i / (heat_cells - 1));
  }
  tbb::parallel_for(0, heat_cells * heat_cells, [&](int cell) {
    const double distance = std::pow(10, map.x[static_cast<std::size_t>(cell % heat_cells)]);
    const double separation = std::pow(10, map.y[static_cast<std::size_t>(cell / heat_cells)]);
    map.values[static_cast<std::size_t>(cell)] =
        100 * fighting_share(format, {distance, separation, tilt}, 32);
  });
  return map;
}

std::string percent(double share) {
  return std::isnan(share) ? "" : fmt::format("{:.1f} %", 100 * share);
}

StudyFile page_of(const Pairs& scene, const std::vector<Fight>& fights,
                  const std::vector<FightByAngle>& by_angle) {
  Page page(fmt::format("Z-fighting, near {:g}, far {:g}", scene.near, scene.far));
  page.paragraph(fmt::format(
      "Two parallel surfaces, tilted by 30 degrees, one {:g} behind the other along the view, fill "
      "a patch of the image. The one behind is drawn first, and stays wherever the one in front is "
      "not stored as strictly nearer: there the wrong surface wins. Ideal model: depths are exact "
      "and rounded once, when they are stored. Pipeline model: matrices, vertices and "
      "interpolation "
      "in binary32. Depths beyond near or far are taken as these.",
      scene.separation));
  page.heading("What is seen");
  page.paragraph(
      "In the ideal model surfaces begin to fight where their separation falls below the width of "
      "a "
      "bin of the format, which grows with the square of the distance for standard in any storage. "
      "In the pipeline, standard with premultiplied matrices fights at shorter distances: each "
      "surface errs by itself, through the rounded window depths of its vertices, and then whole "
      "surfaces swap, not single samples. Reversed float32 has nothing to fight about here.");
  page.plot("share", "Share of wrong samples against distance");
  std::vector<std::vector<std::string>> rows;
  for (const Fight& f : fights) {
    const bool shown =
        f.format.mapping == Mapping::standard &&
        (f.format.storage == Storage::unorm16 || f.format.storage == Storage::unorm32 ||
         f.format.storage == Storage::float32);
    if (!shown) continue;
    rows.push_back({std::string(name_of(f.format.storage)), fmt::format("{:.4g}", f.distance),
                    percent(f.ideal), percent(f.separate), percent(f.premultiplied),
                    fmt::format("{:.3g}", f.safe), fmt::format("{:.3g}", f.predicted)});
  }
  page.table({"standard", "distance", "wrong, ideal", "pipeline, separate",
              "pipeline, premultiplied", "least safe separation", "predicted"},
             rows);
  page.heading("Least safe separation");
  page.paragraph(
      "The greatest separation that a sample of the patch needs; the prediction is the width of "
      "the "
      "bin of the farthest depth of the patch.");
  for (const char* storage : {"unorm16", "unorm24", "float32"}) {
    page.plot(std::string("safe-") + storage, fmt::format("Least safe separation, {}", storage));
  }
  add_to_page(by_angle, page);
  page.heading("Distance and separation");
  for (const char* format :
       {"standard-unorm16", "standard-unorm24", "log-unorm24", "reversed-float32"}) {
    page.plot(std::string("heat-") + format, format);
  }
  page.heading("Files");
  page.paragraph(
      "fights.csv: every format at every distance. angles.csv: by tilt. summary.json: the same. "
      "*.gp: the scripts of "
      "the "
      "plots, for gnuplot.");
  return page.file();
}

Pairs pairs_of(const StudyOptions& options) {
  Pairs scene{options.near.value_or(0.1),
              options.far.value_or(100),
              options.separation.value_or(0.0001),
              64,
              {}};
  require_meaningful({Mapping::standard, Storage::float32, scene.near, scene.far});
  if (scene.near < 1e-15 || scene.far > 1e15 || scene.far < 8 * scene.near) {
    throw UsageError(
        "near and far of this study lie between 1e-15 and 1e15, far at least 8 times near");
  }
  if (!(scene.separation > 0) || scene.separation > scene.far) {
    throw UsageError("--separation is not between 0 and far");
  }
  const std::uint32_t samples = options.samples.value_or(64);
  if (samples < 2 || samples > 10000) throw UsageError("--samples is not from 2 to 10000");
  scene.samples = static_cast<int>(samples);
  scene.distances = logarithmic_samples(2 * scene.near, scene.far / 2, distance_count);
  return scene;
}

}  // namespace

std::vector<StudyFile> study_z_fighting(const StudyOptions& options,
                                        const std::function<void(double)>& tick) {
  if (options.scene) return study_scene_fights(options, tick);
  const Pairs scene = pairs_of(options);
  require_gnuplot();
  const std::vector<Fight> fights = measure_all(scene, tick);

  const AngleSweep sweep{scene.near,
                         scene.far,
                         scene.separation,
                         scene.samples,
                         {scene.distances[8], scene.distances[20]}};
  const std::vector<FightByAngle> by_angle = fights_by_angle(sweep);

  const Json summary{{"study", "z-fighting"},     {"near", scene.near},
                     {"far", scene.far},          {"separation", scene.separation},
                     {"tilt_degrees", 30},        {"samples", scene.samples},
                     {"fights", json_of(fights)}, {"by_angle", json_of(by_angle)}};
  std::vector<StudyFile> files{csv_of(fights, scene.separation),
                               {"summary.json", summary.dump(2) + "\n"}};
  const auto append = [&](std::vector<StudyFile> more) {
    std::move(more.begin(), more.end(), std::back_inserter(files));
  };
  append(draw(share_plot(fights, scene)));
  append(files_of(by_angle, sweep));
  for (const Storage storage : {Storage::unorm16, Storage::unorm24, Storage::float32}) {
    append(draw(safe_plot(fights, storage)));
  }
  const auto heat = [&](Mapping mapping, Storage storage) {
    append(draw(heat_map(format_of(mapping, storage, scene.near, scene.far), scene)));
  };
  heat(Mapping::standard, Storage::unorm16);
  heat(Mapping::standard, Storage::unorm24);
  heat(Mapping::log, Storage::unorm24);
  heat(Mapping::reversed, Storage::float32);
  files.push_back(page_of(scene, fights, by_angle));
  tick(1);
  return files;
}

}  // namespace fathom::studies
