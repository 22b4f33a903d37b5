#include "validation/studies/hidden_surface/hidden_surface.h"

#include "fathom/numeric/errors.h"
#include "validation/studies/hidden_surface/comparison.h"
#include "validation/studies/page_texts.h"
#include "validation/studies/picture.h"
#include "validation/studies/results.h"

namespace fathom::studies {
namespace {

Table scenes_table(const std::vector<HiddenSurfaceCase>& rows) {
  using Row = HiddenSurfaceCase;
  return {rows,
          {{Column("scene").page("scene"), &Row::name},
           {Column("pixels").page("pixels"), &Row::seen},
           {Column("wrong_float32").page("wrong: z-buffer float32"), &Row::buffer32},
           {Column("wrong_unorm16").page("z-buffer unorm16"), &Row::buffer16},
           {Column("wrong_painter").page("painter"), &Row::painter},
           {Column("wrong_warnock").page("Warnock"), &Row::warnock},
           {Column("wrong_bsp_tree").page("BSP tree"), &Row::bsp_tree},
           {Column("moved").page("moved"), [](const Row& r) { return r.order.moved; }},
           {Column("splits").page("splits"), [](const Row& r) { return r.order.splits; }}}};
}

Table costs_table(const std::vector<HiddenSurfaceCost>& rows) {
  using Row = HiddenSurfaceCost;
  return {rows,
          {{heading("triangles"), &Row::triangles},
           {heading("z-buffer ms", ".2f"), &Row::buffer_ms},
           {heading("painter ms", ".2f"), &Row::painter_ms},
           {heading("Warnock ms", ".2f"), &Row::warnock_ms},
           {heading("BSP tree ms", ".2f"), &Row::bsp_tree_ms},
           {heading("z-buffer bytes"), &Row::buffer_bytes},
           {heading("painter bytes"), &Row::painter_bytes},
           {heading("comparisons"), &Row::comparisons},
           {heading("splits"), &Row::splits},
           {heading("Warnock's windows"), &Row::warnock_windows},
           {heading("pieces in the BSP tree"), &Row::bsp_tree_pieces}}};
}

Plot cost_plot(const std::vector<HiddenSurfaceCost>& rows) {
  using Row = HiddenSurfaceCost;
  return {.name = "cost",
          .title = "Hidden surfaces",
          .x_label = "triangles",
          .y_label = "milliseconds",
          .logarithmic_x = true,
          .logarithmic_y = true,
          .series = {series_of("z-buffer", rows, &Row::triangles, &Row::buffer_ms),
                     series_of("painter", rows, &Row::triangles, &Row::painter_ms),
                     series_of("Warnock", rows, &Row::triangles, &Row::warnock_ms),
                     series_of("BSP tree", rows, &Row::triangles, &Row::bsp_tree_ms)}};
}

}  // namespace

std::vector<StudyFile> study_hidden_surface(const StudyOptions& options,
                                            const std::function<void(double)>& tick) {
  if (options.near || options.far || options.separation || options.samples)
    throw UsageError("the study hidden-surface takes no options");
  require_gnuplot(options);
  const std::vector<HiddenSurfaceCase> scenes = compare_hidden_surfaces();
  tick(0.5);
  std::vector<HiddenSurfaceCost> costs;
  for (const std::uint32_t count : {10u, 30u, 100u, 300u, 1000u}) {
    costs.push_back(hidden_surface_cost(count));
    tick(0.5 + 0.1 * static_cast<double>(costs.size()));
  }

  Results results("hidden-surface", page_texts::hidden_surface, options);
  results.table(scenes_table(scenes), {.csv = "scenes", .json = "scenes", .page = "scenes"});
  results.table(costs_table(costs), {.page = "costs"});
  for (const HiddenSurfaceCase& scene : scenes) {
    results.picture(picture_file(scene.name, scene.picture), 2 * scene.picture.width);
    for (const StudyFile& file : scene.files) results.file(file);
  }
  results.plot(cost_plot(costs));
  return results.files();
}

}  // namespace fathom::studies
