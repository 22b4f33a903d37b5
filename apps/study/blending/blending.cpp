#include "apps/study/blending/blending.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/study/page.h"
#include "apps/study/pipeline_scenes.h"
#include "apps/study/plot.h"
#include "apps/study/results.h"
#include "apps/study/study.h"
#include "fathom/camera/camera_files.h"
#include "fathom/failures/errors.h"
#include "fathom/reference/probe.h"

namespace fathom::studies {
namespace {

using pipeline::Colour;
using pipeline::ColourImage;
using pipeline::DrawOrder;
using pipeline::PipelineOptions;

constexpr double opacity = 0.5;
constexpr Colour background{0.08, 0.08, 0.12};
/// Colours are kept in binary32 after each of at most a dozen blends.
constexpr double rounding = 12 * 0x1p-24;

Camera camera_of_glass() {
  Camera camera = front_camera(72, 72, 1, 20);
  // No edge runs through a sample, where snapping would decide.
  camera.projection.cx += 0.1234567;
  camera.projection.cy += 0.7654321;
  return camera;
}

Scene painted(Scene scene) {
  paint_each_triangle(scene);
  DrawState glass;
  glass.alpha = opacity;
  scene.draw_states = {glass};
  return scene;
}

/// "wall-back-to-front-read-only-depth"
std::string case_name(const std::string& scene, const std::string& method) {
  std::string name = scene + "-";
  for (const char c : method) {
    if (c == ' ' || c == '-') name += '-';
    if (c >= 'a' && c <= 'z') name += c;
  }
  return name;
}

/// Panes side on to the view, in an order that is that of no depths.
Scene panes() {
  std::vector<MeshPoint> v;
  std::vector<CornerIndices> t;
  int k = 0;
  for (const double z : {5.0, 3.5, 6.5, 4.0, 5.5}) {
    const auto first = static_cast<std::uint32_t>(v.size());
    const double x = 0.1 * z * std::cos(1.3 * k), y = 0.1 * z * std::sin(1.3 * k), s = 0.3 * z;
    v.insert(v.end(), {{x - s, y - s, z}, {x + s, y - s, z}, {x, y + s, z}});
    t.push_back({first, first + 1, first + 2});
    ++k;
  }
  return scene_of(std::move(v), std::move(t));
}

/// An opaque wall between the panes, drawn before them.
Scene with_wall(Scene scene) {
  Mesh wall;
  wall.vertices = {{-9, -0.5, 4.7}, {9, -0.5, 4.7}, {0, 9, 4.7}};
  wall.colours.assign(3, {0.9F, 0.9F, 0.9F, 1});
  wall.triangles = {{0, 1, 2}};
  wall.face_count = 1;
  scene.meshes.push_back(std::move(wall));
  scene.objects.insert(scene.objects.begin(), {.mesh = 1, .name = "wall"});
  scene.draw_states.insert(scene.draw_states.begin(), DrawState());
  return scene;
}

Colour colour_of(const Scene& scene, const TriangleOrigin& origin) {
  const Mesh& mesh = scene.meshes[scene.objects[origin.object].mesh];
  const auto& c = mesh.colours[mesh.triangles[origin.triangle][0]];
  return {static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])};
}

PipelineOptions options_of(const std::string& method, Scene& scene) {
  PipelineOptions options = precise_options();
  options.background = background;
  DrawState& state = scene.draw_states.back();
  if (method == "painter's algorithm") {
    options.hidden_surface = pipeline::HiddenSurface::painter;
    return options;
  }
  state.depth_write = method == "file order, depth test";
  if (method == "file order" || method == "random order" || method == "front to back" ||
      method == "back to front")
    state.depth_test = Comparison::always;
  if (method == "random order") options.draw_order = DrawOrder::random;
  if (method == "front to back") options.draw_order = DrawOrder::front_to_back;
  if (method.starts_with("back to front")) options.draw_order = DrawOrder::back_to_front;
  return options;
}

/// The options of `fathom render` that stand for a method.
std::string flags_of(const PipelineOptions& options) {
  if (options.hidden_surface == pipeline::HiddenSurface::painter)
    return " --hidden-surface painter";
  if (options.draw_order == DrawOrder::front_to_back) return " --draw-order front-to-back";
  if (options.draw_order == DrawOrder::back_to_front) return " --draw-order back-to-front";
  if (options.draw_order == DrawOrder::random) return " --draw-order random";
  return "";
}

std::string mesh_file(const std::string& scene, std::size_t object) {
  return fmt::format("{}-{}.obj", scene, object);
}

/// A scene file with the state of each object.
StudyFile scene_file(const std::string& name, const std::string& glass, const Scene& scene) {
  std::string meshes;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const DrawState state = draw_state_of(scene, i);
    meshes += fmt::format("{}\n  {{ \"file\": \"{}\"", i == 0 ? "" : ",", mesh_file(glass, i));
    if (state.alpha)
      meshes += fmt::format(
          ", \"draw\": {{ \"alpha\": {}, \"depth_test\": \"{}\", \"depth_write\": {} }}",
          *state.alpha, state.depth_test ? "always" : "nearer", state.depth_write);
    meshes += " }";
  }
  return {name + ".json", "{ \"meshes\": [" + meshes + "\n] }\n"};
}

void compare(const ColourImage& exact, const ColourImage& image, const std::vector<bool>& seen,
             BlendedCase& result) {
  double sum = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (!seen[i]) continue;
    ++result.seen;
    double greatest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double error = std::abs(image.pixels[i][k] - exact.pixels[i][k]);
      greatest = std::max(greatest, error);
      sum += error / 3;
    }
    result.wrong += greatest > rounding;
    result.greatest_error = std::max(result.greatest_error, greatest);
  }
  result.mean_error = sum / static_cast<double>(std::max<std::size_t>(1, result.seen));
}

}  // namespace

GlassScene glass_scene(const std::string& name) {
  GlassScene glass{name, {}, {}};
  if (name == "panes") glass.scene = painted(panes());
  if (name == "wall") glass.scene = with_wall(painted(panes()));
  if (name == "ring") glass.scene = painted(cyclic_overlap());
  if (name == "penetration") glass.scene = painted(penetration());
  glass.exact = exactly_blended(glass.scene, camera_of_glass(), background);
  return glass;
}

ColourImage exactly_blended(const Scene& scene, const Camera& camera, const Colour& behind) {
  ColourImage image{camera.width, camera.height, {}};
  image.pixels.reserve(std::size_t{camera.width} * camera.height);
  for (std::uint32_t y = 0; y < camera.height; ++y) {
    for (std::uint32_t x = 0; x < camera.width; ++x) {
      Colour colour = behind;
      const std::vector<CoveringTriangle> covering = probe(scene, camera, x, y);
      for (auto t = covering.rbegin(); t != covering.rend(); ++t) {
        if (!t->counts) continue;
        const double alpha = draw_state_of(scene, t->origin.object).alpha.value_or(1);
        const Colour over = colour_of(scene, t->origin);
        for (std::size_t k = 0; k < 3; ++k) colour[k] = alpha * over[k] + (1 - alpha) * colour[k];
      }
      image.pixels.push_back(colour);
    }
  }
  return image;
}

BlendedCase blend(const GlassScene& glass, const std::string& method) {
  Scene scene = glass.scene;
  const PipelineOptions options = options_of(method, scene);
  const ColourImage image = pipeline::render_frame(scene, camera_of_glass(), options, true).picture;
  std::vector<bool> seen;
  for (const Colour& colour : glass.exact.pixels) seen.push_back(colour != background);
  BlendedCase result{.scene = glass.name, .method = method};
  compare(glass.exact, image, seen, result);
  result.picture = pipeline::to_rgb(image);
  result.name = case_name(glass.name, method);
  result.file = scene_file(result.name, glass.name, scene);
  result.command = fmt::format(
      "fathom render {0}.json --camera camera.json --engine pipeline{1} --precision binary64 "
      "--subpixel-bits 16 --shading none --background {2},{3},{4} --image {0}.png -o map.exr",
      result.name, flags_of(options), background[0], background[1], background[2]);
  return result;
}

std::vector<StudyFile> mesh_files_of(const GlassScene& glass) {
  std::vector<StudyFile> files;
  for (std::size_t i = 0; i < glass.scene.objects.size(); ++i) {
    Scene part;
    part.meshes = {glass.scene.meshes[glass.scene.objects[i].mesh]};
    files.push_back({mesh_file(glass.name, i), obj_of(part)});
  }
  return files;
}

StudyFile glass_camera_file() {
  return {"camera.json", to_json(camera_of_glass()) + "\n"};
}

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
