#include <fmt/format.h>

#include "apps/study/hidden_surface/comparison.h"
#include "apps/study/hidden_surface/sight.h"
#include "apps/study/page.h"
#include "apps/study/plot.h"
#include "apps/study/results.h"
#include "apps/study/study.h"
#include "apps/study/study_scene.h"
#include "fathom/failures/errors.h"

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
           {Column("wrong_bsp_tree").page("BSP tree in binary64"),
            [](const Row& r) { return r.bsp_tree.wrong; }},
           {Column("wrong_bsp_exact_outlines").page("BSP tree, exact outlines"),
            [](const Row& r) { return r.bsp_exact_outlines.wrong; }},
           {Column("wrong_bsp_exact").page("BSP tree, exact"),
            [](const Row& r) { return r.bsp_exact.wrong; }},
           {Column("bsp_tree_pieces"), [](const Row& r) { return r.bsp_tree.pieces; }},
           {Column("bsp_exact_pieces"), [](const Row& r) { return r.bsp_exact.pieces; }},
           {Column("moved").page("moved"), [](const Row& r) { return r.order.moved; }},
           {Column("splits").page("splits"), [](const Row& r) { return r.order.splits; }}}};
}

Table costs_table(const std::vector<HiddenSurfaceCost>& rows) {
  using Row = HiddenSurfaceCost;
  std::vector<ColumnOf<Row>> columns{{Column("triangles").page("triangles"), &Row::triangles}};
  constexpr struct {
    const char *key, *name;
    FrameCost Row::*cost;
  } algorithms[] = {{"z_buffer", "z-buffer", &Row::buffer},
                    {"painter", "painter", &Row::painter},
                    {"warnock", "Warnock", &Row::warnock},
                    {"bsp_tree", "BSP tree", &Row::bsp_tree}};
  for (const auto& [key, name, cost] : algorithms)
    columns.push_back(
        {Column(std::string(key) + "_ms", ".6g").page(std::string(name) + " ms", ".2f"),
         [cost = cost](const Row& row) { return (row.*cost).ms; }});
  for (const auto& [key, name, cost] : algorithms) {
    columns.push_back(
        {std::string(key) + "_bytes", [cost = cost](const Row& row) { return (row.*cost).bytes; }});
    columns.push_back({heading(std::string(name) + " MB", ".2f"), [cost = cost](const Row& row) {
                         const auto& bytes = (row.*cost).bytes;
                         return bytes ? std::optional(static_cast<double>(*bytes) / 1e6)
                                      : std::nullopt;
                       }});
  }
  const std::vector<ColumnOf<Row>> work{
      {Column("comparisons").page("comparisons"), &Row::comparisons},
      {Column("splits").page("splits"), &Row::splits},
      {Column("warnock_windows").page("Warnock's windows"), &Row::warnock_windows},
      {Column("bsp_tree_pieces").page("pieces in the BSP tree"), &Row::bsp_tree_pieces}};
  columns.insert(columns.end(), work.begin(), work.end());
  return {rows, columns};
}

/// A member of the costs of every algorithm against the number of triangles.
template <class Value>
std::vector<Series> series_of_all(const std::vector<HiddenSurfaceCost>& rows, const Value& value) {
  using Row = HiddenSurfaceCost;
  const auto of = [&](FrameCost Row::*cost) {
    return [&value, cost](const Row& row) { return value(row.*cost); };
  };
  return {series_of("z-buffer", rows, &Row::triangles, of(&Row::buffer)),
          series_of("painter", rows, &Row::triangles, of(&Row::painter)),
          series_of("Warnock", rows, &Row::triangles, of(&Row::warnock)),
          series_of("BSP tree", rows, &Row::triangles, of(&Row::bsp_tree))};
}

void add_costs(Results& results, const std::vector<HiddenSurfaceCost>& costs) {
  results.table(costs_table(costs), {.csv = "costs", .json = "costs", .page = "costs"});
  results.plot(Plot{.name = "cost",
                    .title = "Hidden surfaces: time",
                    .x_label = "triangles",
                    .y_label = "milliseconds",
                    .logarithmic_x = true,
                    .logarithmic_y = true,
                    .series = series_of_all(costs, [](const FrameCost& cost) { return cost.ms; })});
  results.plot(Plot{.name = "memory",
                    .title = "Hidden surfaces: memory",
                    .x_label = "triangles",
                    .y_label = "megabytes, at the peak",
                    .logarithmic_x = true,
                    .logarithmic_y = true,
                    .series = series_of_all(costs, [](const FrameCost& cost) {
                      return static_cast<double>(cost.bytes.value_or(0)) / 1e6;
                    })});
}

void add_cases(Results& results, const std::vector<HiddenSurfaceCase>& scenes) {
  results.table(scenes_table(scenes), {.csv = "scenes", .json = "scenes", .page = "scenes"});
  for (const HiddenSurfaceCase& scene : scenes) {
    const std::uint32_t width = scene.picture.width;
    const std::string command = fmt::format(
        "fathom render {0}.obj --camera {0}.json --engine pipeline --hidden-surface painter "
        "--precision binary64 --subpixel-bits 16 --shading none --image {0}.png -o map.exr",
        scene.name);
    results.picture(picture_file(scene.name, scene.picture), command, width <= 320 ? 2 * width : 0);
    for (const StudyFile& file : scene.files) results.file(file);
  }
}

/// 10, 30, 100, …, and all.
std::vector<std::uint32_t> counts_up_to(std::uint32_t all) {
  std::vector<std::uint32_t> counts;
  for (std::uint32_t ten = 10; ten < all; ten *= 10)
    for (const std::uint32_t count : {ten, 3 * ten})
      if (count < all) counts.push_back(count);
  counts.push_back(all);
  return counts;
}

template <class CostOf>
std::vector<HiddenSurfaceCost> costs_up_to(std::uint32_t all, const CostOf& cost_of,
                                           const std::function<void(double)>& tick) {
  const std::vector<std::uint32_t> counts = counts_up_to(all);
  std::vector<HiddenSurfaceCost> costs;
  for (const std::uint32_t count : counts) {
    costs.push_back(cost_of(count));
    tick(0.2 + 0.8 * static_cast<double>(count) / static_cast<double>(all));
  }
  return costs;
}

std::vector<StudyFile> study_scene(const StudyOptions& options,
                                   const std::function<void(double)>& tick) {
  SceneView view = *options.scene;
  view.camera = with_range(view, options);
  const SceneView eye = seen_from_eye(view);
  const HiddenSurfaceCase seen = compare_hidden_surfaces("scene", eye.scene, eye.camera);
  tick(0.2);
  const auto all = static_cast<std::uint32_t>(eye.scene.meshes[0].triangles.size());
  const std::vector<HiddenSurfaceCost> costs = costs_up_to(
      all,
      [&](std::uint32_t count) {
        return hidden_surface_cost(thinned(eye.scene, count), eye.camera);
      },
      tick);
  Results results("hidden-surface", page_texts::scene_hidden_surface, options);
  results.figure("scene", view.name);
  results.figure("triangles", all);
  results.figure("near", view.camera.near);
  results.figure("far", view.camera.far);
  for (const auto& [name, wrong] :
       {std::pair("buffer32", seen.buffer32), std::pair("buffer16", seen.buffer16),
        std::pair("painter", seen.painter), std::pair("warnock", seen.warnock),
        std::pair("bsp_tree", seen.bsp_tree.wrong),
        std::pair("bsp_exact_outlines", seen.bsp_exact_outlines.wrong),
        std::pair("bsp_exact", seen.bsp_exact.wrong)})
    results.quote(std::string("wrong_") + name, wrong);
  if (seen.bsp_tree.wrong > seen.bsp_exact.wrong)
    results.quote("tree_is_wrong", seen.bsp_tree.wrong);
  results.quote("pieces", seen.bsp_tree.pieces);
  results.quote("exact_pieces", seen.bsp_exact.pieces);
  results.quote("seen", seen.seen);
  add_cases(results, {seen});
  add_costs(results, costs);
  return results.files();
}

}  // namespace

std::vector<StudyFile> study_hidden_surface(const StudyOptions& options,
                                            const std::function<void(double)>& tick) {
  if (options.separation || options.samples || (!options.scene && (options.near || options.far)))
    throw UsageError("the study hidden-surface takes --scene, and --near and --far with it");
  require_gnuplot(options);
  if (options.scene) return study_scene(options, tick);
  const std::vector<HiddenSurfaceCase> scenes = compare_hidden_surfaces();
  tick(0.2);
  const std::vector<HiddenSurfaceCost> costs = costs_up_to(
      3000, [](std::uint32_t count) { return hidden_surface_cost(count); }, tick);

  Results results("hidden-surface", page_texts::hidden_surface, options);
  std::size_t wrong = 0;
  for (const HiddenSurfaceCase& c : scenes)
    wrong += c.buffer32 + c.painter + c.warnock + c.bsp_tree.wrong;
  results.quote("wrong", wrong);
  results.quote("most", costs.back().triangles);
  results.quote("painter_to_buffer", costs.back().painter.ms / costs.back().buffer.ms, ".1f");
  add_cases(results, scenes);
  add_costs(results, costs);
  return results.files();
}

}  // namespace fathom::studies
