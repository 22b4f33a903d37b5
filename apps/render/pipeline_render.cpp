#include "apps/render/pipeline_render.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "apps/shell/known_files.h"
#include "apps/shell/numbers.h"
#include "apps/shell/output_file.h"
#include "apps/shell/program.h"
#include "apps/shell/progress.h"
#include "fathom/camera/camera_files.h"
#include "fathom/numeric/errors.h"
#include "fathom/pipeline/window_transform.h"
#include "fathom/render.h"

namespace fathom::app {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const pipeline::PipelineStatistics& s) {
  return {{"triangles", s.triangles},
          {"not_finite", s.not_finite},
          {"clipped_away", s.clipped_away},
          {"clipped", s.clipped},
          {"degenerate", s.degenerate},
          {"culled", s.culled},
          {"drawn", s.drawn},
          {"turned_by_snapping", s.turned_by_snapping},
          {"fragments", s.fragments},
          {"depth_passed", s.depth_passed},
          {"shaded", s.shaded},
          {"blocks_skipped", s.blocks_skipped},
          {"blocks_full", s.blocks_full},
          {"near", s.near},
          {"far", s.far},
          {"facings",
           {{"compared", s.facings.compared},
            {"front_in_world", s.facings.front_in_world},
            {"front_in_ndc", s.facings.front_in_ndc},
            {"front_in_window", s.facings.front_in_window},
            {"disagreeing", s.facings.disagreeing}}}};
}

Json to_json(const pipeline::PainterStatistics& s) {
  return {{"z_disjoint", s.z_disjoint},
          {"x_disjoint", s.settled[0]},
          {"y_disjoint", s.settled[1]},
          {"behind_plane", s.settled[2]},
          {"before_plane", s.settled[3]},
          {"projections_disjoint", s.settled[4]},
          {"moved", s.moved},
          {"splits", s.splits},
          {"comparisons", s.comparisons}};
}

void expect_possible(const RenderArguments& a, MapFormat format) {
  if (a.stream) throw UsageError("--stream is for the fast engine, not for pipeline");
  if (!a.verify.empty())
    throw UsageError("--verify is for exact engines; fathom compare puts maps beside each other");
  if (a.deep || a.cryptomatte)
    throw UsageError("--deep and --cryptomatte are for exact engines, not for pipeline");
  if (!a.samples.empty() || a.depth_buffer.channels() > 3)
    throw UsageError("--samples and --against-exact are for exact engines, not for pipeline");
  if (format == MapFormat::png)
    throw UsageError(
        "the pipeline writes its map as .exr, .pfm or .npy; --image is for the picture");
  if (format == MapFormat::npy &&
      a.storage.encoding_for(format).type != DepthEncoding::Type::binary32)
    throw UsageError("--dtype: the pipeline's depths are float32");
}

void warn_of(const pipeline::PipelineStatistics& s, const Console& console) {
  if (s.triangles == 0) console.warn("the scene has no triangle: the map is background");
  if (s.not_finite > 0)
    console.warn(fmt::format("{} of {} triangles: a corner is no number after the transform",
                             s.not_finite, s.triangles));
  if (s.turned_by_snapping > 0)
    console.warn(fmt::format("{} of {} triangles: turned over or without area by snapping",
                             s.turned_by_snapping, s.triangles));
}

}  // namespace

int run_pipeline_render(const RenderArguments& arguments, const Console& console) {
  const MapFormat format = arguments.storage.format_of(arguments.output);
  expect_possible(arguments, format);
  const WriteOptions write_options =
      arguments.storage.write_options(arguments.scene.thread_count());
  const std::vector<Channel> channels =
      parse_channels(arguments.channels.empty() ? "Z" : arguments.channels);
  if (format != MapFormat::exr && channels.size() != 1)
    throw UsageError(fmt::format("{} holds one channel, not '{}'; .exr holds them all",
                                 arguments.output, arguments.channels));
  const pipeline::PipelineOptions options = arguments.pipeline.get(arguments.cull);
  arguments.camera.check();
  if (options.texture != "checker") note_input(options.texture);
  const bool with_picture = !arguments.pipeline.image.empty();
  if (with_picture) expect_png("--image", arguments.pipeline.image);

  const Scene scene = arguments.scene.read(console, true, with_picture);
  const std::vector<Camera> cameras = arguments.camera.get(scene);
  const auto names = map_names("-o", arguments.output, cameras.size());
  std::vector<OutputFile> maps(names.begin(), names.end()), pictures, notes;
  if (with_picture)
    for (const auto& name : map_names("--image", arguments.pipeline.image, cameras.size()))
      pictures.emplace_back(name);
  const auto write_note = [&](const std::string& name, const std::string& text) {
    if (name.empty() || name == "-") return;
    notes.emplace_back(name).write(text);
  };

  Json report = Json::array();
  std::vector<Camera> used;
  Progress progress(console, "rendering");
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    if (i == 0 && pipeline::is_stretched(cameras[i], options))
      console.warn("the viewport's width : height is not the camera's: the picture is stretched");
    const PipelineRendering result =
        render_by_pipeline(scene, cameras[i], options, channels, with_picture);
    used.push_back(result.camera);
    maps[i].write([&](const auto& path) { write_map(result.map, path, format, write_options); });
    if (with_picture) pictures[i].write([&](const auto& path) { write_png(result.picture, path); });
    if (i == 0) warn_of(result.statistics, console);
    Json entry{{"map", names[i]},
               {"engine", "pipeline"},
               {"width", result.map.width},
               {"height", result.map.height}};
    entry.update(to_json(result.statistics));
    if (options.hidden_surface == pipeline::HiddenSurface::painter)
      entry["painter"] = to_json(result.painter);
    report.push_back(std::move(entry));
  }
  const std::string statistics = (report.size() == 1 ? report[0] : report).dump(2) + "\n";
  notes.reserve(2);
  write_note(arguments.save_camera, fathom::to_json(used) + "\n");
  write_note(arguments.statistics, statistics);
  for (auto* outputs : {&notes, &pictures, &maps})
    for (OutputFile& output : *outputs) output.commit();
  if (arguments.save_camera == "-") print(fathom::to_json(used) + "\n");
  if (arguments.statistics == "-") print(statistics);
  return done;
}

}  // namespace fathom::app
