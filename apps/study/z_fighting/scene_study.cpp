#include "apps/study/page.h"
#include "apps/study/results.h"
#include "apps/study/study.h"
#include "apps/study/sweeps.h"
#include "apps/study/z_fighting/scene_fights.h"
#include "fathom/failures/errors.h"

namespace fathom::studies {
namespace {

/// The separations that a format loses.
struct FormatLosses {
  DepthFormat format;
  std::vector<LostSeparation> lost;
};

DepthFormat format_of(const Camera& camera, Mapping mapping, Storage storage) {
  return format_between(camera.near, camera.far, mapping, storage);
}

Table fights_table(const std::vector<SceneFights>& rows) {
  using Row = SceneFights;
  return {rows,
          {{"mapping", mapping_of},
           {"storage", storage_of},
           {Column("near").csv_only(), [](const Row& f) { return f.format.near; }},
           {Column("far").csv_only(), [](const Row& f) { return f.format.far; }},
           {"surface_pixels", &Row::surface_pixels},
           {"fighting_pixels", &Row::fighting},
           {Column("greatest_depth_error", ".9g"), &Row::greatest_error}}};
}

std::string fighting_text(const SceneFights& fights) {
  if (fights.fighting == 0) return "0";
  return std::to_string(fights.fighting) + " (" + text_of(100 * fights.share(), ".3f") + " %)";
}

/// For the page: a row of fighting pixels for each mapping, by storage. Rows are ordered by
/// mapping.
Table fights_by_mapping(const std::vector<SceneFights>& rows) {
  std::vector<ColumnOf<Mapping>> columns{
      {heading("fighting pixels"), [](Mapping mapping) { return name_of(mapping); }}};
  for (const Storage storage : all_storages) {
    columns.push_back({heading(std::string(name_of(storage))), [&rows, storage](Mapping mapping) {
                         const auto fights =
                             std::find_if(rows.begin(), rows.end(), [&](const SceneFights& f) {
                               return f.format.mapping == mapping && f.format.storage == storage;
                             });
                         return fighting_text(*fights);
                       }});
  }
  return {std::vector<Mapping>(std::begin(all_mappings), std::end(all_mappings)), columns};
}

/// A row for each format and distance.
Table separations_table(const std::vector<FormatLosses>& all) {
  struct Row {
    DepthFormat format;
    LostSeparation at;
  };
  std::vector<Row> rows;
  for (const FormatLosses& f : all) {
    for (const LostSeparation& lost : f.lost) rows.push_back({f.format, lost});
  }
  return {
      rows,
      {{"mapping", mapping_of},
       {"storage", storage_of},
       {Column("distance_up_to", ".9g"), [](const Row& r) { return r.at.distance; }},
       {Column("greatest_lost_separation", ".9g"), [](const Row& r) { return r.at.greatest_lost; }},
       {Column("predicted", ".9g"), [](const Row& r) { return r.at.predicted; }}}};
}

/// The same, a row for each format.
Table separation_lists(const std::vector<FormatLosses>& rows) {
  const auto list = [](double LostSeparation::*member) {
    return [member](const FormatLosses& f) {
      std::vector<double> numbers;
      for (const LostSeparation& lost : f.lost) numbers.push_back(lost.*member);
      return numbers;
    };
  };
  return {rows,
          {{"mapping", mapping_of},
           {"storage", storage_of},
           {"distance_up_to", list(&LostSeparation::distance)},
           {"greatest_lost", list(&LostSeparation::greatest_lost)},
           {"predicted", list(&LostSeparation::predicted)}}};
}

Plot separation_plot(const std::vector<FormatLosses>& all) {
  Plot plot{
      .name = "separation",
      .title = "Greatest separation that is lost, measured, and the width of a bin, predicted",
      .x_label = "distance (scene units)",
      .y_label = "separation (scene units)",
      .logarithmic_x = true,
      .logarithmic_y = true};
  for (const FormatLosses& f : all) {
    const std::string name = file_name_of(f.format);
    plot.series.push_back(series_of(name + ", measured", f.lost, &LostSeparation::distance,
                                    &LostSeparation::greatest_lost));
    plot.series.push_back(series_of(name + ", predicted", f.lost, &LostSeparation::distance,
                                    &LostSeparation::predicted));
  }
  return plot;
}

std::vector<SceneFights> measure_all(const SceneView& view, const DepthMap& visible,
                                     const std::function<void(double)>& tick) {
  std::vector<SceneFights> all;
  for (const Mapping mapping : all_mappings) {
    for (const Storage storage : all_storages) {
      all.push_back(buffer_scene(view, visible, format_of(view.camera, mapping, storage)).fights);
      tick(static_cast<double>(all.size()) /
           static_cast<double>(std::size(all_mappings) * std::size(all_storages)));
    }
  }
  return all;
}

/// The formats whose separations are measured and whose pictures are drawn.
std::vector<DepthFormat> shown_formats(const Camera& camera) {
  return {format_of(camera, Mapping::standard, Storage::unorm16),
          format_of(camera, Mapping::standard, Storage::unorm24),
          format_of(camera, Mapping::standard, Storage::float32),
          format_of(camera, Mapping::log, Storage::unorm16),
          format_of(camera, Mapping::reversed, Storage::float32)};
}

}  // namespace

std::vector<StudyFile> study_scene_fights(const StudyOptions& options,
                                          const std::function<void(double)>& tick) {
  if (options.separation || options.samples) {
    throw UsageError("the study z-fighting takes no --separation and no --samples with --scene");
  }
  SceneView view = *options.scene;
  view.camera = with_range(view, options);
  require_meaningful(format_of(view.camera, Mapping::standard, Storage::unorm16));
  require_gnuplot(options);
  const DepthMap visible = visible_map(view);
  const std::vector<SceneFights> fights =
      measure_all(view, visible, [&](double share) { tick(0.6 * share); });
  const std::vector<LayeredSample> samples = layered_samples(view);
  std::vector<FormatLosses> losses;
  for (const DepthFormat& format : shown_formats(view.camera)) {
    losses.push_back({format, lost_separations(samples, format)});
  }
  tick(0.9);

  Results results("z-fighting", page_texts::scene_fights, options);
  results.figure("scene", view.name);
  results.figure("near", view.camera.near);
  results.figure("far", view.camera.far);
  results.figure("width", view.camera.width);
  results.figure("height", view.camera.height);
  results.figure("layered_samples", samples.size());
  const auto most = std::max_element(
      fights.begin(), fights.end(),
      [](const SceneFights& a, const SceneFights& b) { return a.fighting < b.fighting; });
  results.quote("formats", fights.size());
  results.quote("formats_without", std::count_if(fights.begin(), fights.end(),
                                                 [](const auto& f) { return f.fighting == 0; }));
  results.quote("pixels", most->surface_pixels);
  results.quote("most", most->fighting);
  results.quote("worst", file_name_of(most->format));
  results.table(fights_table(fights), {.csv = "fights", .json = "formats"});
  results.table(fights_by_mapping(fights), {.page = "fights"});
  results.table(separations_table(losses), {.csv = "separations"});
  results.table(separation_lists(losses), {.json = "separations"});
  results.plot(separation_plot(losses));
  results.file(camera_file("camera", view.camera));
  for (const DepthFormat& format : shown_formats(view.camera)) {
    const std::string name = file_name_of(format);
    const BufferedScene buffered = buffer_scene(view, visible, format);
    for (const auto& [png, command] : pictures_of(name, buffered, view.name, "camera.json"))
      results.picture(png, command);
  }
  tick(1);
  return results.files();
}

}  // namespace fathom::studies
