#include "validation/blender/blender_renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "fathom/attribution/model/named_models.h"
#include "fathom/failures/errors.h"
#include "fathom/image/map_files.h"
#include "validation/blender/blender_camera.h"
#include "validation/blender/blender_script.h"
#include "validation/blender/workplace.h"
#include "validation/child/run_command.h"

namespace fathom::validation {
namespace {

using attribution::model_named;
using attribution::other_map;
using attribution::RayModel;
using attribution::WorldMesh;

std::string version() {
  const Said answer = run_command({"blender", "--version"});
  if (answer.status == 127) {
    throw InputError("blender is not installed: the package blender provides it");
  }
  return answer.text.substr(0, answer.text.find('\n'));
}

/// The translation that makes `shift` the origin of the world.
Camera moved(Camera camera, const std::array<double, 3>& shift) {
  for (auto& row : camera.world_to_camera) {
    for (std::size_t k = 0; k < 3; ++k) row[3] += row[k] * shift[k];
  }
  return camera;
}

std::array<double, 3> middle_of(const WorldMesh& mesh) {
  std::array<double, 3> middle{};
  const auto box = box_of(mesh);
  if (!box) return middle;
  for (std::size_t k = 0; k < 3; ++k) {
    const double least = box->lower[k], greatest = box->upper[k];
    // Only what binary32 would hurt is moved.
    const double size = greatest - least, away = std::max(std::abs(least), std::abs(greatest));
    if (away > 16 * size) middle[k] = static_cast<float>(least / 2 + greatest / 2);
  }
  return middle;
}

std::string scene_json(const Camera& camera, const BlenderCamera& b) {
  std::string rows;
  for (std::size_t r = 0; r < 4; ++r) {
    const auto& m = b.world_from_camera;
    rows += fmt::format("{}[{:.17g}, {:.17g}, {:.17g}, {:.17g}]", r == 0 ? "" : ", ", m[4 * r],
                        m[4 * r + 1], m[4 * r + 2], m[4 * r + 3]);
  }
  return fmt::format(
      R"({{"camera": {{"perspective": {}, "lens": {:.17g}, "ortho_scale": {:.17g}, "shift_x": {:.17g}, "shift_y": {:.17g},
 "aspect_x": {:.17g}, "aspect_y": {:.17g}, "near": {:.17g}, "far": {:.17g}, "width": {}, "height": {},
 "world_from_camera": [{}]}}}})",
      b.perspective ? "true" : "false", b.lens, b.ortho_scale, b.shift_x, b.shift_y, b.aspect_x,
      b.aspect_y, camera.near, camera.far, camera.width, camera.height, rows);
}

void hand_over(const Workplace& place, const WorldMesh& mesh, const std::array<double, 3>& shift,
               const Camera& camera) {
  std::vector<float> points;
  for (const auto& p : mesh.points) {
    for (std::size_t k = 0; k < 3; ++k) points.push_back(static_cast<float>(p[k] - shift[k]));
  }
  place.write("points.bin", points);
  std::vector<std::int32_t> corners;
  for (const CornerIndices& t : mesh.triangles) {
    for (const std::uint32_t corner : t) corners.push_back(static_cast<std::int32_t>(corner));
  }
  place.write("triangles.bin", corners);
  const Camera here = moved(camera, shift);
  place.write("scene.json", scene_json(here, blender_camera(here)));
  place.write("render.py", std::string(blender_script));
}

/// The last line that Blender wrote about an error.
std::string complaint(const std::string& text) {
  std::string found = "it wrote no map";
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    if (line.find("Error") != std::string::npos) found = line;
    begin = end + 1;
  }
  return found;
}

}  // namespace

DrawnMap draw_blender(const WorldMesh& mesh, const Camera& camera) {
  DrawnMap drawn{.version = version()};
  const Workplace place;
  drawn.model = model_named("cycles");
  drawn.model.name = "Cycles";
  // ½/1024 of the filter's width, and as much for its table's roundings
  drawn.model.sample.error = 1e-5;
  auto& model = std::get<RayModel>(drawn.model.kind);
  model.shift = middle_of(mesh);
  hand_over(place, mesh, model.shift, camera);
  // Whoever ends this process ends Blender with it.
  const Said answer = run_command({"setpriv", "--pdeathsig", "KILL", "blender", "-b",
                                   "--factory-startup", "-noaudio", "--python-exit-code", "1",
                                   "--python", (place / "render.py").string()});
  if (answer.status > 128) {
    throw InputError(fmt::format("blender: ended by signal {}", answer.status - 128));
  }
  std::error_code error;
  if (answer.status != 0 || !std::filesystem::exists(place / "depth.exr", error)) {
    throw InputError("blender: failed: " + complaint(answer.text));
  }
  drawn.map = other_map(read_map(place / "depth.exr"), "ViewLayer.Depth.Z");
  return drawn;
}

}  // namespace fathom::validation
