#include <algorithm>

#include "apps/study/antialiasing/coverage.h"
#include "apps/study/antialiasing/curve.h"
#include "apps/study/antialiasing/methods.h"
#include "apps/study/antialiasing/sampling.h"
#include "apps/study/page.h"
#include "apps/study/plot.h"
#include "apps/study/results.h"
#include "apps/study/study.h"
#include "apps/study/study_scene.h"
#include "fathom/failures/errors.h"

namespace fathom::studies {
namespace {

std::string percent_seen(const PatternError& r) {
  return text_of(100.0 * static_cast<double>(r.seen_partial) / static_cast<double>(r.partial),
                 ".1f") +
         " %";
}

Table patterns_table(const std::vector<PatternError>& rows) {
  using Row = PatternError;
  return {rows,
          {{Column("pattern").page("pattern"), &Row::pattern},
           {Column("samples").page("samples"), &Row::samples},
           {"partial_pixels", &Row::partial},
           {"seen_partial", &Row::seen_partial},
           {Column("mean_error", ".6g").page("mean error", ".4f"), &Row::mean},
           {Column("rms_error", ".6g").page("rms", ".4f"), &Row::root_mean_square},
           {Column("greatest_error", ".6g").page("greatest", ".4f"), &Row::greatest},
           {Column("bias_pixels", ".6g").page("area gained (pixels)", "+.2f"), &Row::bias},
           {heading("seen as partial"), percent_seen}}};
}

std::string samples_label(std::size_t k) {
  return std::to_string(1 << k) + (k == 0 ? " sample" : " samples");
}

/// What is seen of each edge, and, in CSV and JSON, the errors.
Table edges_table(const std::vector<EdgeSeen>& edges) {
  std::vector<ColumnOf<EdgeSeen>> columns{
      {Column("slope", "g").page("slope", "g"), &EdgeSeen::slope},
      {Column("exact").page("exact"), &EdgeSeen::partial}};
  for (std::size_t k = 0; k < 4; ++k) {
    columns.push_back(
        {Column("seen_by_" + std::to_string(1 << k)).json("seen[]").page(samples_label(k)),
         [k](const EdgeSeen& e) { return e.seen[k]; }});
  }
  for (std::size_t k = 0; k < std::size(edge_patterns); ++k) {
    const std::string pattern = edge_patterns[k];
    columns.push_back({Column("rms_" + pattern, ".6g").json("rms_error." + pattern),
                       [k](const EdgeSeen& e) { return e.root_mean_square[k]; }});
  }
  return {edges, columns};
}

/// The errors, for the page.
Table edge_errors_table(const std::vector<EdgeSeen>& edges) {
  std::vector<ColumnOf<EdgeSeen>> columns{{heading("slope", "g"), &EdgeSeen::slope}};
  for (std::size_t k = 0; k < std::size(edge_patterns); ++k) {
    columns.push_back({heading(edge_patterns[k], ".4f"),
                       [k](const EdgeSeen& e) { return e.root_mean_square[k]; }});
  }
  return {edges, columns};
}

Table methods_table(const std::vector<MethodError>& rows) {
  using Row = MethodError;
  const auto of = [](PictureError Row::*scene, double PictureError::*value) {
    return [=](const Row& row) { return row.*scene.*value; };
  };
  using E = PictureError;
  return {rows,
          {{Column("method").page("method"), &Row::name},
           {Column("mean").page("star: mean", ".2g"), of(&Row::star, &E::mean)},
           {Column("rms").page("rms", ".2g"), of(&Row::star, &E::rms)},
           {Column("greatest").page("greatest", ".2g"), of(&Row::star, &E::greatest)},
           {Column("sheets_mean").page("sheets: mean", ".2g"), of(&Row::sheets, &E::mean)},
           {Column("sheets_greatest").page("greatest", ".2g"), of(&Row::sheets, &E::greatest)},
           {Column("plane_mean").page("plane", ".2g"), of(&Row::plane, &E::mean)},
           {Column("wall_mean").page("wall", ".2g"), of(&Row::wall, &E::mean)},
           {Column("text_mean").page("text", ".2g"), of(&Row::text, &E::mean)},
           {Column("shaded").page("shaded"), &Row::shaded},
           {Column("ms").page("ms", ".1f"), &Row::ms},
           {Column("bytes_a_pixel", ".6g").page("bytes a pixel", ".0f"), &Row::bytes_a_pixel}}};
}

Table filters_table(const std::vector<FilterError>& rows) {
  return {
      rows,
      {{Column("filter").page("filter"), &FilterError::filter},
       {Column("mean_error").page("mean error, one sample a pixel", ".3f"), &FilterError::mean}}};
}

/// Which of the families that a plot tells apart a pattern belongs to.
std::string family_of(const PatternError& row) {
  if (row.pattern.starts_with("regular")) return "regular";
  if (row.pattern.starts_with("jittered")) return "jittered";
  return row.pattern == "rotated-grid" ? "rotated grid" : "standard";
}

Plot error_plot(const std::vector<PatternError>& rows) {
  Plot plot{.name = "error",
            .title = "Coverage by samples against the exact area, pixels that are partly covered",
            .x_label = "samples a pixel",
            .y_label = "root mean square error of the coverage",
            .logarithmic_x = true,
            .logarithmic_y = true,
            .stretched_by_all = true};
  for (const char* family : {"standard", "regular", "jittered", "rotated grid"}) {
    const auto is_member = [&](const PatternError& row) { return family_of(row) == family; };
    plot.series.push_back(series_of(family, rows_where(rows, is_member), &PatternError::samples,
                                    &PatternError::root_mean_square));
  }
  return plot;
}

Plot edge_plot(const std::vector<EdgeSeen>& edges) {
  Plot plot{.name = "edge",
            .title = "Pixels of an edge that are partly covered, exactly and as samples see them",
            .x_label = "slope of the edge",
            .y_label = "pixels",
            .series = {series_of("exact area", edges, &EdgeSeen::slope, &EdgeSeen::partial)}};
  for (std::size_t k = 0; k < 4; ++k) {
    plot.series.push_back(series_of(samples_label(k), edges, &EdgeSeen::slope,
                                    [k](const EdgeSeen& e) { return e.seen[k]; }));
  }
  return plot;
}

Table gratings_table(const std::vector<GratingSeen>& rows) {
  using Row = GratingSeen;
  return {rows,
          {{Column("frequency").page("cycles a pixel", ".3f"), &Row::frequency},
           {Column("apparent").page("seen", ".3f"), &Row::apparent},
           {Column("contrast").page("contrast", ".3f"), &Row::contrast},
           {Column("contrast_by_area").page("by areas", ".3f"), &Row::contrast_by_area},
           {Column("error").page("error", ".2g"), &Row::error},
           {Column("error_ssaa").page("ssaa 4x4", ".2g"), &Row::error_ssaa},
           {Column("error_by_area").page("area", ".2g"), &Row::error_by_area}}};
}

Plot nyquist_plot(const std::vector<GratingSeen>& rows) {
  return {
      .name = "nyquist",
      .title = "What frequency a grating seems to have",
      .x_label = "cycles a pixel",
      .y_label = "cycles a pixel, seen",
      .series = {
          series_of("sampled once a pixel", rows, &GratingSeen::frequency, &GratingSeen::apparent),
          series_of("the truth", rows, &GratingSeen::frequency, &GratingSeen::frequency)}};
}

void add(Results& results, const CoverageBySamples& measured) {
  results.table(patterns_table(measured.patterns),
                {.csv = "patterns", .json = "patterns", .page = "patterns"});
  results.table(edges_table(measured.edges), {.csv = "edges", .json = "edges", .page = "edges"});
  results.table(edge_errors_table(measured.edges), {.page = "edge_errors"});
  results.plot(error_plot(measured.patterns));
  results.plot(edge_plot(measured.edges));
}

void add(Results& results, const AntialiasingMethods& measured) {
  results.table(methods_table(measured.methods),
                {.csv = "methods", .json = "methods", .page = "methods"});
  results.table(filters_table(measured.filters), {.json = "filters", .page = "filters"});
  results.figure("texture_changed_by_fxaa", measured.texture_changed_by_fxaa);
  results.quote("changed", 100 * measured.texture_changed_by_fxaa, ".1f");
  for (const auto& [png, width] : measured.pictures) results.picture(png, width);
  for (const StudyFile& file : measured.files) results.file(file);
  const auto& rows = measured.methods;
  const auto row = [&](const char* name) {
    return *std::find_if(rows.begin(), rows.end(), [&](const auto& r) { return r.name == name; });
  };
  for (const char* name : {"none", "msaa 4", "msaa 8", "ssaa 4x4", "fxaa"})
    results.quote(std::string("error ") + name, 100 * row(name).star.mean, ".2f");
  results.quote("fxaa bytes",
                row("fxaa").bytes_a_pixel.value_or(0) - row("none").bytes_a_pixel.value_or(0),
                ".0f");
}

void add(Results& results, const std::vector<GratingSeen>& gratings) {
  results.table(gratings_table(gratings),
                {.csv = "gratings", .json = "gratings", .page = "gratings"});
  results.figure("nyquist_limit", nyquist_limit(gratings));
  results.plot(nyquist_plot(gratings));
  for (const GratingSeen& grating : gratings)
    results.picture(picture_file(grating_name(grating), grating_picture(grating)));
}

Table wheels_table(const std::vector<WheelSeen>& rows) {
  using Row = WheelSeen;
  return {rows,
          {{Column("rate").page("degrees a picture", "g"), &Row::rate},
           {Column("apparent").page("seen", "+.2f"), &Row::apparent},
           {Column("alias").page("known alias", "+g"), &Row::alias},
           {Column("contrast").page("contrast, shutter open", ".3f"), &Row::contrast},
           {Column("sinc").page("integral over time", ".3f"), &Row::sinc}}};
}

Table times_table(const std::vector<TimeError>& rows) {
  using Row = TimeError;
  return {rows,
          {{Column("pictures").page("pictures"), &Row::pictures},
           {Column("centres").page("temporal", ".2g"), &Row::centres},
           {Column("areas").page("temporal-area", ".2g"), &Row::areas}}};
}

Table histories_table(const std::vector<HistoryError>& rows) {
  using Row = HistoryError;
  return {rows,
          {{Column("step").page("pixels a picture", "g"), &Row::step},
           {Column("none").page("one sample", ".4f"), &Row::none},
           {Column("taa").page("taa", ".4f"), &Row::taa},
           {Column("unlimited").page("without clamping", ".4f"), &Row::unlimited},
           {Column("unmoved").page("without reprojection", ".4f"), &Row::unmoved},
           {Column("neither").page("neither", ".4f"), &Row::neither}}};
}

void add(Results& results, const TemporalStudy& measured) {
  results.table(wheels_table(measured.wheels),
                {.csv = "wheels", .json = "wheels", .page = "wheels"});
  results.table(times_table(measured.times), {.csv = "times", .json = "times", .page = "times"});
  results.table(histories_table(measured.histories),
                {.csv = "histories", .json = "histories", .page = "histories"});
  results.pictures(measured.pictures);
}

Table curves_table(const std::vector<CurveError>& rows) {
  using Row = CurveError;
  return {rows,
          {{Column("magnification").page("times"), &Row::magnification},
           {Column("chords").page("chords"), &Row::chords},
           {Column("area").page("area of the polygon", "+.2g"), &Row::area},
           {Column("anew").page("drawn anew", ".2g"), &Row::anew},
           {Column("enlarged").page("enlarged bitmap", ".2g"), &Row::enlarged}}};
}

void add_curve(Results& results) {
  std::vector<CurveError> rows;
  for (const int magnification : {1, 2, 4, 8, 16}) rows.push_back(curve_error(magnification));
  results.table(curves_table(rows), {.csv = "curves", .json = "curves", .page = "curves"});
  const CurvePictures pictures = curve_pictures(16);
  results.picture(picture_file("curve-enlarged", pipeline::to_rgb(pictures.enlarged)));
  results.picture(picture_file("curve-anew", pipeline::to_rgb(pictures.anew)));
}

}  // namespace

std::vector<StudyFile> study_antialiasing(const StudyOptions& options,
                                          const std::function<void(double)>& tick) {
  if (options.separation || options.samples) {
    throw UsageError("the study antialiasing has no --separation and no --samples");
  }
  const SceneView view = scene_or_wheel(options);
  require_gnuplot(options);
  const DepthMap exact = exact_coverage(view);
  const CoverageBySamples coverage =
      measure_coverage_by_samples(view, exact, [&](double share) { tick(share / 2); });
  const AntialiasingMethods methods =
      measure_antialiasing([&](double share) { tick(0.5 + share / 4); });
  const TemporalStudy temporal = measure_temporal([&](double share) { tick(0.75 + share / 4); });

  Results results("antialiasing", page_texts::antialiasing, options);
  results.figure("scene", view.name);
  add(results, coverage);
  results.picture(picture("coverage", exact, {.channel = "A", .colours = ColourMap::grey}));
  add(results, methods);
  add(results, gratings_seen());
  add(results, temporal);
  add_curve(results);
  return results.files();
}

}  // namespace fathom::studies
