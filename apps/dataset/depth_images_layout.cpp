// fathom dataset tum | 7scenes | scannet | scannetpp | replica | kitti | nerf: depth images as
// 16-bit PNG.

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <unordered_map>
#include <vector>

#include "apps/camera/import_sources.h"
#include "apps/dataset/dataset_command.h"
#include "apps/options/output_arguments.h"
#include "apps/shell/failures.h"
#include "apps/shell/known_files.h"
#include "fathom/camera/camera.h"
#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/text/parse_json.h"

namespace fathom::app {
namespace {

using Json = nlohmann::ordered_json;

/// The text of a transforms.json whose frames have the depth images of their cameras beside them,
/// as Nerfstudio has it: "depth_file_path" of each frame, in the order of the cameras, and
/// "depth_unit_scale_factor", 0.001, of all. Frames without a camera are left out.
/// Fails    InputError where the file cannot be read.
std::string transforms_with_depths(const std::string& file, const std::vector<Camera>& cameras,
                                   const std::vector<std::string>& depths) {
  std::unordered_map<std::string, std::string> depth_of;
  for (std::size_t i = 0; i < cameras.size(); ++i) depth_of[cameras[i].name] = depths[i];
  Json json;
  try {
    json = text::parse_json<Json>(files::InputFile(file).text());
    std::size_t number = 0;
    for (const char* list : {"frames", "test_frames"}) {
      if (!json.contains(list)) continue;
      Json frames = Json::array();
      for (Json& frame : json.at(list)) {
        const std::string name = frame.value("file_path", std::to_string(number++));
        const auto found = depth_of.find(name);
        if (found == depth_of.end()) continue;
        frame["depth_file_path"] = found->second;
        frames.push_back(std::move(frame));
      }
      json[list] = std::move(frames);
    }
    json["depth_unit_scale_factor"] = 0.001;
  } catch (const nlohmann::json::exception& error) {
    throw InputError(file + ": has changed while it was in use: " + error.what());
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

struct DepthImagesArguments : DatasetArguments {
  ImportArguments cameras;
};

/// What makes a list of the images: its text from their cameras and the names of their files.
using MakeList = std::string (*)(const DepthImagesArguments& arguments,
                                 const std::vector<Camera>& cameras,
                                 const std::vector<std::string>& files);

/// A layout: where its depth images lie, and what their codes mean.
struct DepthImages {
  const char* name;
  const char* description;
  /// Of the files; output_arguments.h has the fields.
  const char* pattern;
  /// Codes of a unit of the scene, a metre.
  double scale;
  /// The code of a pixel without a surface.
  std::uint16_t none;
  /// The list of the images, where there is one.
  const char* list;
  MakeList make_list;
  const char* example;
};

std::string tum_list(const DepthImagesArguments&, const std::vector<Camera>&,
                     const std::vector<std::string>& files) {
  std::string text = "# depth maps\n# timestamp filename\n";
  for (const std::string& file : files) {
    const std::string time = std::filesystem::path(file).stem().string();
    text += fmt::format("{} {}\n", time, file);
  }
  return text;
}

std::string nerf_list(const DepthImagesArguments& arguments, const std::vector<Camera>& cameras,
                      const std::vector<std::string>& files) {
  return transforms_with_depths(arguments.input, cameras, files);
}

const std::vector<DepthImages>& all_depth_images() {
  static const std::vector<DepthImages> all{
      {"tum",
       "Render depth images of TUM RGB-D: depth/TIME.png, 5000 codes per metre, and depth.txt",
       "depth/{stem}.png", 5000, 0, "depth.txt", tum_list,
       "  fathom dataset tum groundtruth.txt --images rgb.txt --K freiburg3 \\\n"
       "    --mesh room.ply -o exact"},
      {"7scenes",
       "Render depth images of 7-Scenes: NAME.depth.png in millimetres, 65535 for no depth",
       "{stem}.depth.png", 1000, 65535, nullptr, nullptr,
       "  fathom dataset 7scenes chess/seq-01 --mesh chess.ply -o exact"},
      {"scannet", "Render depth images of ScanNet: depth/N.png in millimetres", "depth/{stem}.png",
       1000, 0, nullptr, nullptr,
       "  fathom dataset scannet scene0000_00 --mesh scene0000_00_vh_clean.ply -o exact"},
      {"scannetpp", "Render depth images of ScanNet++: depth/NAME.png in millimetres",
       "depth/{stem}.png", 1000, 0, nullptr, nullptr,
       "  fathom dataset scannetpp iphone/pose_intrinsic_imu.json \\\n"
       "    --mesh mesh_aligned_0.05.ply -o exact"},
      {"replica",
       "Render depth images of Replica (iMAP, NICE-SLAM): results/depthN.png, 6553.5 codes per "
       "metre",
       "results/depth{index:06}.png", 6553.5, 0, nullptr, nullptr,
       "  fathom dataset replica Replica/room0 --mesh Replica/room0_mesh.ply -o exact"},
      {"kitti", "Render depth images of KITTI: NAME.png, 256 codes per metre", "{stem}.png", 256, 0,
       nullptr, nullptr,
       "  fathom dataset kitti calib.txt --poses poses/00.txt --camera 2 \\\n"
       "    --size 1241x376 --mesh 00.ply -o exact"},
      {"nerf",
       "Render depth images of Nerfstudio: depth/NAME.png, 1000 codes per unit, and a matching "
       "transforms.json",
       "depth/{stem}.png", 1000, 0, "transforms.json", nerf_list,
       "  fathom dataset nerf transforms.json --mesh mesh.ply -o exact"}};
  return all;
}

/// The depth image of a map, with codes as the layout has them.
files::Bytes encoded(const DepthImages& layout, const DepthMap& map, const MapPlan& plan,
                     const std::string& name) {
  if (layout.none == 0) return encode_map(map, name, MapFormat::png, plan.writing);
  DepthMap changed = map;
  Samples<std::uint16_t>* codes = changed.values<std::uint16_t>("Z");
  if (std::ranges::find(*codes, layout.none) != codes->end()) {
    throw OutputError(
        fmt::format("{}: a depth has the code {}, which stands for none", name, layout.none));
  }
  std::ranges::replace(*codes, std::uint16_t{0}, layout.none);
  return encode_map(changed, name, MapFormat::png, plan.writing);
}

std::vector<Camera> read_cameras(const ImportSource& source, const DepthImagesArguments& arguments,
                                 const Console& console) {
  note_input(arguments.input);
  Warnings warnings;
  std::vector<Camera> cameras = chosen_cameras(source.read(arguments.cameras, warnings),
                                               arguments.input, arguments.cameras.choice, warnings);
  console.warn(warnings);
  return cameras;
}

int run_depth_images(const DepthImages& layout, const ImportSource& source,
                     DepthImagesArguments& arguments, const Console& console) {
  arguments.cameras.input = arguments.input;
  Views views;
  views.cameras = arguments.camera_changes.applied(read_cameras(source, arguments, console));
  views.noun = "depth image";
  views.inputs = fmt::format("none {}\n", layout.none);
  const std::vector<std::string> names =
      names_of_outputs("the layout", layout.pattern, views.cameras);
  views.files.push_back({names, [&](const auto& map, const auto& plan, const auto& name) {
                           return encoded(layout, map, plan, name);
                         }});
  if (layout.list != nullptr) {
    views.lists.push_back({layout.list, [&](const auto&) {
                             return layout.make_list(arguments, views.cameras, names);
                           }});
  }
  arguments.render.output = layout.pattern;
  arguments.render.storage.png_scale = layout.scale;
  make_views(arguments, views, console);
  return done;
}

void add_depth_images(Command& family, const DepthImages& layout, const ImportSource& source) {
  const auto arguments = std::make_shared<DepthImagesArguments>();
  Command& command = family.command(layout.name, layout.description, layout.example);
  arguments->add_to(command, source.input);
  arguments->add_scene_to(command);
  source.declare(command, arguments->cameras);
  // The list of NeRF has the intrinsics of its input.
  if (layout.make_list != nerf_list) arguments->camera_changes.add_to(command);
  arguments->render.storage.add_beyond_to(command);
  add_distortion_option(command, arguments->cameras.choice);
  command.runs([arguments, &layout, source](const Console& console) {
    return run_depth_images(layout, source, *arguments, console);
  });
}

}  // namespace

void add_depth_image_layouts(Command& family) {
  std::vector<ImportSource> sources = data_set_sources();
  for (const ImportSource& source : program_sources()) sources.push_back(source);
  for (const DepthImages& layout : all_depth_images()) {
    const auto source = std::ranges::find_if(sources, [&](const ImportSource& one) {
      return std::string_view(one.name) == layout.name;
    });
    add_depth_images(family, layout, *source);
  }
}

}  // namespace fathom::app
