#include <functional>
#include <limits>
#include <optional>

#include "apps/study/page.h"
#include "apps/study/results.h"
#include "apps/study/study.h"
#include "apps/study/sweeps.h"
#include "apps/study/z_fighting/coplanar_pair.h"
#include "fathom/failures/errors.h"

namespace fathom::studies {
namespace {

Table fights_table(const std::vector<FightByDistance>& rows, double separation) {
  using Row = FightByDistance;
  return {rows,
          {{"mapping", mapping_of},
           {Column("storage").page("standard"), storage_of},
           {Column("distance").page("distance", ".4g"), &Row::distance},
           {Column("separation").csv_only(), [separation](const Row&) { return separation; }},
           {Column("wrong_ideal").percent("wrong, ideal", ".1f"), &Row::ideal},
           {Column("wrong_pipeline_separate").percent("pipeline, separate", ".1f"), &Row::separate},
           {Column("wrong_pipeline_premultiplied").percent("pipeline, premultiplied", ".1f"),
            &Row::premultiplied},
           {Column("least_safe_separation").page("least safe separation", ".3g"), &Row::safe},
           {Column("predicted_safe_separation").page("predicted", ".3g"), &Row::predicted}}};
}

/// What the page shows of them: the mapping standard, in three storages.
std::vector<FightByDistance> shown_of(const std::vector<FightByDistance>& rows) {
  return rows_where(rows, [](const FightByDistance& f) {
    const Storage storage = f.format.storage;
    return f.format.mapping == Mapping::standard &&
           (storage == Storage::unorm16 || storage == Storage::unorm32 ||
            storage == Storage::float32);
  });
}

Table angles_table(const std::vector<FightByAngle>& rows) {
  using Row = FightByAngle;
  return {rows,
          {{"mapping", mapping_of},
           {"storage", storage_of},
           {Column("degrees", "g"), &Row::degrees},
           {Column("distance", ".9g"), &Row::distance},
           {Column("wrong_ideal", ".6g"), &Row::ideal},
           {Column("wrong_pipeline_premultiplied", ".6g"), &Row::premultiplied},
           {Column("least_safe_separation", ".9g"), &Row::safe},
           {Column("predicted_safe_separation", ".9g"), &Row::predicted}}};
}

/// How far a format keeps the surfaces apart: up to the last distance before the first fight.
struct SafeReach {
  DepthFormat format;
  std::optional<double> ideal, pipeline;  ///< nothing where they fight at the first distance
  bool has_pipeline;                      ///< the pipeline has matrices only for projections
};

template <class Share>
std::optional<double> reach_of(const std::vector<FightByDistance>& rows, const Share& share) {
  std::optional<double> reach;
  for (const FightByDistance& f : rows) {
    const std::optional<double> wrong = std::invoke(share, f);
    if (!wrong || *wrong > 0) break;
    reach = f.distance;
  }
  return reach;
}

std::vector<SafeReach> safe_reaches(const std::vector<FightByDistance>& rows) {
  std::vector<SafeReach> reaches;
  for (const Storage storage : {Storage::unorm16, Storage::unorm24, Storage::float32}) {
    for (const Mapping mapping : {Mapping::standard, Mapping::reversed, Mapping::log}) {
      const auto of_format = rows_where(rows, [&](const FightByDistance& f) {
        return f.format.mapping == mapping && f.format.storage == storage;
      });
      reaches.push_back({of_format.front().format, reach_of(of_format, &FightByDistance::ideal),
                         reach_of(of_format, &FightByDistance::premultiplied),
                         of_format.front().premultiplied.has_value()});
    }
  }
  return reaches;
}

std::string reach_text(const std::optional<double>& reach) {
  return reach ? text_of(*reach, ".3g") : "fights at once";
}

Table reaches_table(const std::vector<SafeReach>& rows) {
  using Row = SafeReach;
  return {
      rows,
      {{heading("format"), [](const Row& r) { return label_of(r.format); }},
       {heading("safe up to distance, ideal"), [](const Row& r) { return reach_text(r.ideal); }},
       {heading("pipeline, premultiplied"),
        [](const Row& r) { return r.has_pipeline ? reach_text(r.pipeline) : "–"; }}}};
}

/// `y` of the fights in one format, by distance.
template <class Y>
Series series_of_format(std::string label, const std::vector<FightByDistance>& rows,
                        Mapping mapping, Storage storage, Y y) {
  const auto is_shown = [&](const FightByDistance& f) {
    return f.format.mapping == mapping && f.format.storage == storage;
  };
  return series_of(std::move(label), rows_where(rows, is_shown), &FightByDistance::distance, y);
}

Plot share_plot(const std::vector<FightByDistance>& rows, double separation) {
  Plot plot{.name = "share",
            .title = "Samples where the wrong surface wins, separation " + text_of(separation, "g"),
            .x_label = "distance (scene units)",
            .y_label = "share of samples (%)",
            .logarithmic_x = true};
  const auto add = [&](Mapping mapping, Storage storage, const char* model, auto percent) {
    const std::string label = label_of({mapping, storage}) + ", " + model;
    plot.series.push_back(series_of_format(label, rows, mapping, storage, percent));
  };
  const auto ideal = [](const FightByDistance& f) { return 100 * f.ideal; };
  const auto premultiplied = [](const FightByDistance& f) {
    return 100 * f.premultiplied.value_or(std::numeric_limits<double>::quiet_NaN());
  };
  add(Mapping::standard, Storage::unorm16, "ideal", ideal);
  for (const Storage storage : {Storage::unorm24, Storage::float32}) {
    for (const Mapping mapping : {Mapping::standard, Mapping::reversed}) {
      add(mapping, storage, "ideal", ideal);
      add(mapping, storage, "pipeline", premultiplied);
    }
  }
  return plot;
}

Plot safe_plot(const std::vector<FightByDistance>& rows, Storage storage) {
  const std::string stored(name_of(storage));
  Plot plot{.name = "safe-" + stored,
            .title = "Least separation without z-fighting, " + stored,
            .x_label = "distance (scene units)",
            .y_label = "separation (scene units)",
            .logarithmic_x = true,
            .logarithmic_y = true};
  for (const Mapping mapping : all_mappings) {
    if (mapping == Mapping::opengl) continue;  // as standard
    plot.series.push_back(series_of_format(std::string(name_of(mapping)), rows, mapping, storage,
                                           &FightByDistance::safe));
  }
  return plot;
}

/// A line for each format and distance.
template <class Y>
std::vector<Series> series_by_angle(const std::vector<FightByAngle>& rows, Y y) {
  std::vector<Series> all;
  for (const FightByAngle& f : rows) {
    const std::string label = label_of(f.format) + ", distance " + text_of(f.distance, ".3g");
    if (all.empty() || all.back().label != label) all.push_back({label, {}});
    all.back().points.emplace_back(f.degrees, std::invoke(y, f));
  }
  return all;
}

Plot angle_share_plot(const std::vector<FightByAngle>& rows, double separation) {
  return {.name = "angle-share",
          .title = "Samples where the wrong surface wins, separation " + text_of(separation, "g") +
                   ", by tilt",
          .x_label = "tilt (degrees)",
          .y_label = "share of samples (%)",
          .series = series_by_angle(rows, [](const FightByAngle& f) { return 100 * f.ideal; })};
}

Plot angle_safe_plot(const std::vector<FightByAngle>& rows) {
  return {.name = "angle-safe",
          .title = "Least separation without z-fighting, by tilt",
          .x_label = "tilt (degrees)",
          .y_label = "separation (scene units)",
          .logarithmic_y = true,
          .series = series_by_angle(rows, &FightByAngle::safe)};
}

HeatMap heat_map(const SurfacePair& surfaces, Mapping mapping, Storage storage) {
  const DepthFormat format = format_between(surfaces.near, surfaces.far, mapping, storage);
  FightsByDistanceAndSeparation fights = fights_by_distance_and_separation(format, surfaces);
  for (double& share : fights.shares) share *= 100;
  return {.name = "heat-" + file_name_of(format),
          .title = "Samples where the wrong surface wins, " + label_of(format) + ", ideal model",
          .x_label = "log10 of the distance",
          .y_label = "log10 of the separation",
          .value_label = "share of samples (%)",
          .x = fights.log_distances,
          .y = fights.log_separations,
          .values = fights.shares};
}

SurfacePair surfaces_of(const StudyOptions& options) {
  const std::uint32_t samples = options.samples.value_or(64);
  const SurfacePair surfaces{options.near.value_or(0.1), options.far.value_or(100),
                             options.separation.value_or(0.0001), static_cast<int>(samples)};
  require_meaningful({Mapping::standard, Storage::float32, surfaces.near, surfaces.far});
  if (surfaces.near < 1e-15 || surfaces.far > 1e15 || surfaces.far < 8 * surfaces.near) {
    throw UsageError(
        "near and far of this study lie between 1e-15 and 1e15, far at least 8 times near");
  }
  if (!(surfaces.separation > 0) || surfaces.separation > surfaces.far) {
    throw UsageError("--separation is not between 0 and far");
  }
  if (samples < 2 || samples > 10000) throw UsageError("--samples is not from 2 to 10000");
  return surfaces;
}

}  // namespace

std::vector<StudyFile> study_z_fighting(const StudyOptions& options,
                                        const std::function<void(double)>& tick) {
  if (options.scene) return study_scene_fights(options, tick);
  const SurfacePair surfaces = surfaces_of(options);
  require_gnuplot(options);
  const auto& [near, far, separation, samples] = surfaces;
  const std::vector<double> distances = logarithmic_samples(2 * near, far / 2, 25);
  const std::vector<FightByDistance> fights =
      fights_by_distance(surfaces, distances, [&](double share) { tick(0.7 * share); });
  const std::vector<FightByAngle> by_angle =
      fights_by_angle({near, far, separation, samples, {distances[8], distances[20]}});

  Results results("z-fighting", page_texts::z_fighting, options);
  results.figure("near", near);
  results.figure("far", far);
  results.figure("separation", separation);
  results.figure("tilt_degrees", 30);
  results.figure("samples", samples);
  results.table(reaches_table(safe_reaches(fights)), {.page = "answer"});
  results.table(fights_table(fights, separation), {.csv = "fights", .json = "fights"});
  results.table(fights_table(shown_of(fights), separation), {.page = "fights"});
  results.table(angles_table(by_angle), {.csv = "angles", .json = "by_angle"});
  results.plot(share_plot(fights, separation));
  results.plot(angle_share_plot(by_angle, separation));
  results.plot(angle_safe_plot(by_angle));
  for (const Storage storage : {Storage::unorm16, Storage::unorm24, Storage::float32}) {
    results.plot(safe_plot(fights, storage));
  }
  results.plot(heat_map(surfaces, Mapping::standard, Storage::unorm16));
  results.plot(heat_map(surfaces, Mapping::standard, Storage::unorm24));
  results.plot(heat_map(surfaces, Mapping::log, Storage::unorm24));
  results.plot(heat_map(surfaces, Mapping::reversed, Storage::float32));
  tick(1);
  return results.files();
}

}  // namespace fathom::studies
