// fathom info FILE

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/maps/info_map.h"
#include "apps/maps/map_view.h"
#include "apps/options/scene_options.h"
#include "apps/shell/output_file.h"
#include "apps/shell/program.h"
#include "fathom/camera/camera_files.h"
#include "fathom/image/map_files.h"
#include "fathom/numeric/errors.h"
#include "fathom/numeric/rounding.h"
#include "fathom/scene/bounds.h"
#include "fathom/scene/framing.h"
#include "fathom/scene/read_scene.h"

namespace fathom::app {
namespace {

using Json = nlohmann::ordered_json;

struct InfoArguments {
  std::string file, mesh_format;
  bool json = false;
};

enum class Kind { mesh, scene, camera, map };

/// Told by the content. JSON with `meshes` is a scene file unless it is glTF, which has `asset`.
Kind kind_of(const std::string& file) {
  if (file == "-") return Kind::mesh;
  std::ifstream stream(file, std::ios::binary);
  std::string start(16, '\0');
  stream.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
  if (start.starts_with("\x76\x2f\x31\x01") || start.starts_with("\x89PNG") ||
      start.starts_with("\x93NUMPY") || start.starts_with("Pf") || start.starts_with("PF")) {
    return Kind::map;
  }
  const std::size_t first = start.find_first_not_of(" \t\r\n");
  if (first == std::string::npos || (start[first] != '{' && start[first] != '[')) return Kind::mesh;
  if (start[first] == '[') return Kind::camera;
  stream.clear();
  stream.seekg(0);
  const Json json = Json::parse(stream, nullptr, false);
  if (json.is_object() && json.contains("asset")) return Kind::mesh;
  if (json.is_object() && json.contains("meshes")) return Kind::scene;
  return Kind::camera;
}

Json to_json(const std::optional<WorldBounds>& bounds) {
  return bounds ? Json{bounds->lower, bounds->upper} : Json(nullptr);
}

/// The part of a scene that one of its objects is, to ask for its bounds.
std::optional<WorldBounds> bounds_of(const Scene& scene, const Object& object) {
  Scene part;
  part.meshes.push_back(scene.meshes[object.mesh]);
  part.objects.push_back(object);
  part.objects[0].mesh = 0;
  return world_bounds(part);
}

struct SceneTotals {
  std::uint64_t vertices = 0, faces = 0, triangles = 0;
};

SceneTotals totals_of(const Scene& scene) {
  SceneTotals totals;
  for (const Mesh& mesh : scene.meshes) {
    totals.vertices += mesh.vertices.size();
    totals.faces += mesh.face_count;
  }
  totals.triangles = triangle_count(scene);
  return totals;
}

Json describe(const Scene& scene, Kind kind, const std::string& file) {
  const SceneTotals totals = totals_of(scene);
  Json answer{{"kind", kind == Kind::scene ? "scene" : "mesh"},
              {"file", file},
              {"vertices", totals.vertices},
              {"faces", totals.faces},
              {"triangles", totals.triangles},
              {"bounds", to_json(world_bounds(scene))}};
  Json objects = Json::array();
  for (const Object& object : scene.objects) {
    const Mesh& mesh = scene.meshes[object.mesh];
    objects.push_back({{"name", object.name},
                       {"vertices", mesh.vertices.size()},
                       {"triangles", mesh.triangles.size()},
                       {"bounds", to_json(bounds_of(scene, object))}});
  }
  answer["objects"] = std::move(objects);
  Json sources = Json::array();
  for (const Source& source : scene.sources) {
    sources.push_back({{"path", source.path}, {"sha256", source.sha256}});
  }
  answer["sources"] = std::move(sources);
  return answer;
}

std::string to_text(const std::optional<WorldBounds>& bounds) {
  if (!bounds) return "none";
  return fmt::format("({}, {}, {}) to ({}, {}, {})", bounds->lower[0], bounds->lower[1],
                     bounds->lower[2], bounds->upper[0], bounds->upper[1], bounds->upper[2]);
}

std::string describe_as_text(const Scene& scene, Kind kind, const std::string& file) {
  const SceneTotals totals = totals_of(scene);
  std::string text =
      fmt::format("{}: a {}\n  vertices   {}\n  faces      {}\n  triangles  {}\n  bounds     {}\n",
                  file, kind == Kind::scene ? "scene" : "mesh", totals.vertices, totals.faces,
                  totals.triangles, to_text(world_bounds(scene)));
  if (scene.objects.size() > 1 || kind == Kind::scene) {
    for (const Object& object : scene.objects) {
      text += fmt::format("  object     {}: {} triangles, {}\n", object.name,
                          scene.meshes[object.mesh].triangles.size(),
                          to_text(bounds_of(scene, object)));
    }
  }
  for (const Source& source : scene.sources) {
    text += fmt::format("  source     {} (SHA-256 {})\n", source.path, source.sha256);
  }
  return text;
}

/// The eye and the line of sight in the world, rounded from the exact inverse.
struct Pose {
  std::array<double, 3> eye{}, forward{};
};

Pose pose_of(const Camera& camera) {
  const auto world_from_camera = camera_to_world(view_of(camera));
  Pose pose;
  for (int i = 0; i < 3; ++i) {
    pose.eye[i] = world_from_camera[i][3];
    pose.forward[i] = world_from_camera[i][2];
  }
  return pose;
}

double degrees_of(double extent, double focal) {
  return 2 * std::atan(extent / (2 * std::abs(focal))) * 180 / std::acos(-1.0);
}

Json describe(const Camera& camera) {
  Json answer = Json::parse(fathom::to_json(camera));
  const Pose pose = pose_of(camera);
  answer["eye"] = pose.eye;
  answer["forward"] = pose.forward;
  if (camera.projection == Projection::perspective) {
    answer["fov_degrees"] = {degrees_of(camera.width, camera.fx),
                             degrees_of(camera.height, camera.fy)};
  }
  return answer;
}

std::string describe_as_text(const Camera& camera) {
  const Pose pose = pose_of(camera);
  const bool perspective = camera.projection == Projection::perspective;
  std::string text = fmt::format(
      "  {} camera of {}x{} pixels\n"
      "    fx, fy        {}, {}\n    cx, cy        {}, {}   (the centre of the top left pixel is "
      "{})\n"
      "    skew          {}\n",
      perspective ? "perspective" : "orthographic", camera.width, camera.height, camera.fx,
      camera.fy, camera.cx, camera.cy, camera.pixel_centre, camera.skew);
  if (perspective) {
    text += fmt::format("    field of view {:.4f} x {:.4f} degrees\n",
                        degrees_of(camera.width, camera.fx), degrees_of(camera.height, camera.fy));
  }
  const auto vector = [](const std::array<double, 3>& v) {
    return fmt::format("({}, {}, {})", v[0], v[1], v[2]);
  };
  return text +
         fmt::format("    eye           {}\n    looks along   {}\n    near, far     {}, {}\n",
                     vector(pose.eye), vector(pose.forward), camera.near, camera.far);
}

std::string info_of_cameras(const std::string& file, bool json) {
  const std::vector<Camera> cameras = read_cameras(file);
  if (json) {
    Json list = Json::array();
    for (const Camera& camera : cameras) list.push_back(describe(camera));
    return Json{{"kind", "camera"}, {"file", file}, {"cameras", list}}.dump(2) + "\n";
  }
  std::string text = fmt::format(
      "{}: {}\n", file,
      cameras.size() == 1 ? "a camera" : fmt::format("a path of {} cameras", cameras.size()));
  for (const Camera& camera : cameras) text += describe_as_text(camera);
  return text;
}

std::string dump(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

int run_info(const InfoArguments& arguments, const Console& console) {
  const Kind kind = arguments.mesh_format.empty() ? kind_of(arguments.file) : Kind::mesh;
  if (kind == Kind::camera) {
    print(info_of_cameras(arguments.file, arguments.json));
  } else if (kind == Kind::map) {
    const DepthMap map = read_map(arguments.file);
    Json json{{"file", arguments.file}};
    if (arguments.json) json.update(app::describe(map));
    print(arguments.json ? dump(json) : app::describe_as_text(map, arguments.file));
  } else {
    SceneOptions options;
    options.files = {arguments.file};
    options.mesh_format = arguments.mesh_format;
    const Scene scene = options.read(console, true);
    print(arguments.json ? dump(describe(scene, kind, arguments.file))
                         : describe_as_text(scene, kind, arguments.file));
  }
  return done;
}

}  // namespace

void add_info(Program& program) {
  const auto arguments = std::make_shared<InfoArguments>();
  CLI::App* command = program.add_command("info", "Describe a mesh, scene, camera or map",
                                          "  fathom info data/meshes/spot.obj\n"
                                          "  fathom info spot.exr --json");
  command->add_option("FILE", arguments->file, "A mesh, scene, camera or map")->required();
  command->add_option("--mesh-format", arguments->mesh_format,
                      "Take FILE for a mesh: obj, ply, stl, off, gltf or glb");
  command->add_flag("--json", arguments->json, "Answer in JSON");
  command->callback([arguments, &program] {
    program.run = [arguments, &program] { return run_info(*arguments, program.console); };
  });
}

}  // namespace fathom::app
