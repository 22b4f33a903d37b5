#include "apps/options/camera_options.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>

#include "apps/options/map_arguments.h"
#include "apps/shell/failures.h"
#include "apps/shell/known_files.h"
#include "apps/shell/values.h"
#include "fathom/camera/camera_files.h"
#include "fathom/camera/camera_import.h"
#include "fathom/camera/image_points.h"
#include "fathom/camera/lens.h"
#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/image/directions.h"
#include "fathom/image/map_files.h"
#include "fathom/mesh_files/read_mesh.h"
#include "fathom/scene/framing.h"
#include "fathom/text/counted.h"
#include "fathom/text/printable.h"

namespace fathom::app {
namespace {

double parse_angle(const std::string& text) {
  const double degrees = parse_number(text);
  if (degrees > 0 && degrees < 180) return degrees;
  throw UsageError("'" + text + "' is not an angle between 0 and 180 degrees");
}

Vector3 parse_up(const std::string& text) {
  if (text.find(',') != std::string::npos) return parse_vector(text);
  return parse_word<Vector3>(text,
                             {{"x", {1, 0, 0}},
                              {"y", {0, 1, 0}},
                              {"z", {0, 0, 1}},
                              {"-x", {-1, 0, 0}},
                              {"-y", {0, -1, 0}},
                              {"-z", {0, 0, -1}}},
                             "a direction X,Y,Z");
}

/// The camera that frames the scene.
Camera framing_camera(const Scene& scene, const View& view, const LensChoice& lens) {
  const std::string file = scene.sources.empty() ? "scene" : scene.sources.back().path;
  const auto is_empty = [&](const Object& object) { return scene.meshes[object.mesh].is_empty(); };
  if (std::ranges::all_of(scene.objects, is_empty)) {
    throw InputError(file + ": the scene has no triangle; expected one to frame, or --camera");
  }
  try {
    return frame_scene(scene, view, lens);
  } catch (const InputError& error) {
    throw InputError(std::string(error.what()) + "; give --camera");
  }
}

std::vector<Camera> cameras_of_map(std::span<const std::byte> bytes, const std::string& file) {
  const std::optional<Camera> camera = camera_of(read_map_argument(bytes, file), file);
  if (!camera) throw InputError(file + ": the map carries no camera, expected a camera file");
  return {*camera};
}

/// Whether a text has the keys of a transforms.json. A camera file has none of them.
bool looks_like_nerf(std::string_view text) {
  const auto has = [&](std::string_view key) { return text.find(key) != text.npos; };
  return text.find_first_not_of(" \t\r\n") == text.find('{') && has("\"frames\"") &&
         has("\"transform_matrix\"");
}

/// Whether a file is a mesh that is not JSON, which a camera file may be.
bool is_mesh(const files::InputFile& input, const std::string& file) {
  const std::size_t first = input.text().find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos || input.text()[first] == '{' || input.text()[first] == '[') {
    return false;
  }
  return !is_map(input.bytes()) && mesh_files::recognise_format(input.bytes(), file);
}

/// The cameras of a camera file or a map, without fault.
std::vector<Camera> read_any_cameras(const std::string& file, const DirectionReader& directions,
                                     const Console& console) {
  note_input(file);
  if (is_colmap_model(file)) {
    throw InputError(fmt::format(
        "{0}: is a COLMAP model, expected a camera file; 'fathom camera import colmap {0} -o "
        "cameras.json' makes one",
        file));
  }
  const files::InputFile input(file);
  if (looks_like_nerf(input.text())) {
    throw InputError(fmt::format(
        "{0}: is a transforms.json of NeRF, expected a camera file; 'fathom camera import nerf {0} "
        "-o cameras.json' makes one",
        file));
  }
  if (is_mesh(input, file)) {
    throw InputError(file +
                     ": is a mesh, expected a camera file or a map that contains its camera");
  }
  Warnings warnings;
  std::vector<Camera> cameras = is_map(input.bytes())
                                    ? cameras_of_map(input.bytes(), file)
                                    : read_cameras(input.text(), file, warnings, directions);
  console.warn(warnings);
  if (cameras.empty()) throw InputError(file + ": an empty list; expected at least one camera");
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    if (const auto fault = find_fault(cameras[i])) {
      throw InputError(cameras.size() == 1 ? fmt::format("{}: {}", file, *fault)
                                           : fmt::format("{}: camera {}: {}", file, i, *fault));
    }
  }
  return cameras;
}

/// The image has whole pixels, for which width and height may be scaled differently.
void warn_of_unequal_scales(const std::vector<Camera>& given, const std::vector<Camera>& scaled,
                            const Console& console) {
  for (std::size_t i = 0; i < given.size(); ++i) {
    const Camera &from = given[i], &to = scaled[i];
    if (std::uint64_t{to.width} * from.height == std::uint64_t{to.height} * from.width) continue;
    console.warn(fmt::format(
        "--scale: {}x{} pixels become {}x{}, so that fx is scaled by {:.6g} and fy by {:.6g}",
        from.width, from.height, to.width, to.height, 1.0 * to.width / from.width,
        1.0 * to.height / from.height));
    return;
  }
}

}  // namespace

Option add_up_option(Command& command, Vector3& up) {
  return command.option("--up", "DIRECTION", into(up, parse_up),
                        "World direction that points up: x, y (default), z, -x, -y, -z or X,Y,Z");
}

std::array<Option, 2> add_view_options(Command& command, View& view) {
  const Option direction = command.option(
      "--view", "AZ,EL",
      [&view](const std::string& text) {
        const auto [azimuth, elevation] = parse_pair(text);
        view.azimuth = azimuth;
        view.elevation = elevation;
      },
      "Direction of the eye, AZIMUTH,ELEVATION in degrees (default 35,25): at azimuth 0 the right "
      "of the image is +x (+y if x or -x is up), azimuth 90 is on that side; elevation 90 is "
      "above");
  return {direction, add_up_option(command, view.up)};
}

std::vector<Option> add_lens_options(Command& command, LensChoice& lens) {
  const Option size = command.option(
      "--size", "WxH",
      [&lens](const std::string& text) {
        const auto [width, height] = parse_size(text);
        lens.width = width;
        lens.height = height;
      },
      "Image size in pixels, WIDTHxHEIGHT (default 1280x720)");
  Option angle = command.option("--fov", "DEG", into(lens.vertical_fov, parse_angle),
                                "Vertical field of view in degrees (default 40)");
  Option length = command.option("--focal", "PIXELS", into(lens.focal, parse_number),
                                 "Focal length in pixels (fx = fy), instead of --fov");
  const Option parallel = command.option(
      "--orthographic", "HEIGHT",
      [&lens](const std::string& text) {
        lens.model = ProjectionModel::orthographic;
        lens.vertical_extent = parse_number(text);
      },
      "Parallel projection; height of the image in scene units");
  angle.excludes(length).excludes(parallel);
  length.excludes(parallel);
  return {size, angle, length, parallel};
}

void DistortionOptions::add_to(Command& command) {
  command.option("--model", "NAME", model_,
                 "Lens model, e.g. SIMPLE_RADIAL, OPENCV or OPENCV_14 (default: a pinhole). Focal "
                 "length and framing are as without distortion; a panorama shows the full turn");
  command.option(
      "--distortion", "K1,K2,...",
      [this](const std::string& text) {
        numbers_.emplace();
        for (const std::string& number : parse_list(text))
          numbers_->push_back(parse_number(number));
      },
      "Numbers of distortion in the model's order, e.g. k1,k2,p1,p2 for OPENCV; OPENCV_14 takes 4, "
      "5, 8, 12 or 14");
}

LensChoice DistortionOptions::applied(LensChoice lens) const {
  if (model_.empty()) {
    if (numbers_) throw UsageError("--distortion needs --model, whose numbers they are");
    return lens;
  }
  if (lens.model == ProjectionModel::orthographic) {
    throw UsageError("--model: an orthographic camera has no lens");
  }
  const LensModelEntry model = about_option("--model", [&] { return lens_model_of(model_); });
  const std::vector<double> numbers = numbers_.value_or(std::vector<double>{});
  lens.distortion = about_option("--distortion", [&] { return lens_of_numbers(model, numbers); });
  return lens;
}

void add_range_options(Command& command, LensChoice& lens) {
  command.option("--near", "D", into(lens.near, parse_number),
                 "Nearest depth that is rendered (default 0)");
  command.option("--far", "D", into(lens.far, parse_number_or_infinity),
                 "Farthest depth that is rendered (default inf)");
}

std::vector<Option> CameraChanges::add_to(Command& command) {
  const Option near =
      command.option("--near", "D", into(near_, parse_number),
                     "Nearest depth that is rendered (default: as in the camera file, or 0)");
  const Option far =
      command.option("--far", "D", into(far_, parse_number_or_infinity),
                     "Farthest depth that is rendered (default: as in the camera file, or inf)");
  const Option scale =
      command.option("--scale", "FACTOR", into(scale_, parse_scale),
                     "Scale the image, e.g. 0.5 for half its width and height: the same view, with "
                     "fx, fy, cx, cy and skew scaled exactly");
  return {near, far, scale};
}

std::vector<Camera> CameraChanges::applied(std::vector<Camera> cameras) const {
  for (Camera& camera : cameras) {
    camera.near = near_.value_or(camera.near);
    camera.far = far_.value_or(camera.far);
    if (const auto fault = near_ || far_ ? find_fault(camera) : std::nullopt) {
      throw UsageError(
          fmt::format("--near and --far: {}: from {} to {}", *fault, camera.near, camera.far));
    }
    if (scale_) camera = about_option("--scale", [&] { return scaled(camera, *scale_); });
  }
  return cameras;
}

LensChoice CameraChanges::applied(LensChoice lens) const {
  lens.near = near_.value_or(lens.near);
  lens.far = far_.value_or(lens.far);
  return lens;
}

void CameraOptions::add_to(Command& command) {
  const auto take_file = [this](const std::string& file) {
    file_ = file;
    if (size_->is_given())
      throw UsageError(
          "the camera has a size, so that --size has no place; --scale FACTOR scales it");
  };
  const Option camera = command.option("--camera", "FILE", take_file,
                                       "Camera file (JSON), or a map, which contains its camera "
                                       "(default: a camera that frames the scene)");
  options_ = {camera};
  for (Option& framing : add_view_options(command, view_)) {
    options_.push_back(framing.excludes(camera));
  }
  std::vector<Option> parts = add_lens_options(command, lens_);
  size_ = parts.front();  // refused with another message
  for (std::size_t i = 1; i < parts.size(); ++i) parts[i].excludes(camera);
  options_.insert(options_.end(), parts.begin(), parts.end());
  const std::vector<Option> changes = changes_.add_to(command);
  options_.insert(options_.end(), changes.begin(), changes.end());
}

std::optional<std::string> CameraOptions::given() const {
  const auto found = std::ranges::find_if(options_, [](const Option& o) { return o.is_given(); });
  return found == options_.end() ? std::nullopt : std::optional(found->name());
}

std::vector<Camera> CameraOptions::get(const Scene& scene, const ReadLimits& limits,
                                       const Console& console) const {
  if (from_file()) {
    const std::vector<Camera> given = read_cameras_with_lenses(file_, limits, console);
    std::vector<Camera> cameras = changes_.applied(given);
    warn_of_unequal_scales(given, cameras, console);
    return cameras;
  }
  return changes_.applied({framing_camera(scene, view_, changes_.applied(lens_))});
}

Camera CameraOptions::get_one(const Scene& scene, const ReadLimits& limits, const char* command,
                              const Console& console) const {
  std::vector<Camera> cameras = get(scene, limits, console);
  if (cameras.size() != 1) {
    throw UsageError(fmt::format(
        "--camera: a path of {} cameras; {} takes a single one, as 'fathom camera import … --image "
        "NAME' writes it, or a map that contains its camera",
        cameras.size(), command));
  }
  return cameras.front();
}

namespace {

/// Whether a map is called as a camera: views/a.npy as images/a.jpg, a.jpg.geometric.bin as a.jpg.
bool is_called_as(const std::string& map, const std::string& camera) {
  const std::string file = std::filesystem::path(map).filename().string();
  const std::filesystem::path image = std::filesystem::path(camera).filename();
  return !image.empty() && (std::filesystem::path(file).stem() == image.stem() ||
                            file.starts_with(image.string() + "."));
}

}  // namespace

Camera camera_called_as(const std::string& map, const std::vector<Camera>& cameras) {
  std::vector<const Camera*> found;
  for (const Camera& camera : cameras)
    if (is_called_as(map, camera.name)) found.push_back(&camera);
  if (found.size() == 1) return *found.front();
  throw UsageError(fmt::format(
      "--camera: {}, but {} named like the map '{}'; expected a camera for each map, or maps that "
      "are named like the images",
      text::counted(cameras.size(), "camera"),
      found.empty() ? "none is" : std::to_string(found.size()) + " are", text::printable(map)));
}

std::vector<Camera> cameras_of_maps(const std::vector<std::string>& maps,
                                    const std::vector<Camera>& cameras) {
  if (cameras.size() == maps.size()) return cameras;
  std::vector<Camera> found;
  found.reserve(maps.size());
  for (const std::string& map : maps) found.push_back(camera_called_as(map, cameras));
  return found;
}

void require_size_of(const DepthMap& map, const Camera& camera, const std::string& file) {
  if (camera.width == map.width && camera.height == map.height) return;
  throw InputError(fmt::format("{}: a camera of {}x{} pixels, but the map has {}x{}", file,
                               camera.width, camera.height, map.width, map.height));
}

std::vector<Camera> read_cameras_without_lens(const std::string& file, const Console& console,
                                              std::string_view why) {
  const auto refuse = [&](const std::string&, auto, auto) -> std::shared_ptr<const DirectionTable> {
    throw UsageError("the lens TABLE: " + std::string(why));
  };
  std::vector<Camera> cameras = read_any_cameras(file, refuse, console);
  for (const Camera& camera : cameras) require_straight(camera, why);
  return cameras;
}

std::vector<Camera> read_cameras_with_lenses(const std::string& file, const ReadLimits& limits,
                                             const Console& console) {
  return read_any_cameras(file, limits.directions_beside(file), console);
}

Camera read_camera_with_lens(const std::string& file, const ReadLimits& limits,
                             const Console& console) {
  const std::vector<Camera> cameras = read_cameras_with_lenses(file, limits, console);
  if (cameras.size() == 1) return cameras.front();
  throw InputError(
      fmt::format("{}: a path of {} cameras, expected a single camera", file, cameras.size()));
}

}  // namespace fathom::app
