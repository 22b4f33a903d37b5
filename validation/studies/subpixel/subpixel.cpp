#include "validation/studies/subpixel/subpixel.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "fathom/numeric/errors.h"
#include "validation/studies/page.h"
#include "validation/studies/plot.h"
#include "validation/studies/study_scene.h"
#include "validation/studies/subpixel/snapped_raster.h"

namespace fathom::studies {
namespace {

using Json = nlohmann::ordered_json;

constexpr int most_bits = 16;

struct Row {
  int bits;
  std::uint64_t pixels = 0;  ///< with a surface in either map
  std::uint64_t lost = 0, gained = 0, other_triangle = 0;
  /// |D − exact|/exact, where both maps show the same triangle.
  double greatest_error = 0, mean_error = 0;
  std::uint64_t left_out = 0;
};

Row compare(const SnappedMap& snapped, const DepthMap& exact, int bits) {
  Row row{.bits = bits, .left_out = snapped.left_out};
  const auto& id = *exact.values<std::uint32_t>("id");
  const auto& Z = *exact.values<double>("Z");
  std::uint64_t same = 0;
  for (std::size_t i = 0; i < id.size(); ++i) {
    const bool here = snapped.id[i] != no_surface, there = id[i] != no_surface;
    if (!here && !there) continue;
    ++row.pixels;
    row.lost += !here ? 1 : 0;
    row.gained += !there ? 1 : 0;
    if (!here || !there) continue;
    if (snapped.id[i] != id[i]) {
      ++row.other_triangle;
      continue;
    }
    const double error = std::abs(snapped.depth[i] - Z[i]) / Z[i];
    row.greatest_error = std::max(row.greatest_error, error);
    row.mean_error += error;
    ++same;
  }
  if (same > 0) row.mean_error /= static_cast<double>(same);
  return row;
}

std::string csv_of(const std::vector<Row>& rows) {
  std::string text =
      "bits,pixels,lost,gained,other_triangle,greatest_relative_depth_error,"
      "mean_relative_depth_error,triangles_left_out\n";
  for (const Row& r : rows) {
    text += fmt::format("{},{},{},{},{},{:.6g},{:.6g},{}\n", r.bits, r.pixels, r.lost, r.gained,
                        r.other_triangle, r.greatest_error, r.mean_error, r.left_out);
  }
  return text;
}

Plot coverage_plot(const std::vector<Row>& rows) {
  Plot plot{"coverage",
            "Pixels that differ from the exact map, by subpixel bits",
            "subpixel bits",
            "pixels",
            false,
            true,
            {{"covered or not", {}}, {"another triangle", {}}}};
  for (const Row& r : rows) {
    const auto differ = static_cast<double>(r.lost + r.gained);
    if (differ > 0) plot.series[0].points.emplace_back(r.bits, differ);
    if (r.other_triangle > 0) plot.series[1].points.emplace_back(r.bits, r.other_triangle);
  }
  std::erase_if(plot.series, [](const Series& s) { return s.points.empty(); });
  return plot;
}

Plot depth_plot(const std::vector<Row>& rows) {
  Plot plot{"depth",
            "Error of depth where the same triangle shows, by subpixel bits",
            "subpixel bits",
            "relative error of the depth",
            false,
            true,
            {{"greatest", {}}, {"mean", {}}}};
  for (const Row& r : rows) {
    if (r.greatest_error > 0) plot.series[0].points.emplace_back(r.bits, r.greatest_error);
    if (r.mean_error > 0) plot.series[1].points.emplace_back(r.bits, r.mean_error);
  }
  std::erase_if(plot.series, [](const Series& s) { return s.points.empty(); });
  return plot;
}

StudyFile page_of(const SceneView& view, const std::vector<Row>& rows, bool coverage, bool depth) {
  Page page("Subpixel bits: " + view.name);
  page.paragraph(
      "Corners are moved to the nearest point of a grid of 2^-bits pixels, as hardware does before "
      "it draws; coverage is then decided by the top-left rule in exact integers. Against it "
      "stands "
      "the exact map, in which no corner moves. Direct3D and Vulkan ask for 8 bits and 4.");
  page.heading("Coverage")
      .paragraph(
          "A corner moves by at most half a step on either axis, so pixels change hands along "
          "edges "
          "only, and their number falls to a half with every bit as long as there are enough of "
          "them.");
  if (coverage) page.plot("coverage", "Pixels that differ from the exact map");
  page.heading("Depth").paragraph(
      "The depth of the moved triangle is right at its corners, which stand elsewhere: what is off "
      "is the slope of the surface times the distance, and falls to a half with every bit.");
  if (depth) page.plot("depth", "Relative error of the depth");
  std::vector<std::vector<std::string>> cells;
  cells.reserve(rows.size());
  for (const Row& r : rows) {
    cells.push_back({fmt::format("{}", r.bits), fmt::format("{}", r.lost),
                     fmt::format("{}", r.gained), fmt::format("{}", r.other_triangle),
                     fmt::format("{:.3g}", r.greatest_error), fmt::format("{:.3g}", r.mean_error)});
  }
  page.table({"bits", "lost", "gained", "another triangle", "greatest depth error", "mean"}, cells);
  if (rows[0].left_out > 0) {
    page.paragraph(fmt::format(
        "{} triangles reach behind the camera or far beside the image; they were not drawn, and "
        "count as lost.",
        rows[0].left_out));
  }
  return page.file();
}

}  // namespace

std::vector<StudyFile> study_subpixel(const StudyOptions& options,
                                      const std::function<void(double)>& tick) {
  if (options.separation || options.samples) {
    throw UsageError("the study subpixel has no --separation and no --samples");
  }
  SceneView view = options.scene ? *options.scene : wheel();
  if (options.near) view.camera.near = *options.near;
  if (options.far) view.camera.far = *options.far;
  if (const auto fault = find_fault(view.camera)) throw UsageError(*fault);
  require_gnuplot();
  RenderOptions exact{.channels = {Channel::Z, Channel::id}};
  exact.depth_encoding.type = DepthEncoding::Type::binary64;
  const DepthMap map = render(view.scene, view.camera, exact);
  std::vector<Row> rows;
  for (int bits = 0; bits <= most_bits; ++bits) {
    rows.push_back(compare(draw_snapped(view, bits), map, bits));
    tick(0.9 * (bits + 1) / (most_bits + 1));
  }
  Json summary{{"study", "subpixel"}, {"scene", view.name}};
  for (const Row& r : rows) {
    summary["bits"].push_back({{"bits", r.bits},
                               {"pixels", r.pixels},
                               {"lost", r.lost},
                               {"gained", r.gained},
                               {"other_triangle", r.other_triangle},
                               {"greatest_relative_depth_error", r.greatest_error},
                               {"mean_relative_depth_error", r.mean_error},
                               {"triangles_left_out", r.left_out}});
  }
  const Plot coverage = coverage_plot(rows), depth = depth_plot(rows);
  std::vector<StudyFile> files{{"subpixel.csv", csv_of(rows)},
                               {"summary.json", summary.dump(2) + "\n"},
                               page_of(view, rows, has_points(coverage), has_points(depth))};
  for (const Plot& plot : {coverage, depth}) {
    if (!has_points(plot)) continue;
    auto drawn = draw(plot);
    std::move(drawn.begin(), drawn.end(), std::back_inserter(files));
  }
  tick(1);
  return files;
}

}  // namespace fathom::studies
