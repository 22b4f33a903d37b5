#include "apps/study/blending/blended.h"
#include "apps/study/drawn_files.h"
#include "apps/study/page_texts.h"
#include "apps/study/results.h"
#include "apps/study/studies.h"
#include "fathom/failures/errors.h"

namespace fathom::studies {
namespace {

Table cases_table(const std::vector<BlendedCase>& rows) {
  using Row = BlendedCase;
  return {rows,
          {{Column("scene").page("scene"), &Row::scene},
           {Column("method").page("drawn"), &Row::method},
           {Column("pixels").page("pixels"), &Row::seen},
           {Column("wrong").page("wrong"), &Row::wrong},
           {Column("mean_error", ".9g").page("mean error", ".4f"), &Row::mean_error},
           {Column("greatest_error", ".9g").page("greatest", ".3f"), &Row::greatest_error}}};
}

BarChart error_chart(const std::vector<BlendedCase>& cases, const std::vector<GlassScene>& scenes) {
  BarChart chart{.name = "errors",
                 .title = "Pixels of the wrong colour, by the order of drawing",
                 .y_label = "wrong pixels (%)"};
  for (const GlassScene& scene : scenes) chart.categories.push_back(scene.name);
  for (const char* method : {"file order", "file order, depth test", "back to front",
                             "back to front, read-only depth"}) {
    chart.series.push_back({method, {}});
    for (const BlendedCase& c : cases) {
      if (c.method == method)
        chart.series.back().heights.push_back(100.0 * static_cast<double>(c.wrong) /
                                              static_cast<double>(c.seen));
    }
  }
  return chart;
}

}  // namespace

std::vector<StudyFile> study_blending(const StudyOptions& options,
                                      const std::function<void(double)>& tick) {
  if (options.near || options.far || options.separation || options.samples)
    throw UsageError("the study blending takes no options");
  require_gnuplot(options);
  std::vector<GlassScene> scenes;
  for (const char* name : glass_scenes) scenes.push_back(glass_scene(name));
  std::vector<BlendedCase> cases;
  for (const GlassScene& scene : scenes) {
    for (const char* method : blending_methods) cases.push_back(blend(scene, method));
    tick(static_cast<double>(cases.size()) / 32);
  }

  Results results("blending", page_texts::blending, options);
  results.table(cases_table(cases), {.csv = "cases", .json = "cases", .page = "cases"});
  results.plot(error_chart(cases, scenes));
  results.file(glass_camera_file());
  for (const GlassScene& scene : scenes) {
    const RgbImage exact = pipeline::to_rgb(scene.exact);
    results.picture(picture_file(scene.name + "-exact", exact), 3 * exact.width);
    if (scene.name == "penetration") continue;  // no other picture
    for (const StudyFile& file : mesh_files_of(scene)) results.file(file);
  }
  for (const BlendedCase& c : cases) {
    const bool shown = c.scene == "wall"
                           ? c.method.find("depth") != std::string::npos || c.method[0] == 'p'
                       : c.scene == "ring" ? c.method.starts_with("back") || c.method[0] == 'p'
                                           : c.scene == "panes" && c.method[0] == 'f';
    if (!shown) continue;
    results.picture(picture_file(c.name, c.picture), c.command, 3 * c.picture.width);
    results.file(c.file);
  }
  return results.files();
}

}  // namespace fathom::studies
