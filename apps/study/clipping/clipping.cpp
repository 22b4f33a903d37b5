#include <fmt/format.h>

#include <vector>

#include "apps/study/clipping/beside_cgal.h"
#include "apps/study/clipping/clipped_shapes.h"
#include "apps/study/page.h"
#include "apps/study/plot.h"
#include "apps/study/results.h"
#include "apps/study/study.h"
#include "fathom/failures/errors.h"

namespace fathom::studies {
namespace {

/// A data block of gnuplot: closed rings, an empty line after each.
std::string data_block(const char* name, const std::vector<Outline>& rings) {
  std::string text = fmt::format("{} << EOD\n", name);
  for (const Outline& ring : rings) {
    for (std::size_t i = 0; i <= ring.size(); ++i) {
      const auto& [x, y] = ring[i % ring.size()];
      text += fmt::format("{} {}\n", x, y);
    }
    text += "\n";
  }
  return text + "EOD\n";
}

std::string panel(const char* data, const std::string& title) {
  return fmt::format(
      "set title '{1}'\n"
      "plot $subject with lines lc rgb '#aaaaaa' lw 1, $window with lines lc rgb '#888888' dt 2, "
      "{0} with filledcurves closed fc rgb '#9ecae1' notitle, "
      "{0} with lines lc rgb '#b2182b' lw 3\n",
      data, title);
}

/// The plot shape-NAME: three panels, in which the shape is clipped in the three ways.
std::vector<StudyFile> draw(const ClippedShape& shape) {
  return run_gnuplot(
      "shape-" + shape.name,
      data_block("$subject", {shape.subject}) + data_block("$window", {shape.window}) +
          data_block("$a", shape.reentrant) + data_block("$b", shape.pieces) +
          data_block("$c", shape.decomposed) +
          "set multiplot layout 1,3\nset size ratio -1\nset offsets 0.5, 0.5, 0.5, 0.5\n"
          "unset key\nunset border\nunset tics\n" +
          panel("$a", "Sutherland-Hodgman: one ring") +
          panel("$b", fmt::format("Weiler-Atherton: {} pieces", shape.pieces.size())) +
          panel("$c", fmt::format("convex pieces first: {}", shape.decomposed.size())) +
          "unset multiplot\n",
      400);
}

Table shapes_table(const std::vector<ClippedShape>& shapes) {
  using Shape = ClippedShape;
  const auto figure = [](auto member) {
    return [member](const Shape& s) -> Cell { return s.figures.*member; };
  };
  using Figures = ClippingFigures;
  return {shapes,
          {{Column("shape").page("shape"), &Shape::name},
           {Column("corners").csv_only(), figure(&Figures::corners)},
           {Column("pieces").page("pieces"), figure(&Figures::pieces)},
           {Column("convex_pieces").page("convex pieces"), figure(&Figures::convex_pieces)},
           {Column("border").page("border", ".4g"), figure(&Figures::border)},
           {Column("bridges").page("bridging edges", ".4g"), figure(&Figures::bridges)},
           {Column("cuts").page("cuts", ".4g"), figure(&Figures::cuts)},
           {"areas_agree", figure(&Figures::areas_agree)},
           {heading("areas"),
            [](const Shape& s) { return s.figures.areas_agree ? "equal" : "different"; }}}};
}

Table random_table(const std::vector<RandomPolygons>& rows) {
  using Row = RandomPolygons;
  return {rows,
          {{"corners", &Row::corners},
           {Column("polygons").csv_only(), &Row::polygons},
           {"in_pieces", &Row::in_pieces},
           {Column("pieces").csv_only(), &Row::pieces},
           {Column("convex_pieces").csv_only(), &Row::convex_pieces},
           {"bridge_percent", &Row::bridge_percent},
           {"cut_percent", &Row::cut_percent},
           {"areas_agree", &Row::areas_agree}}};
}

Plot bridges_plot(const std::vector<RandomPolygons>& rows) {
  using Row = RandomPolygons;
  return {
      .name = "bridges",
      .title = "Edges that do not belong to the border",
      .x_label = "corners of the polygon",
      .y_label = "percent of the true border",
      .series = {series_of("bridging edges of Sutherland-Hodgman", rows, &Row::corners,
                           &Row::bridge_percent),
                 series_of("cuts of the decomposition", rows, &Row::corners, &Row::cut_percent)}};
}

Table beside_cgal_table(const std::vector<BesideCgal>& rows) {
  using Row = BesideCgal;
  return {rows,
          {{Column("kind").page("kind"), &Row::kind},
           {Column("corners").page("corners"), &Row::corners},
           {Column("pairs").page("pairs"), &Row::pairs},
           {Column("polygons").page("polygons"), &Row::polygons},
           {Column("different").page("different answers"), &Row::different},
           {heading("Weiler-Atherton ms", ".2f"), &Row::ours_ms},
           {heading("CGAL ms", ".2f"), &Row::cgal_ms},
           {heading("CGAL ms / Weiler-Atherton ms", ".2f"), &Row::ratio}}};
}

Plot beside_cgal_plot(const std::vector<BesideCgal>& rows) {
  using Row = BesideCgal;
  Plot plot{.name = "cgal",
            .title = "Weiler-Atherton and CGAL",
            .x_label = "corners",
            .y_label = "milliseconds",
            .logarithmic_x = true,
            .logarithmic_y = true,
            .series = {}};
  for (const std::string& kind : kinds_beside_cgal()) {
    const auto some = rows_where(rows, [&](const Row& row) { return row.kind == kind; });
    plot.series.push_back(series_of(kind, some, &Row::corners, &Row::ours_ms));
    plot.series.push_back(series_of(kind + ", CGAL", some, &Row::corners, &Row::cgal_ms));
  }
  return plot;
}

std::vector<BesideCgal> clip_beside_cgal(const std::function<void(double)>& tick) {
  constexpr std::size_t sizes[] = {64, 256, 1024, 2048};
  std::vector<BesideCgal> rows;
  for (const std::string& kind : kinds_beside_cgal())
    for (const std::size_t corners : sizes) {
      rows.push_back(measure_beside_cgal(kind, corners));
      tick(0.5 + 0.4 * static_cast<double>(rows.size()) /
                     static_cast<double>(kinds_beside_cgal().size() * std::size(sizes)));
    }
  return rows;
}

std::size_t different_answers(const std::vector<BesideCgal>& rows) {
  std::size_t different = 0;
  for (const BesideCgal& row : rows) different += row.different;
  return different;
}

std::vector<RandomPolygons> clip_random(std::size_t polygons,
                                        const std::function<void(double)>& tick) {
  constexpr std::size_t corner_counts[] = {6, 8, 12, 16, 24, 32, 48, 64};
  std::vector<RandomPolygons> rows;
  for (const std::size_t corners : corner_counts) {
    rows.push_back(clip_random_polygons(corners, polygons));
    tick(0.5 * static_cast<double>(rows.size()) / std::size(corner_counts));
  }
  return rows;
}

}  // namespace

std::vector<StudyFile> study_clipping(const StudyOptions& options,
                                      const std::function<void(double)>& tick) {
  if (options.near || options.far)
    throw UsageError("the study clipping has no depths: --near and --far mean nothing to it");
  const std::size_t polygons = options.samples.value_or(100);
  if (polygons > 100000) throw UsageError("--samples is not from 2 to 100000");
  require_gnuplot(options);
  const std::vector<ClippedShape> shapes = clipped_shapes();
  const std::vector<RandomPolygons> random = clip_random(polygons, tick);

  const std::vector<BesideCgal> beside_cgal = clip_beside_cgal(tick);

  Results results("clipping", page_texts::clipping, options);
  results.figure("polygons", polygons);
  results.table(shapes_table(shapes), {.csv = "shapes", .json = "shapes", .page = "shapes"});
  results.table(random_table(random), {.csv = "random", .json = "random"});
  results.figure("answers_unlike_cgal", different_answers(beside_cgal));
  results.table(beside_cgal_table(beside_cgal), {.csv = "cgal", .json = "cgal", .page = "cgal"});
  results.plot(beside_cgal_plot(beside_cgal));
  for (const ClippedShape& shape : shapes)
    results.plot("shape-" + shape.name, [&] { return draw(shape); });
  results.plot(bridges_plot(random));
  tick(1);
  return results.files();
}

}  // namespace fathom::studies
