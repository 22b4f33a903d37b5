// The extension module _textbook, which fathom.scan and fathom.pipeline load when they are called:
// so the textbooks' pipeline does not slow down `import fathom`. Cases and answers are JSON,
// exactly as the commands read and print them; options are those of the commands, read by the
// commands' own parsers.

#include <pybind11/stl.h>

#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "apps/options/pipeline_options.h"
#include "apps/options/scene_options.h"
#include "apps/shell/program.h"
#include "apps/shell/values.h"
#include "apps/textbook/drawing/drawings.h"
#include "apps/textbook/pipeline/pipeline_report.h"
#include "apps/textbook/pipeline/stage_cases.h"
#include "apps/textbook/scan/scan_cases.h"
#include "bindings.h"
#include "entry_points.h"
#include "fathom/failures/errors.h"
#include "fathom/pipeline/geometry/window_transform.h"
#include "fathom/render_by_pipeline.h"
#include "running.h"
#include "values.h"

namespace py = pybind11;

namespace fathom::python {
namespace {

using app::cases::Json;
using Words = std::vector<std::string>;

Json parsed(const std::string& text) {
  Json name;
  return app::cases::parse_case(text, name);
}

/// The options of a command of the pipeline, given as on its command line: {"--shading", "phong"}.
pipeline::PipelineOptions options_of(const Words& words) {
  app::PipelineArguments arguments;
  Cull cull = Cull::none;
  DepthFormat format = pipeline::PipelineOptions().depth_format;
  pipeline::PipelineOptions options;
  const auto declare = [&](app::Command& program) {
    app::Command& command = program.command("render", "", "");
    arguments.add_to(command, "Pipeline");
    app::add_cull_option(command, cull);
    command.option("--depth-format", "NAME", app::into(format.storage, storage_named), "");
    command.option("--mapping", "NAME", app::into(format.mapping, mapping_named), "");
    command.option("--c", "C", app::into(format.c, app::parse_number), "");
    command.option(
        "--background", "R,G,B",
        [&](const std::string& text) { arguments.set_background(app::parse_colour(text)); }, "");
    command.runs([&](const app::Console&) {
      options = arguments.options(cull);
      return 0;
    });
  };
  Words all{"render"};
  all.insert(all.end(), words.begin(), words.end());
  app::run_arguments(all, {declare}, {});
  options.depth_format = format;
  pipeline::require_meaningful(options);
  return options;
}

/// How a case of scan is asked for.
struct ScanRequest {
  std::string algorithm, arithmetic;
  bool trace, runs, draw;
  std::optional<int> subpixel_bits;
  std::optional<std::string> ties, edges;
};

/// Numbers are written as "p/q" in exact arithmetic, else as the floats that they are.
app::scan::Form form_of(const ScanRequest& request) {
  app::scan::Form form{.numbers = {.exact = request.arithmetic == "exact", .trace = request.trace},
                       .runs = request.runs,
                       .subpixel_bits = request.subpixel_bits};
  if (request.ties) form.ties = app::scan::parse_ties(*request.ties);
  if (request.edges) form.edges = app::scan::parse_edges(*request.edges);
  return form;
}

/// (answer, picture): the picture is empty where none is asked for.
py::tuple scan_case(const std::string& text, const ScanRequest& request) {
  namespace scan = app::scan;
  std::string answer, picture;
  run([&](const auto&) {
    const scan::NamedAlgorithm algorithm = scan::parse_algorithm(request.algorithm);
    scan::Form form = form_of(request);
    scan::require_effect(algorithm, form, request.draw);
    if (request.draw && algorithm.answers.steps) form.numbers.trace = true;
    const Json object = parsed(text);
    Json json =
        scan::in_arithmetic(algorithm, scan::parse_arithmetic(request.arithmetic))(object, form);
    if (request.draw)
      picture = app::drawing::document("fathom.scan: " + algorithm.name,
                                       {app::drawing::draw_scan(algorithm.name, object, json)});
    if (!request.trace) json.erase("trace");
    answer = json.dump();
    return 0;
  });
  return py::make_tuple(answer, picture);
}

ScanRequest scan_request(const std::string& algorithm, const std::string& arithmetic, bool trace,
                         bool runs, bool draw, std::optional<int> subpixel_bits,
                         const std::optional<std::string>& ties,
                         const std::optional<std::string>& edges) {
  return {algorithm, arithmetic, trace, runs, draw, subpixel_bits, ties, edges};
}

std::string run_stage(const std::string& stage, const std::string& record, bool binary64) {
  return run([&](const auto&) {
    return app::run_stage(stage, parsed(record),
                          binary64 ? pipeline::Precision::binary64 : pipeline::Precision::binary32)
        .dump();
  });
}

py::list stages() {
  py::list list;
  for (const app::StageDescription& stage : app::pipeline_stages())
    list.append(py::make_tuple(stage.name, stage.takes, stage.adds));
  return list;
}

/// (trace, picture, whether the viewport stretches the picture)
py::tuple trace(const SharedScene& shared, const Camera& camera, std::uint32_t number,
                const std::optional<std::array<std::int64_t, 2>>& pixel, bool fragments,
                const Words& words, bool draw) {
  const std::shared_ptr<const Scene> scene = shared.scene;
  const pipeline::PipelineOptions options = options_of(words);
  pipeline::TraceRequest request{
      .fragments = fragments,
      .merger = pixel.has_value(),
      .painter = options.hidden_surface == pipeline::HiddenSurface::painter};
  if (pixel) request.pixel = pipeline::Pixel{(*pixel)[0], (*pixel)[1]};
  std::string answer, picture;
  run([&](const auto&) {
    const Json json =
        app::to_json(pipeline::trace_primitive(*scene, camera, options, number, request));
    if (draw)
      picture = app::drawing::document("fathom.pipeline.trace",
                                       app::drawing::draw_trace(json, camera.width, camera.height));
    answer = json.dump();
    return 0;
  });
  return py::make_tuple(answer, picture, pipeline::is_stretched(camera, options));
}

py::array picture_of(const RgbImage& image) {
  py::array_t<std::uint8_t> array({static_cast<py::ssize_t>(image.height),
                                   static_cast<py::ssize_t>(image.width), py::ssize_t{3}});
  if (!image.pixels.empty())
    std::memcpy(array.mutable_data(), image.pixels.data(), 3 * image.pixels.size());
  return array;
}

/// (Z, id, picture, camera with near and far, statistics as JSON, whether the picture is stretched)
py::tuple render(const SharedScene& shared, const Camera& camera, const Words& words) {
  const std::shared_ptr<const Scene> scene = shared.scene;
  const pipeline::PipelineOptions options = options_of(words);
  PipelineRendering rendering = run([&](const auto&) {
    return render_by_pipeline(*scene, camera, options, {Channel::Z, Channel::id}, true);
  });
  std::optional<pipeline::PainterStatistics> painter;
  if (options.hidden_surface == pipeline::HiddenSurface::painter) painter = rendering.painter;
  const Shape shape{static_cast<py::ssize_t>(camera.height),
                    static_cast<py::ssize_t>(camera.width)};
  auto& channels = rendering.map.channels;
  return py::make_tuple(
      array_of(std::move(std::get<Samples<float>>(channels.at(0).values)), shape),
      array_of(std::move(std::get<Samples<std::uint32_t>>(channels.at(1).values)), shape),
      picture_of(rendering.picture), rendering.camera,
      app::as_json({{"", camera.width, camera.height, rendering.statistics, painter}}),
      pipeline::is_stretched(camera, options));
}

}  // namespace
}  // namespace fathom::python

PYBIND11_MODULE(_textbook, module) {
  using namespace fathom::python;
  module.doc() = "What fathom.scan and fathom.pipeline call.";
  Module textbook(module);
  end_work_at_exit(textbook);
  Class<ScanRequest>(textbook, "ScanRequest").def(pybind11::init(&scan_request));
  textbook.def("scan_algorithms", &fathom::app::scan::algorithm_names)
      .def("scan_case", &scan_case)
      .def("run_stage", &run_stage)
      .def("stages", &stages)
      .def("trace", &trace)
      .def("render", &render);
}
