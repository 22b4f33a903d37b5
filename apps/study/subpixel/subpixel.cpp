#include <cmath>

#include "apps/study/page_texts.h"
#include "apps/study/results.h"
#include "apps/study/studies.h"
#include "apps/study/study_scene.h"
#include "apps/study/subpixel/snapped_raster.h"
#include "fathom/failures/errors.h"

namespace fathom::studies {
namespace {

constexpr int most_bits = 16;

/// A map with corners on the grid against the exact one.
struct Row {
  int bits;
  std::uint64_t pixels = 0;  ///< with a surface in either map
  std::uint64_t lost = 0, gained = 0, other_triangle = 0;
  /// |D − exact|/exact, where both maps show the same triangle.
  double greatest_error = 0, mean_error = 0;
  std::uint64_t left_out = 0;

  [[nodiscard]] std::uint64_t covered_otherwise() const { return lost + gained; }
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

std::vector<Row> compare_all(const SceneView& view, const std::function<void(double)>& tick) {
  RenderOptions options{.channels = {Channel::Z, Channel::id}};
  options.depth_encoding.type = DepthEncoding::Type::binary64;
  const DepthMap exact = render(view.scene, view.camera, options).map;
  std::vector<Row> rows;
  for (int bits = 0; bits <= most_bits; ++bits) {
    rows.push_back(compare(draw_snapped(view, bits), exact, bits));
    tick(0.9 * (bits + 1) / (most_bits + 1));
  }
  return rows;
}

Table table_of(const std::vector<Row>& rows) {
  return {rows,
          {{Column("bits").page("bits"), &Row::bits},
           {"pixels", &Row::pixels},
           {Column("lost").page("lost"), &Row::lost},
           {Column("gained").page("gained"), &Row::gained},
           {Column("other_triangle").page("another triangle"), &Row::other_triangle},
           {Column("greatest_relative_depth_error", ".6g").page("greatest depth error", ".3g"),
            &Row::greatest_error},
           {Column("mean_relative_depth_error", ".6g").page("mean", ".3g"), &Row::mean_error},
           {"triangles_left_out", &Row::left_out}}};
}

Plot coverage_plot(const std::vector<Row>& rows) {
  return {.name = "coverage",
          .title = "Pixels that differ from the exact map, by subpixel bits",
          .x_label = "subpixel bits",
          .y_label = "pixels",
          .logarithmic_y = true,
          .series = {series_of("covered or not", rows, &Row::bits, &Row::covered_otherwise),
                     series_of("another triangle", rows, &Row::bits, &Row::other_triangle)}};
}

Plot depth_plot(const std::vector<Row>& rows) {
  return {.name = "depth",
          .title = "Error of depth where the same triangle shows, by subpixel bits",
          .x_label = "subpixel bits",
          .y_label = "relative error of the depth",
          .logarithmic_y = true,
          .series = {series_of("greatest", rows, &Row::bits, &Row::greatest_error),
                     series_of("mean", rows, &Row::bits, &Row::mean_error)}};
}

}  // namespace

std::vector<StudyFile> study_subpixel(const StudyOptions& options,
                                      const std::function<void(double)>& tick) {
  if (options.separation || options.samples) {
    throw UsageError("the study subpixel has no --separation and no --samples");
  }
  const SceneView view = scene_or_wheel(options);
  require_gnuplot(options);
  const std::vector<Row> rows = compare_all(view, tick);

  Results results("subpixel", page_texts::subpixel, options);
  results.figure("scene", view.name);
  results.table(table_of(rows), {.csv = "subpixel", .json = "bits", .page = "rows"});
  for (const Row& row : rows)
    results.quote("changed " + std::to_string(row.bits),
                  row.covered_otherwise() + row.other_triangle);
  results.plot(coverage_plot(rows));
  results.plot(depth_plot(rows));
  if (rows[0].left_out > 0) results.quote("left_out", rows[0].left_out);
  tick(1);
  return results.files();
}

}  // namespace fathom::studies
