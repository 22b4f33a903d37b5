#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <set>

#include "apps/maps/info.h"
#include "apps/shell/standard_streams.h"
#include "fathom/rendering/segment_channels.h"
#include "fathom/scene/bounds.h"
#include "fathom/scene/scene_segments.h"
#include "fathom/text/counted.h"
#include "fathom/text/printable.h"

namespace fathom::app {
namespace {

using Json = nlohmann::ordered_json;

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

constexpr std::array named_segmentations{Segmentation::material, Segmentation::group,
                                         Segmentation::part};

/// "materials"
std::string plural_of(Segmentation by) {
  return std::string(description_of(channel_of(by)).name) + "s";
}

/// The labels that triangles of the scene carry.
std::set<std::uint32_t> labels_of(const Scene& scene) {
  std::set<std::uint32_t> labels;
  for (const Object& object : scene.objects) {
    const TriangleSegments* const of_mesh =
        scene.meshes[object.mesh].segments_by(Segmentation::label);
    if (object.segments && object.segments->label) {
      labels.insert(*object.segments->label);
    } else if (of_mesh) {
      labels.insert(of_mesh->numbers.begin(), of_mesh->numbers.end());
    }
  }
  labels.erase(unsegmented);
  return labels;
}

/// What triangles are called, where they are called anything.
void describe_segments(const Scene& scene, Json& answer) {
  const SceneSegments segments(scene, {named_segmentations.begin(), named_segmentations.end()});
  for (const Segmentation by : named_segmentations)
    if (!segments.names(by).empty()) answer[plural_of(by)] = segments.names(by);
  if (const auto labels = labels_of(scene); !labels.empty()) answer["labels"] = labels;
}

std::string describe_segments_as_text(const Scene& scene) {
  const SceneSegments segments(scene, {named_segmentations.begin(), named_segmentations.end()});
  std::string text;
  for (const Segmentation by : named_segmentations)
    text += name_line(plural_of(by), segments.names(by));
  std::vector<std::string> numbers;
  for (const std::uint32_t label : labels_of(scene)) numbers.push_back(std::to_string(label));
  return text + name_line("labels", numbers);
}

/// Whether a mesh file holds vertices and nothing that uses them.
bool is_point_cloud(const Scene& scene, FileKind kind) {
  const auto is_cloud = [](const Mesh& mesh) { return mesh.is_empty() && !mesh.vertices.empty(); };
  return kind != FileKind::scene && !scene.meshes.empty() &&
         std::ranges::all_of(scene.meshes, is_cloud);
}

/// Makes every vertex a point, so that it counts.
void use_all_vertices(Scene& scene) {
  for (Mesh& mesh : scene.meshes) {
    mesh.points.resize(mesh.vertices.size());
    std::iota(mesh.points.begin(), mesh.points.end(), 0U);
  }
}

Json describe(const Scene& scene, const char* kind, const std::string& file) {
  const SceneTotals totals = totals_of(scene);
  Json answer{{"kind", kind},
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
  describe_segments(scene, answer);
  Json sources = Json::array();
  for (const Source& source : scene.sources) {
    sources.push_back({{"path", source.path}, {"sha256", source.sha256}});
    if (!source.reader.empty()) sources.back()["reader"] = source.reader;
  }
  answer["sources"] = std::move(sources);
  return answer;
}

std::string to_text(const std::optional<WorldBounds>& bounds) {
  if (!bounds) return "none";
  return fmt::format("({}, {}, {}) to ({}, {}, {})", bounds->lower[0], bounds->lower[1],
                     bounds->lower[2], bounds->upper[0], bounds->upper[1], bounds->upper[2]);
}

std::string describe_as_text(const Scene& scene, const char* kind, bool lists_objects,
                             const std::string& file) {
  const SceneTotals totals = totals_of(scene);
  std::string text =
      fmt::format("{}: a {}\n  vertices   {}\n  faces      {}\n  triangles  {}\n  bounds     {}\n",
                  text::printable(file), kind, totals.vertices, totals.faces, totals.triangles,
                  to_text(world_bounds(scene)));
  if (lists_objects) {
    for (const Object& object : scene.objects) {
      text += fmt::format("  object     {}: {}, {}\n", text::printable(object.name),
                          text::counted(scene.meshes[object.mesh].triangles.size(), "triangle"),
                          to_text(bounds_of(scene, object)));
    }
  }
  text += describe_segments_as_text(scene);
  for (const Source& source : scene.sources) {
    text +=
        fmt::format("  source     {} (SHA-256 {}){}\n", text::printable(source.path), source.sha256,
                    source.reader.empty() ? "" : ", read by " + text::printable(source.reader));
  }
  return text;
}

}  // namespace

std::string info_of_scene(Scene scene, FileKind kind, const std::string& file, AnswerForm form) {
  const bool is_cloud = is_point_cloud(scene, kind);
  if (is_cloud) use_all_vertices(scene);
  const char* const name = is_cloud ? "point cloud" : kind == FileKind::scene ? "scene" : "mesh";
  if (form == AnswerForm::json) return json_answer(describe(scene, name, file));
  const bool lists_objects = scene.objects.size() > 1 || kind == FileKind::scene;
  return describe_as_text(scene, name, lists_objects, file);
}

}  // namespace fathom::app
