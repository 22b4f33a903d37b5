#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "apps/study/cell.h"
#include "apps/study/page.h"
#include "apps/study/pipeline_scenes.h"
#include "apps/study/results.h"
#include "apps/study/study.h"
#include "apps/study/sweeps.h"
#include "apps/study/z_fighting/scene_fights.h"
#include "fathom/failures/errors.h"

namespace fathom::studies {
namespace {

/// The storage that is to be cured. Cures keep it unless they name another one.
constexpr Storage uncured_storage = Storage::unorm24;

/// The whole scene in another format, or with another near plane.
struct Cure {
  std::string name;
  SceneFights fights;
};

constexpr double offset_factors[] = {0, -0.5, -1, -2, -4};
constexpr double offset_units[] = {0, -1, -2, -4, -16, -64, -256, -1024, -4096};

DepthFormat uncured_format(const Camera& camera) {
  return format_between(camera.near, camera.far, Mapping::standard, uncured_storage);
}

/// The least visible depth; +∞ if nothing is visible.
double nearest_depth(const DepthMap& visible) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const float z : *visible.values<float>("Z")) {
    nearest = std::min(nearest, static_cast<double>(z));
  }
  return nearest;
}

/// Near planes farther and farther away, by factors of two, up to the nearest visible surface, so
/// that nothing is cut away.
std::vector<Cure> farther_near_planes(const SceneView& view, const DepthMap& visible) {
  std::vector<Cure> cures;
  const double nearest = 0.999 * nearest_depth(visible);
  for (double near = view.camera.near;; near = std::min(2 * near, nearest)) {
    SceneView moved = view;
    moved.camera.near = near;
    cures.push_back({"near " + text_of(near, ".3g"),
                     buffer_scene(moved, visible, uncured_format(moved.camera)).fights});
    if (near >= nearest) return cures;
  }
}

std::vector<Cure> other_formats(const SceneView& view, const DepthMap& visible) {
  constexpr std::pair<Mapping, Storage> all[] = {
      {Mapping::standard, uncured_storage},  {Mapping::standard, Storage::unorm32},
      {Mapping::standard, Storage::float32}, {Mapping::reversed, uncured_storage},
      {Mapping::reversed, Storage::float32}, {Mapping::reversed_infinite, Storage::float32},
      {Mapping::linear, uncured_storage},    {Mapping::log, uncured_storage},
      {Mapping::log, Storage::float32},      {Mapping::log_ulrich, uncured_storage}};
  std::vector<Cure> cures;
  for (const auto& [mapping, storage] : all) {
    const DepthFormat format = format_between(view.camera.near, view.camera.far, mapping, storage);
    cures.push_back({label_of(format), buffer_scene(view, visible, format).fights});
  }
  return cures;
}

/// Polygon offset, factor by factor, for the triangles of all objects except the first. Empty for a
/// single object, or without perspective.
std::vector<OffsetCount> polygon_offsets(const SceneView& view) {
  if (view.scene.objects.size() < 2 || !is_perspective(view.camera.projection)) return {};
  const auto first =
      static_cast<std::uint32_t>(view.scene.meshes[view.scene.objects[0].mesh].triangles.size());
  const std::vector<LayeredSample> samples = layered_samples(view);
  const OffsetLayers layers(view, samples, uncured_format(view.camera), first);
  constexpr std::size_t units = std::size(offset_units);
  std::vector<OffsetCount> counts(std::size(offset_factors) * units);
  tbb::parallel_for(std::size_t{0}, counts.size(), [&](std::size_t i) {
    counts[i] = count_with_offset(layers, {offset_factors[i / units], offset_units[i % units], 0});
  });
  return counts;
}

/// `key` names the cures in the CSV.
Table cures_table(const std::vector<Cure>& rows, const std::string& key) {
  using Row = Cure;
  return {rows,
          {{Column(key).json("cure").page(""), &Row::name},
           {Column("near").csv_only(), [](const Row& c) { return c.fights.format.near; }},
           {"surface_pixels", [](const Row& c) { return c.fights.surface_pixels; }},
           {Column("fighting_pixels").page("fighting pixels"),
            [](const Row& c) { return c.fights.fighting; }},
           {percent_heading("share", ".3f"), [](const Row& c) { return c.fights.share(); }},
           {Column("greatest_depth_error", ".9g").csv_only().page("greatest depth error", ".3g"),
            [](const Row& c) { return c.fights.greatest_error; }}}};
}

Table offsets_table(const std::vector<OffsetCount>& rows) {
  using Row = OffsetCount;
  return {rows,
          {{Column("factor", "g").page("factor", "g"),
            [](const Row& c) { return c.bias.slope_factor; }},
           {Column("units", "g").page("units", "g"),
            [](const Row& c) { return c.bias.constant_factor; }},
           {Column("fights").page("fights"), &Row::fights},
           {Column("hidden_surfaces_that_show").page("hidden surfaces that show"),
            &Row::shows_through}}};
}

/// A bar of one pixel shows nothing that the table does not.
void plot_cures(Results& results, const std::string& name, const std::string& title,
                const std::vector<Cure>& cures) {
  BarChart chart{
      .name = name, .title = title, .y_label = "pixels that fight", .series = {{"fighting", {}}}};
  for (const Cure& cure : cures) {
    chart.categories.push_back(cure.name);
    chart.series[0].heights.push_back(static_cast<double>(cure.fights.fighting));
  }
  if (std::ranges::max(chart.series[0].heights) > 1) results.plot(chart);
}

Plot offset_plot(const std::vector<OffsetCount>& counts) {
  Plot plot{.name = "offset",
            .title =
                "Polygon offset: samples that are wrong, by units; hidden surfaces that show "
                "are not fights",
            .x_label = "-units",
            .y_label = "samples",
            .logarithmic_x = true};
  for (const double factor : offset_factors) {
    const auto is_same = [&](const OffsetCount& c) { return c.bias.slope_factor == factor; };
    const auto rows = rows_where(counts, is_same);
    const auto minus_units = [](const OffsetCount& c) { return -c.bias.constant_factor; };
    const std::string label = "factor " + text_of(factor, "g");
    plot.series.push_back(series_of(label + ": fights", rows, minus_units, &OffsetCount::fights));
    plot.series.push_back(
        series_of(label + ": hidden shows", rows, minus_units, &OffsetCount::shows_through));
  }
  return plot;
}

/// The files that the commands under the pictures read: the scene as it was given, or the panels.
std::string scene_beside_page(Results& results, const SceneView& view, bool is_given) {
  if (is_given) return view.name;
  std::string names;
  for (const Object& object : view.scene.objects) {
    Scene part;
    part.meshes = {view.scene.meshes[object.mesh]};
    results.file({object.name + ".obj", obj_of(part)});
    names += (names.empty() ? "" : " ") + object.name + ".obj";
  }
  return names;
}

/// fights-NAME: where the scene fights in a format; NAME.json: its camera.
void picture_fights(Results& results, const std::string& name, const std::string& files,
                    SceneView view, const DepthMap& visible, double near, Mapping mapping,
                    Storage storage) {
  view.camera.near = near;
  const DepthFormat format = format_between(near, view.camera.far, mapping, storage);
  const BufferedScene buffered = buffer_scene(view, visible, format);
  const FightPicture picture = pictures_of(name, buffered, files, name + ".json").front();
  results.picture(picture.png, picture.command);
  results.file(camera_file(name, view.camera));
}

}  // namespace

std::vector<StudyFile> study_mitigation(const StudyOptions& options,
                                        const std::function<void(double)>& tick) {
  if (options.separation || options.samples) {
    throw UsageError("the study mitigation has no --separation and no --samples");
  }
  SceneView view = options.scene ? *options.scene : panels_with_decals();
  view.camera = with_range(view, options);
  require_meaningful(uncured_format(view.camera));
  require_gnuplot(options);
  const DepthMap visible = visible_map(view);
  if (!std::isfinite(nearest_depth(visible))) {
    throw UsageError("the camera sees nothing of the scene");
  }
  const std::vector<Cure> nears = farther_near_planes(view, visible);
  tick(0.3);
  const std::vector<Cure> formats = other_formats(view, visible);
  tick(0.6);
  const std::vector<OffsetCount> offsets = polygon_offsets(view);
  tick(0.9);

  Results results("mitigation", page_texts::mitigation, options);
  results.figure("scene", view.name);
  results.figure("near", view.camera.near);
  results.figure("far", view.camera.far);
  const auto fewest = std::min_element(
      formats.begin(), formats.end(),
      [](const Cure& a, const Cure& b) { return a.fights.fighting < b.fights.fighting; });
  results.quote("pixels", nears.front().fights.surface_pixels);
  results.quote("before", nears.front().fights.fighting);
  results.quote("farthest", nears.back().fights.fighting);
  results.quote("best_format", fewest->name);
  results.quote("best_format_fights", fewest->fights.fighting);
  results.table(cures_table(nears, "cure"), {.csv = "near", .json = "near_planes", .page = "near"});
  results.table(cures_table(formats, "format"),
                {.csv = "formats", .json = "formats", .page = "formats"});
  results.table(offsets_table(offsets),
                {.csv = offsets.empty() ? "" : "offset", .json = "offsets", .page = "offset"});
  plot_cures(results, "near", "Pixels that fight, by near plane (standard unorm24)", nears);
  plot_cures(results, "formats", "Pixels that fight, by format", formats);
  results.plot(offset_plot(offsets));
  const double near = view.camera.near;
  const std::string files = scene_beside_page(results, view, options.scene.has_value());
  picture_fights(results, "before", files, view, visible, near, Mapping::standard, uncured_storage);
  picture_fights(results, "near", files, view, visible, nears.back().fights.format.near,
                 Mapping::standard, uncured_storage);
  picture_fights(results, "reversed", files, view, visible, near, Mapping::reversed,
                 Storage::float32);
  picture_fights(results, "log", files, view, visible, near, Mapping::log, uncured_storage);
  tick(1);
  return results.files();
}

}  // namespace fathom::studies
