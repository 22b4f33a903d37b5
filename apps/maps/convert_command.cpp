// fathom convert MAP -o OTHER

#include <fmt/format.h>

#include <cctype>
#include <map>
#include <memory>

#include "apps/maps/map_view.h"
#include "apps/options/render_options.h"
#include "apps/shell/known_files.h"
#include "apps/shell/numbers.h"
#include "apps/shell/output_file.h"
#include "apps/shell/program.h"
#include "fathom/camera/camera_files.h"
#include "fathom/image/convert.h"
#include "fathom/image/map_files.h"
#include "fathom/image/point_cloud.h"
#include "fathom/image/surface.h"
#include "fathom/numeric/errors.h"
#include "fathom/scene/read_scene.h"

namespace fathom::app {
namespace {

struct ConvertArguments {
  std::string map, output, camera, channel, from, to, baseline, doffs, frame = "world";
  StorageOptions storage;
};

bool ends_with_ply(const std::string& name) {
  std::string suffix = std::filesystem::path(name).extension();
  for (char& c : suffix) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return suffix == ".ply";
}

DepthQuantity quantity_named(const std::string& option, const std::string& name) {
  static const std::map<std::string, DepthQuantity> quantities{
      {"Z", DepthQuantity::planar_depth},
      {"distance", DepthQuantity::ray_distance},
      {"disparity", DepthQuantity::disparity}};
  const auto found = quantities.find(name);
  if (found == quantities.end()) {
    throw UsageError(option + ": '" + name +
                     "' is none of Z (planar depth), distance (along the ray) and disparity");
  }
  return found->second;
}

MapView view_for(const DepthMap& map, const ConvertArguments& arguments) {
  if (!arguments.camera.empty()) {
    note_input(arguments.camera);
    const std::vector<Camera> cameras = read_cameras(arguments.camera);
    if (cameras.size() != 1) {
      throw UsageError(
          fmt::format("--camera: a path of {} cameras; a map has one", cameras.size()));
    }
    if (cameras[0].width != map.width || cameras[0].height != map.height) {
      throw InputError(fmt::format("{}: a camera of {}x{} pixels, but the map has {}x{}",
                                   arguments.camera, cameras[0].width, cameras[0].height, map.width,
                                   map.height));
    }
    return view_of(cameras[0]);
  }
  const std::optional<Camera> camera = camera_of(map, arguments.map);
  if (!camera) throw InputError(arguments.map + ": carries no camera; expected --camera FILE");
  return view_of(*camera);
}

std::optional<StereoRig> rig(const ConvertArguments& arguments) {
  if (arguments.baseline.empty()) {
    if (!arguments.doffs.empty()) throw UsageError("--doffs needs --baseline");
    return std::nullopt;
  }
  StereoRig result;
  result.baseline = parse_number("--baseline", arguments.baseline);
  if (!arguments.doffs.empty()) result.doffs = parse_number("--doffs", arguments.doffs);
  return result;
}

PointCloudOptions point_options(const ConvertArguments& arguments) {
  PointCloudOptions options;
  if (arguments.frame != "world" && arguments.frame != "camera") {
    throw UsageError("--frame: '" + arguments.frame + "' is neither world nor camera");
  }
  options.frame = arguments.frame == "world" ? PointFrame::world : PointFrame::camera;
  const std::string& dtype = arguments.storage.dtype;
  if (!dtype.empty() && dtype != "float32" && dtype != "float64") {
    throw UsageError("--dtype: '" + dtype + "' is neither float32 nor float64");
  }
  options.binary64 = dtype != "float32";
  return options;
}

int write_points(const DepthMap& map, const ConvertArguments& arguments) {
  const PointCloudOptions options = point_options(arguments);
  if (!arguments.to.empty() || !arguments.channel.empty()) {
    throw UsageError("--to and --channel do not go with a point cloud");
  }
  if (!arguments.storage.compression.empty() || !arguments.storage.png_scale.empty()) {
    throw UsageError("--compression and --png-scale do not go with a point cloud");
  }
  const MapView view = view_for(map, arguments);
  OutputFile output(arguments.output);
  output.write([&](const auto& path) { write_point_cloud(map, view, path, options); });
  output.commit();
  return done;
}

DepthMap converted(DepthMap map, const ConvertArguments& arguments) {
  if (arguments.to.empty()) {
    if (!arguments.from.empty()) throw UsageError("--from needs --to");
    return map;
  }
  const DepthQuantity to = quantity_named("--to", arguments.to);
  const DepthQuantity from =
      quantity_named("--from", arguments.from.empty() ? "Z" : arguments.from);
  // PFM, PNG and NPY do not name their channel: it is what the user says it is.
  if (map.channels.size() == 1 && map.texts.empty()) map.channels[0].name = channel_of(from);
  return convert_quantity(map, from, to, view_for(map, arguments), rig(arguments));
}

/// The map with this channel only.
DepthMap only(DepthMap map, const ImageChannel& channel) {
  map.channels = std::vector<ImageChannel>{channel};
  return map;
}

/// The map in the type that the format asks for; an EXR keeps all channels as they are.
DepthMap stored(DepthMap map, const ConvertArguments& arguments, MapFormat format) {
  const bool codes = map.png_scale.has_value();
  if (format == MapFormat::exr && arguments.channel.empty() && !codes && map.channels.size() > 1) {
    return map;
  }
  const ImageChannel* channel = map.find(arguments.channel.empty() ? "Z" : arguments.channel);
  if (channel == nullptr && arguments.channel.empty() && map.channels.size() == 1) {
    channel = &map.channels[0];
  }
  // Identifiers, normals and so on are not depths: they keep their type.
  if (channel != nullptr && kind_of(*channel) != ChannelKind::depth) return only(map, *channel);

  const DepthEncoding encoding = arguments.storage.encoding_for(format);
  StoredType type = StoredType::binary32;
  std::optional<double> scale;
  if (encoding.type == DepthEncoding::Type::binary64) type = StoredType::binary64;
  if (encoding.type == DepthEncoding::Type::scaled_unorm16) {
    type = StoredType::scaled_unorm16;
    scale = encoding.scale;
    // A PNG that is written again as it was keeps its scale.
    if (arguments.storage.png_scale.empty() && codes) scale = map.png_scale;
  }
  return with_storage(map, arguments.channel, type, scale);
}

int run_convert(const ConvertArguments& arguments) {
  note_input(arguments.map);
  if (ends_with_ply(arguments.output)) {
    return write_points(read_map(arguments.map), arguments);
  }
  const MapFormat format = arguments.storage.format_of(arguments.output);
  const WriteOptions options = arguments.storage.write_options(0);
  (void)arguments.storage.encoding_for(format);
  const DepthMap map = stored(converted(read_map(arguments.map), arguments), arguments, format);
  OutputFile output(arguments.output);
  output.write([&](const auto& path) { write_map(map, path, format, options); });
  output.commit();
  return done;
}

}  // namespace

void add_convert(Program& program) {
  const auto arguments = std::make_shared<ConvertArguments>();
  CLI::App* command = program.add_command(
      "convert", "Convert a map to another format, quantity, or a point cloud",
      "  fathom convert spot.exr -o spot.npy --dtype float32\n"
      "  fathom convert spot.exr --to distance -o distance.pfm\n"
      "  fathom convert spot.exr --to disparity --baseline 0.2 -o disparity.pfm\n"
      "  fathom convert spot.exr -o points.ply\n"
      "\nConversions start from stored, already rounded values; 'fathom render --channels "
      "distance'\n"
      "gives the exact ray distance, and render to .png or .npy rounds once.");
  command->add_option("MAP", arguments->map, "The map: EXR, PFM, PNG or NPY")->required();
  command
      ->add_option("-o,--output", arguments->output,
                   "A map (.exr, .pfm, .png, .npy) or a point cloud (.ply)")
      ->required();
  command->add_option("--channel", arguments->channel,
                      "The channel to convert (default Z, or the only one)");
  command->add_option("--to", arguments->to,
                      "Z (planar depth), distance (along the ray) or disparity");
  command->add_option("--from", arguments->from, "What the map has (default Z)");
  command->add_option("--camera", arguments->camera,
                      "Camera file, where the map does not carry its camera");
  command->add_option("--baseline", arguments->baseline, "Of the stereo pair, for disparity");
  command->add_option("--doffs", arguments->doffs,
                      "Difference of the principal points of the stereo pair (default 0)");
  command->add_option("--frame", arguments->frame, "Of the point cloud: world (default) or camera");
  arguments->storage.add_to(*command);
  command->callback(
      [arguments, &program] { program.run = [arguments] { return run_convert(*arguments); }; });
}

}  // namespace fathom::app
