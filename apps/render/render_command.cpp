#include "apps/render/render_command.h"

#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/options/depth_format_options.h"
#include "apps/options/map_arguments.h"
#include "apps/options/pipeline_options.h"
#include "apps/options/scene_options.h"
#include "apps/shell/command.h"
#include "apps/shell/output_file.h"
#include "apps/shell/values.h"
#include "fathom/depth_format/depth_format.h"
#include "fathom/failures/unknown_name.h"
#include "fathom/image/channel_names.h"
#include "fathom/image/channel_table.h"
#include "fathom/image/map_formats.h"
#include "fathom/rendering/options.h"

namespace fathom::app {
namespace {

EngineName parse_engine(const std::string& text) {
  return parse_word<EngineName>(text, {{name_of(Engine::fast).data(), EngineName::fast},
                                       {name_of(Engine::reference).data(), EngineName::reference},
                                       {"pipeline", EngineName::pipeline}});
}

/// "1000" or "all", the greatest number.
std::uint64_t parse_pixels(const std::string& text) {
  constexpr auto all = std::numeric_limits<std::uint64_t>::max();
  if (text.find_first_not_of("0123456789") == std::string::npos) return parse_positive(text);
  return parse_word<std::uint64_t>(text, {{"all", all}}, "a number of pixels, at least 1");
}

/// "material" or "object,material"
std::vector<MatteKind> parse_mattes(const std::string& list) {
  return parse_distinct(list, [](const std::string& name) {
    return parse_word<MatteKind>(name, {{"object", std::nullopt},
                                        {"material", Segmentation::material},
                                        {"group", Segmentation::group},
                                        {"part", Segmentation::part}});
  });
}

void add_scene(Command& command, RenderArguments& arguments) {
  command.begin_group("Scene");
  arguments.scene.add_to(command);
  command.flag("--stream", arguments.stream,
               "Stream binary STL or PLY meshes from disk, so that they may exceed memory; implies "
               "--engine fast. Channel A spills to $TMPDIR");
  arguments.motion.add_to(command);
}

void add_camera(Command& command, RenderArguments& arguments) {
  command.begin_group("Camera");
  arguments.camera.add_to(command);
  command.option("--save-camera", "FILE", arguments.save_camera,
                 "Write the camera to this file (JSON; - is standard output)");
}

void add_contents(Command& command, RenderArguments& arguments) {
  command.begin_group("Channels and engine");
  command.option(
      "--channels", "LIST",
      [&arguments](const std::string& text) { arguments.take(parse_channels_of_outputs(text)); },
      "Channels of the map, from " + joined(names_of_channels(), ", ") + "; also " +
          names_of_contents() +
          " (default Z,A in EXR and NPZ; Z in other formats and with --engine pipeline). An -o "
          "without NAME= has all of them except mask");
  command.flag(
      "--deep", arguments.deep,
      "Write a deep EXR with all visible fragments of each pixel, sorted: depths Z and ZBack, "
      "triangle id, exact area and alpha A; compressed by zips (default), rle or none");
  command.flag("--cryptomatte", arguments.cryptomatte,
               "Add Cryptomatte channels by object with exact coverage to the EXR");
  command.option("--cryptomatte-by", "LIST", into(arguments.mattes_by, parse_mattes),
                 "Add Cryptomatte channels by each of object, material, group, part");
  command.option("--engine", "NAME", into(arguments.engine, parse_engine),
                 "Engine: fast (default), reference (identical map, slow) or pipeline (simulates a "
                 "graphics pipeline)");
  command.option("--samples", "PATTERN", into(arguments.samples, sample_pattern),
                 "Add channel Asampled, the share of a pixel's samples that a surface covers. "
                 "PATTERN is 1, 2, 4, 8, 16 (standard positions of Direct3D and Vulkan), "
                 "rotated-grid, regular:N, jittered:N or jittered:N:SEED (N by N samples)");
  add_cull_option(command, arguments.cull);
}

void add_checks(Command& command, RenderArguments& arguments) {
  command.begin_group("Checks");
  command.option(
      "--stats", "FILE", arguments.statistics,
      "Write counts of how decisions were made to this file (JSON; - is standard output)");
  command.option("--verify", "N|all", into(arguments.verified_pixels, parse_pixels),
                 "Recompute N random pixels, and every pixel that was hard to decide, with exact "
                 "arithmetic, and compare all channels bit for bit; exit status 1 if one differs");
}

/// suffixes_of_maps() with a remark behind some of them.
std::string suffixes_with_remarks() {
  constexpr std::pair<std::string_view, std::string_view> remarks[] = {
      {".png", " (16 bit)"},
      {".bin", " (COLMAP)"},
      {".tif", " (GeoTIFF, for cameras that look straight down)"}};
  std::string text = suffixes_of_maps();
  for (const auto& [suffix, remark] : remarks)
    text.insert(text.find(suffix) + suffix.size(), remark);
  return text;
}

/// "unorm16, unorm24, unorm32: code (UINT); …"
std::string storages_with_channels() {
  std::vector<std::string> codes, values;
  for (const Storage storage : all_storages) {
    if (storage == Storage::float64) continue;
    (is_unorm(storage) ? codes : values).emplace_back(name_of(storage));
  }
  return joined(codes, ", ") + ": code (UINT); " + joined(values, ", ") +
         ": value (FLOAT); float64: halves of its bits, Zwindow.high and Zwindow.low (UINT)";
}

}  // namespace

void DepthBufferArguments::add_to(Command& command) {
  command.option("--depth-format", "NAME", into(storage, storage_named),
                 "Add channel Zwindow, the value in a depth buffer of this format, and Zdecoded, "
                 "the depth decoded from it; near and far are the camera's. " +
                     storages_with_channels());
  command.option("--mapping", "NAME", into(mapping, mapping_named),
                 "Mapping of --depth-format: " + list_of_mappings());
  command.option("--c", "C", into(c, parse_number), "Constant C of --mapping log (default 1)");
  command.flag("--against-exact", against_exact,
               "Add Zerror (Zdecoded minus the exact depth), Zwinner (the triangle that wins in "
               "this format) and Zfight (1 where the wrong triangle wins); needs --depth-format");
}

void RenderArguments::add_to(Command& command) {
  command.begin_group("Output");
  add_output(command);
  add_scene(command, *this);
  add_camera(command, *this);
  add_contents(command, *this);
  command.begin_group("Depth buffer");
  depth_buffer.add_to(command);
  command.begin_group("File format");
  storage.add_to(command);
  add_background(command);
  add_checks(command, *this);
  command.begin_group("");
  const std::string heading = "With --engine pipeline";
  of_pipeline_.push_back(command
                             .option("--image", "FILE", into(image, parse_png_name),
                                     "Write the colour picture to this PNG")
                             .below(heading));
  of_pipeline_.push_back(command
                             .option("--shutter", "OPEN,CLOSE", into(shutter, parse_pair),
                                     "Interval of --motion times for --antialias temporal:N, "
                                     "temporal-area:N or taa:N; the map shows the time CLOSE")
                             .below(heading));
  pipeline.add_to(command, heading);
  of_pipeline_.insert(of_pipeline_.end(), pipeline.declared().begin(), pipeline.declared().end());
}

void RenderArguments::add_output(Command& command) {
  Option option = add_output_options(
      command, "FILE",
      [this](const std::vector<std::string>& texts) {
        outputs.clear();
        for (const std::string& text : texts) outputs.push_back(parse_output(text));
        output = outputs.front().pattern;
      },
      "Write the map here; the suffix selects the format: " + suffixes_with_remarks() +
          ". Missing folders are created. NAME=FILE selects the contents, as --channels does; "
          "repeat the option for several files: -o depth=z.png -o mask=m.png -o normal=n.png");
  option.required();
}

/// A single value is the background of the map; a colour is the background of the picture.
void RenderArguments::add_background(Command& command) {
  command.option(
      "--background", "D|R,G,B",
      [this](const std::string& text) {
        picture_background_.reset();
        storage.background.reset();
        if (text.find(',') == std::string::npos) {
          storage.background = parse_background(text);
        } else {
          picture_background_ = parse_colour(text);
          pipeline.set_background(*picture_background_);
        }
      },
      "Depth without a surface: inf (default), 0, nan or a number that no surface has (codes of a "
      "PNG and COLMAP maps: 0). R,G,B, from 0 to 1, sets the background of --image (default "
      "0,0,0)");
}

void add_render(Command& program, const Render& by_exact_engine, const Render& by_pipeline) {
  const auto arguments = std::make_shared<RenderArguments>();
  Command& command = program.command(
      "render", "Render an exact depth map of a scene",
      "  fathom render spot.obj -o spot.exr\n"
      "  fathom render room.json --camera camera.json --channels Z,id,N -o room.exr\n"
      "  fathom render spot.obj --view 90,0 --save-camera side.json -o side.pfm\n"
      "  fathom render spot.obj -o spot.png --png-scale 1000  # 1000 codes per unit\n"
      "  fathom render spot.obj --channels Z,id,N --background 0 -o maps/spot.npz\n"
      "  fathom render city.stl --stream --size 16384x16384 -o city.exr\n"
      "  fathom render scan.ply --engine fast --verify 1000 -o scan.exr\n"
      "  fathom render room.json --deep -o room.deep.exr\n"
      "  fathom render spot.obj --camera path.json -o 'view-{index:04}.exr'\n"
      "  fathom render spot.obj --camera path.json --scale 0.5 \\\n"
      "    -o 'depth=z/{index:04}.png' -o 'mask=m/{index:04}.png'\n"
      "  fathom render spot.obj --near 0.1 --far 100 --depth-format unorm16 \\\n"
      "    --against-exact -o stored.exr\n"
      "  fathom render spot.obj --engine pipeline --shading phong --antialias msaa:4 \\\n"
      "    --image spot.png -o spot.exr\n"
      "\nKeys of camera and scene files, and warnings: camera-files.md and scene-files.md in the "
      "documentation.");
  arguments->add_to(command);
  command.runs([arguments, by_exact_engine, by_pipeline](const Console& console) {
    return arguments->engine == EngineName::pipeline ? by_pipeline(*arguments, console)
                                                     : by_exact_engine(*arguments, console);
  });
}

}  // namespace fathom::app
