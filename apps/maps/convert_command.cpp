// fathom convert MAP -o OTHER

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>
#include <variant>

#include "apps/commands.h"
#include "apps/options/camera_options.h"
#include "apps/options/map_arguments.h"
#include "apps/options/storage_options.h"
#include "apps/shell/command.h"
#include "apps/shell/console.h"
#include "apps/shell/failures.h"
#include "apps/shell/output_file.h"
#include "apps/shell/values.h"
#include "fathom/camera/camera.h"
#include "fathom/failures/errors.h"
#include "fathom/image/channel_names.h"
#include "fathom/image/convert.h"
#include "fathom/image/map_files.h"
#include "fathom/image/png_files.h"
#include "fathom/image/point_cloud.h"
#include "fathom/image/surface.h"
#include "fathom/text/ascii.h"
#include "fathom/text/counted.h"
#include "fathom/text/printable.h"

namespace fathom::app {
namespace {

struct ConvertArguments {
  std::vector<std::string> maps;
  std::string output, camera, channel;
  std::optional<DepthQuantity> from, to;
  std::optional<double> baseline, doffs;
  PointFrame frame = PointFrame::world;
  StorageOptions storage;
};

DepthQuantity parse_quantity(const std::string& text) {
  return parse_enumerator(text, all_depth_quantities);
}

PointFrame parse_frame(const std::string& text) {
  return parse_enumerator(text, all_point_frames);
}

bool ends_with_ply(const std::string& name) {
  return text::in_small_letters(std::filesystem::path(name).extension().string()) == ".ply";
}

std::optional<StereoRig> rig_of(const ConvertArguments& arguments) {
  if (arguments.baseline) return StereoRig{*arguments.baseline, arguments.doffs.value_or(0)};
  if (arguments.doffs) throw UsageError("--doffs needs --baseline");
  return std::nullopt;
}

/// The cameras of the camera file, one for each map; none if no file is given. If there are more or
/// fewer, maps find theirs by name.
std::vector<Camera> cameras_in_file(const ConvertArguments& arguments, const Console& console) {
  if (arguments.camera.empty()) return {};
  const std::string_view why =
      ends_with_ply(arguments.output) ? points_need_no_lens : takes_no_lens;
  return cameras_of_maps(arguments.maps, read_cameras_without_lens(arguments.camera, console, why));
}

/// The camera that a map carries.
Camera own_camera(const DepthMap& map, const std::string& name) {
  const std::optional<Camera> camera = camera_of(map, name);
  if (!camera) throw InputError(name + ": carries no camera; expected --camera FILE");
  return *camera;
}

/// The camera of the file, of the size of the map, or else the map's own.
Camera camera_for(const DepthMap& map, const ConvertArguments& arguments,
                  const std::vector<Camera>& in_file, std::size_t number) {
  if (in_file.empty()) return own_camera(map, arguments.maps[number]);
  const Camera& camera = in_file[number];
  require_size_of(map, camera, arguments.camera);
  return camera;
}

bool holds_codes(const DepthMap& map) {
  return std::ranges::any_of(map.channels, [](const ImageChannel& channel) {
    return std::holds_alternative<Samples<std::uint16_t>>(channel.values);
  });
}

/// The map of a file. Codes without a scale, as other programs write them, have the scale of
/// --png-scale, which is then used up: `scale` becomes empty.
DepthMap read_with_scale(const std::string& name, std::optional<double>& scale) {
  DepthMap map = read_map_argument(name);
  if (!map.png_scale && holds_codes(map)) std::swap(map.png_scale, scale);
  return map;
}

/// Why a map does not take --png-scale.
std::string why_no_scale(const DepthMap& map) {
  return holds_codes(map) ? fmt::format(" carries its scale, {:g}", *map.png_scale)
                          : std::string(" holds no codes, which the scale would be for");
}

/// The only map, with the camera of the camera file if one is given; uses --png-scale up if the map
/// takes it.
DepthMap read_only_map(ConvertArguments& arguments, const Console& console) {
  DepthMap map = read_with_scale(arguments.maps.front(), arguments.storage.png_scale);
  const std::vector<Camera> in_file = cameras_in_file(arguments, console);
  if (!in_file.empty()) map.camera = camera_for(map, arguments, in_file, 0);
  return map;
}

/// The cloud of the points of all maps.
int write_points(const ConvertArguments& arguments, const Console& console) {
  if (arguments.to || !arguments.channel.empty()) {
    throw UsageError("--to and --channel do not go with a point cloud");
  }
  StorageOptions others = arguments.storage;
  others.png_scale.reset();
  if (others.compression || others.has_png_options()) {
    throw UsageError("--compression, --png-beyond and --png-sidecar do not go with a point cloud");
  }
  if (arguments.storage.background || !arguments.storage.channel_names.empty()) {
    throw UsageError("--background and --channel-name do not go with a point cloud");
  }
  const std::size_t maps = arguments.maps.size();
  if (maps > 1 && arguments.frame == PointFrame::camera) {
    throw UsageError("--frame camera needs a single map: each map has its own camera frame");
  }
  PointCloud cloud({.frame = arguments.frame,
                    .binary64 = arguments.storage.dtype != StoredType::binary32,
                    .numbers_views = maps > 1});
  const std::vector<Camera> in_file = cameras_in_file(arguments, console);
  OutputFile output(arguments.output);
  Progress progress(console, "converting");
  const auto report = progress.reporter();
  for (std::size_t i = 0; i < maps; ++i) {
    std::optional<double> scale = arguments.storage.png_scale;
    const DepthMap map = read_with_scale(arguments.maps[i], scale);
    if (scale) throw UsageError("--png-scale: " + arguments.maps[i] + why_no_scale(map));
    cloud.add(map, camera_for(map, arguments, in_file, i), arguments.maps[i]);
    if (report) report(static_cast<double>(i + 1) / static_cast<double>(maps));
  }
  output.write(cloud.encode());
  output.commit();
  return done;
}

/// The mask of a map without a channel of this name.
int write_mask(const DepthMap& map, const ConvertArguments& arguments, MapFormat format) {
  arguments.storage.check_pictures(arguments.output, format, {.channels = {}, .is_mask = true});
  if (arguments.to || arguments.from) throw UsageError("--to and --from do not go with a mask");
  OutputFile output(arguments.output);
  output.write(encode_mask(map, arguments.output));
  output.commit();
  return done;
}

DepthMap converted(DepthMap map, const ConvertArguments& arguments) {
  if (!arguments.to) {
    if (arguments.from) throw UsageError("--from needs --to");
    return map;
  }
  const DepthQuantity from = arguments.from.value_or(DepthQuantity::planar_depth);
  if (holds_codes(map)) map = with_storage(map, arguments.channel, StoredType::binary64);
  // PFM, PNG and NPY do not name their channel: the user names the quantity.
  if (map.channels.size() == 1 && map.texts.empty()) map.channels[0].name = name_of(from);
  return convert_quantity(map, from, *arguments.to, own_camera(map, arguments.maps.front()),
                          rig_of(arguments), arguments.storage.background);
}

/// The map with this channel only.
DepthMap only(DepthMap map, const ImageChannel& channel) {
  map.channels = std::vector<ImageChannel>{channel};
  return map;
}

/// The map with those channels only that are the parts of one: N.X, N.Y and N.Z.
DepthMap only_parts(DepthMap map, const std::string& name) {
  std::erase_if(map.channels,
                [&](const ImageChannel& channel) { return !channel.name.starts_with(name + "."); });
  return map;
}

/// Every channel; depth channels have the requested type.
DepthMap all_stored(DepthMap map, const StorageOptions& storage) {
  if (!storage.dtype) return map;
  for (ImageChannel& channel : map.channels) {
    if (kind_of(channel) != ChannelKind::depth) continue;
    channel = std::move(with_storage(map, channel.name, *storage.dtype).channels.front());
  }
  return map;
}

/// The channel that was asked for, Z, or the only one.
const ImageChannel* chosen_channel(const DepthMap& map, const std::string& name) {
  const ImageChannel* channel = map.find(name.empty() ? "Z" : name);
  const bool is_only_one = channel == nullptr && name.empty() && map.channels.size() == 1;
  return is_only_one ? &map.channels[0] : channel;
}

/// The map in the type that the format asks for; an EXR keeps all channels as they are.
DepthMap stored(DepthMap map, const ConvertArguments& arguments, MapFormat format) {
  const bool codes = map.png_scale.has_value();
  if (holds_all_channels(format) && arguments.channel.empty() && !codes &&
      map.channels.size() > 1) {
    return all_stored(std::move(map), arguments.storage);
  }
  if (map.find(arguments.channel) == nullptr) {
    DepthMap parts = only_parts(map, arguments.channel);
    if (!parts.channels.empty()) return parts;
  }
  // The only channel may have parts: normals of a PNG.
  const bool is_one_of_parts = map.channels.size() > 1 && names_of_channels(map).size() == 1;
  if (arguments.channel.empty() && is_one_of_parts) return map;
  const ImageChannel* channel = chosen_channel(map, arguments.channel);
  // Identifiers, normals and so on are not depths: they keep their type.
  if (channel != nullptr && kind_of(*channel) != ChannelKind::depth) return only(map, *channel);

  const DepthEncoding encoding = arguments.storage.encoding_for(format);
  switch (encoding.type) {
    case DepthEncoding::Type::binary32:
      return with_storage(map, arguments.channel, StoredType::binary32);
    case DepthEncoding::Type::binary64:
      return with_storage(map, arguments.channel, StoredType::binary64);
    case DepthEncoding::Type::scaled_unorm16:
      break;
  }
  // A PNG that is written again as it was keeps its scale.
  const bool keeps_scale = codes && !arguments.storage.png_scale;
  return with_storage(map, arguments.channel, StoredType::scaled_unorm16,
                      keeps_scale ? map.png_scale : encoding.scale, encoding.beyond_is_none);
}

/// With the camera, where the format is a GeoTIFF.
WriteOptions write_options(const DepthMap& map, const ConvertArguments& arguments,
                           MapFormat format) {
  WriteOptions options = arguments.storage.write_options(0);
  if (format != MapFormat::tiff) return options;
  options.camera = own_camera(map, arguments.maps.front());
  require_place_in_world(*options.camera, arguments.output);
  return options;
}

/// The contents of the file of a map. A PNG of a channel `mask` is a mask.
StoredContents contents_of_file(const DepthMap& map, MapFormat format) {
  return {.channels = names_of_channels(map),
          .is_mask = format == MapFormat::png && map.values<float>("mask") != nullptr};
}

/// The map and, if requested, the description of its codes.
void write_outputs(const DepthMap& map, const ConvertArguments& arguments, MapFormat format,
                   const WriteOptions& options) {
  OutputFile output(arguments.output);
  std::vector<OutputFile*> outputs{&output};
  std::optional<OutputFile> sidecar;
  if (arguments.storage.png_sidecar) {
    sidecar.emplace(arguments.storage.sidecar_of(arguments.output));
    sidecar->write(png_sidecar(map));
    outputs.push_back(&*sidecar);
  }
  output.write([&](const auto& path) { write_map(map, path, format, options); });
  OutputFile::commit_together(outputs);
}

int run_convert(const ConvertArguments& given, const Console& console) {
  if (ends_with_ply(given.output)) return write_points(given, console);
  if (given.maps.size() > 1) {
    throw UsageError(given.output + ": several maps make a point cloud; expected .ply");
  }
  if (!map_format_of(given.output) && !is_written_through(given.output)) {
    throw UsageError(given.output + ": the suffix of a map is one of " + suffixes_of_maps() +
                     ", the suffix of a point cloud is .ply");
  }
  ConvertArguments arguments = given;
  // --png-scale may be the scale of the map: the output is checked with it when the map is read.
  arguments.storage.png_scale.reset();
  const MapFormat format = arguments.storage.format_of(given.output);
  arguments.storage.png_scale = given.storage.png_scale;
  DepthMap read = read_only_map(arguments, console);
  (void)arguments.storage.format_of(given.output);
  arguments.channel = own_channel_name(read, given.channel);
  if (arguments.channel == "mask" && read.find("mask") == nullptr) {
    return write_mask(read, arguments, format);
  }
  StorageOptions dress = arguments.storage;
  // A conversion has already set the background, because it needs the background of its input.
  if (arguments.to) dress.background.reset();
  const DepthMap map = dress.dressed(
      stored(converted(std::move(read), arguments), arguments, format), arguments.output);
  arguments.storage.check_pictures(arguments.output, format, contents_of_file(map, format));
  write_outputs(map, arguments, format, write_options(map, arguments, format));
  warn_of_codes_beyond(map, arguments.output, console);
  return done;
}

}  // namespace

void add_convert(Command& program) {
  const auto arguments = std::make_shared<ConvertArguments>();
  Command& command = program.command(
      "convert", "Convert a map to another format or quantity, or to a point cloud",
      "  fathom convert spot.exr -o spot.npy --dtype float32\n"
      "  fathom convert spot.exr --to distance -o distance.pfm\n"
      "  fathom convert spot.exr --to disparity --baseline 0.2 -o disparity.pfm\n"
      "  fathom convert spot.exr --background 0 --channel-name Z=Y -o for-opencv.exr\n"
      "  fathom convert spot.exr -o spot.npz             # every channel, for NumPy\n"
      "  fathom convert spot.exr -o points.ply\n"
      "  fathom convert views/*.exr -o cloud.ply         # all points of all maps\n"
      "  fathom convert spot.exr --channel N -o normals.png\n"
      "  fathom convert spot.exr --channel mask -o mask.png\n"
      "  fathom convert plan.exr -o plan.tif             # GeoTIFF, if seen from above\n"
      "  fathom convert a.jpg.geometric.bin -o a.exr     # a dense map of COLMAP\n"
      "  fathom convert vtk.npy --camera camera.json -o vtk.exr\n"
      "\nConversions start from the stored values, which are rounded already; 'fathom render "
      "--channels\n"
      "distance' gives the exact ray distance, and render to .png or .npy rounds once.");
  command
      .arguments("MAP", arguments->maps,
                 "Map to convert (" + names_of_readable_maps() +
                     "); several make one point cloud of all their points")
      .required();
  add_output_option(command, "FILE", arguments->output,
                    "Write this map (" + suffixes_of_maps() +
                        "; .bin is for COLMAP, .tif for GIS) or point cloud (.ply)")
      .required();
  command.option(
      "--channel", "NAME", arguments->channel,
      "Channel to convert (default Z, or the only channel), or mask: 255 where a surface "
      "is, as 8-bit PNG");
  command.option("--to", "NAME", into(arguments->to, parse_quantity),
                 "Convert to Z (planar depth), distance (along the ray) or disparity");
  command.option("--from", "NAME", into(arguments->from, parse_quantity),
                 "Quantity that the map contains: Z (default), distance or disparity");
  command.option(
      "--camera", "FILE", arguments->camera,
      "Camera file, if the map does not contain its camera: one camera for each map, in order, or "
      "cameras that are named like the maps (a.jpg for a.npy). EXR, PNG and NPZ store it");
  command.option("--baseline", "B", into(arguments->baseline, parse_number),
                 "Baseline of the stereo pair, for disparity");
  command.option("--doffs", "D", into(arguments->doffs, parse_number),
                 "Difference of the principal points of the stereo pair (default 0)");
  command.option("--frame", "NAME", into(arguments->frame, parse_frame),
                 "Frame of the point cloud: world (default) or camera");
  arguments->storage.add_to(command);
  command.option("--background", "D", into(arguments->storage.background, parse_background),
                 "Depth without a surface: 0, nan, inf or a number that no surface has (default: "
                 "as in MAP; for disparities 0, because inf is Middlebury's 'unknown')");
  command.runs([arguments](const Console& console) { return run_convert(*arguments, console); });
}

}  // namespace fathom::app
