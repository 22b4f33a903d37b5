// fathom pipeline trace SCENE…

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "apps/options/camera_options.h"
#include "apps/options/render_options.h"
#include "apps/options/scene_options.h"
#include "apps/render/pipeline_options.h"
#include "apps/shell/numbers.h"
#include "apps/shell/output_file.h"
#include "apps/shell/program.h"
#include "fathom/numeric/errors.h"
#include "fathom/pipeline/trace.h"

namespace fathom::app {
namespace {

using Json = nlohmann::ordered_json;
using pipeline::TriangleTrace;

struct TraceArguments {
  SceneOptions scene;
  CameraOptions camera;
  PipelineArguments pipeline;
  std::string triangle = "0", pixel, cull = "none";
  bool json = false;
};

const char* name_of(pipeline::Facing facing) {
  constexpr const char* names[] = {"front", "back", "edge on"};
  return names[static_cast<std::size_t>(facing)];
}

Json as_json(const TriangleTrace& t) {
  Json corners = Json::array(), polygon = Json::array();
  for (const auto& c : t.corners)
    corners.push_back({{"mesh", c.mesh}, {"world", c.world}, {"eye", c.eye}, {"clip", c.clip}});
  for (const auto& c : t.polygon)
    polygon.push_back(
        {{"clip", c.clip}, {"ndc", c.ndc}, {"window", c.window}, {"snapped", c.snapped}});
  Json answer{
      {"near", t.near}, {"far", t.far}, {"vertex_transform", corners}, {"clipping", polygon}};
  answer["facing"] = {{"world", name_of(t.in_world)}};
  if (!t.polygon.empty()) {
    answer["facing"]["ndc"] = name_of(t.in_ndc);
    answer["facing"]["window"] = name_of(t.in_window);
    answer["culled"] = t.culled;
  }
  answer["fragments"] = t.fragments;
  if (t.sample) {
    answer["sample"] = {
        {"edges", t.sample->edges},       {"covered", t.sample->covered},
        {"weights", t.sample->weights},   {"attribute_weights", t.sample->attribute_weights},
        {"window_z", t.sample->window_z}, {"depth", t.sample->depth},
        {"stored", t.sample->stored.bits}};
  }
  return answer;
}

std::string as_text(const TriangleTrace& t) {
  constexpr const char* names = "ABC";
  std::string text =
      fmt::format("clip range: near {}, far {}\n\nvertex transform\n", t.near, t.far);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& c = t.corners[k];
    text += fmt::format("  {}  mesh   ({})\n     world  ({})\n     eye    ({})\n     clip   ({})\n",
                        names[k], fmt::join(c.mesh, ", "), fmt::join(c.world, ", "),
                        fmt::join(c.eye, ", "), fmt::join(c.clip, ", "));
  }
  if (t.polygon.empty()) return text + "\nclipping: nothing is left in the view volume\n";
  text += fmt::format("\nclipping, division, viewport: {} corners\n", t.polygon.size());
  for (const auto& c : t.polygon)
    text += fmt::format("  clip     ({})\n  NDC      ({})\n  window   ({})\n  snapped  ({})\n\n",
                        fmt::join(c.clip, ", "), fmt::join(c.ndc, ", "), fmt::join(c.window, ", "),
                        fmt::join(c.snapped, ", "));
  text += fmt::format(
      "facing: {} by N.V in the world, {} by n_z in NDC, {} by the determinant in the window{}\n",
      name_of(t.in_world), name_of(t.in_ndc), name_of(t.in_window), t.culled ? ": culled" : "");
  text += fmt::format("scan conversion: {} fragments\n", t.fragments);
  if (!t.sample) return text;
  const auto& s = *t.sample;
  text += fmt::format("\nsample: {}\n  edge functions       {}\n  weights              {}\n",
                      s.covered ? "covered" : "not covered", fmt::join(s.edges, ", "),
                      fmt::join(s.weights, ", "));
  text += fmt::format(
      "  attribute weights    {}\n  window depth         {}\n  depth along the view {}\n"
      "  stored               {:#x}\n",
      fmt::join(s.attribute_weights, ", "), s.window_z, s.depth, s.stored.bits);
  return text;
}

int run_trace(const TraceArguments& arguments, const Console& console) {
  const auto options = arguments.pipeline.get(arguments.cull);
  const std::uint32_t number = parse_count("--triangle", arguments.triangle);
  std::optional<pipeline::Pixel> pixel;
  if (!arguments.pixel.empty()) {
    const auto [x, y] = parse_pixel("--pixel", arguments.pixel);
    pixel = pipeline::Pixel{x, y};
  }
  arguments.camera.check();
  const Scene scene = arguments.scene.read(console, false, true);
  const Camera camera = arguments.camera.get_one(scene, "trace");
  if (pixel && (pixel->x >= camera.width || pixel->y >= camera.height))
    throw UsageError(fmt::format("--pixel: {},{} is outside the image of {}x{} pixels", pixel->x,
                                 pixel->y, camera.width, camera.height));
  const TriangleTrace trace = pipeline::trace_triangle(scene, camera, options, number, pixel);
  print(arguments.json ? as_json(trace).dump(2) + "\n" : as_text(trace));
  return done;
}

}  // namespace

void add_pipeline(Program& program) {
  CLI::App* family = program.add_command("pipeline", "Look into the graphics pipeline",
                                         "  fathom pipeline trace spot.obj --triangle 238");
  family->require_subcommand(1);
  const auto arguments = std::make_shared<TraceArguments>();
  CLI::App* command = program.add_command(
      "trace", "Follow a triangle through the stages of the pipeline",
      "  fathom pipeline trace data/meshes/spot.obj --triangle 238 --pixel 640,360\n"
      "  fathom pipeline trace cube.obj --triangle 3 --precision binary64 --json",
      family);
  arguments->scene.add_to(*command);
  arguments->camera.add_to(*command);
  command->add_option("--triangle", arguments->triangle, "Its number in the scene (default 0)");
  command->add_option("--pixel", arguments->pixel,
                      "X,Y: also what becomes of the sample at this pixel's centre");
  command->add_flag("--json", arguments->json, "Answer in JSON");
  add_cull_option(*command, arguments->cull);
  arguments->pipeline.add_stages_to(*command);
  command->callback([arguments, &program] {
    program.run = [arguments, &program] { return run_trace(*arguments, program.console); };
  });
}

}  // namespace fathom::app
