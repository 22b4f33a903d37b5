#include "fathom/area/area_items.h"

#include <map>
#include <utility>

#include "fathom/mesh/segmentation.h"
#include "fathom/scene/scene_segments.h"

namespace fathom {
namespace {

AreaItems triangles_of(const Scene& scene, const TriangleSource& triangles) {
  AreaItems result;
  for (std::uint32_t number = 0; number < triangles.count(); ++number) {
    const TriangleOrigin origin = triangles.origin(number);
    result.items.push_back({number, scene.objects[origin.object].name, origin.object, origin.face});
  }
  return result;
}

AreaItems objects_of(const Scene& scene, const TriangleSource& triangles) {
  AreaItems result;
  for (std::size_t object = 0; object < scene.objects.size(); ++object) {
    result.items.push_back({object, scene.objects[object].name, {}, {}});
  }
  for (std::uint32_t number = 0; number < triangles.count(); ++number) {
    result.of_triangle.push_back(triangles.origin(number).object);
  }
  return result;
}

AreaItems faces_of(const Scene& scene, const TriangleSource& triangles) {
  AreaItems result;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known;
  for (std::uint32_t number = 0; number < triangles.count(); ++number) {
    const TriangleOrigin origin = triangles.origin(number);
    const auto next = static_cast<std::uint32_t>(result.items.size());
    const auto [face, is_new] = known.emplace(std::pair(origin.object, origin.face), next);
    if (is_new) {
      result.items.push_back(
          {origin.face, scene.objects[origin.object].name, origin.object, origin.face});
    }
    result.of_triangle.push_back(face->second);
  }
  return result;
}

AreaItems segments_of(const TriangleSource& triangles, Segmentation by) {
  AreaItems result;
  const SceneSegments segments(triangles, {by});
  std::map<std::uint32_t, std::uint32_t> known;
  for (std::uint32_t number = 0; number < triangles.count(); ++number) {
    const std::uint32_t segment = segments.number(by, triangles.origin(number));
    if (segment == unsegmented) {
      result.of_triangle.push_back(AreaOptions::no_group);
      continue;
    }
    const auto next = static_cast<std::uint32_t>(result.items.size());
    const auto [item, is_new] = known.emplace(segment, next);
    if (is_new) {
      const auto& names = segments.names(by);
      result.items.push_back({segment, names.empty() ? std::string() : names[segment], {}, {}});
    }
    result.of_triangle.push_back(item->second);
  }
  return result;
}

}  // namespace

const char* name_of(AreaItemKind kind) {
  switch (kind) {
    case AreaItemKind::object:
      return "object";
    case AreaItemKind::face:
      return "face";
    case AreaItemKind::triangle:
      return "triangle";
    case AreaItemKind::material:
      return "material";
    case AreaItemKind::group:
      return "group";
    case AreaItemKind::part:
      return "part";
    case AreaItemKind::label:
      break;
  }
  return "label";
}

AreaItems area_items(const Scene& scene, AreaItemKind kind) {
  const TriangleSource triangles(scene);
  switch (kind) {
    case AreaItemKind::object:
      return objects_of(scene, triangles);
    case AreaItemKind::face:
      return faces_of(scene, triangles);
    case AreaItemKind::triangle:
      return triangles_of(scene, triangles);
    case AreaItemKind::material:
      return segments_of(triangles, Segmentation::material);
    case AreaItemKind::group:
      return segments_of(triangles, Segmentation::group);
    case AreaItemKind::part:
      return segments_of(triangles, Segmentation::part);
    case AreaItemKind::label:
      break;
  }
  return segments_of(triangles, Segmentation::label);
}

AreaOptions options_of(const AreaItems& items) {
  AreaOptions options;
  options.groups = items.of_triangle;
  options.group_count = static_cast<std::uint32_t>(items.items.size());
  return options;
}

}  // namespace fathom
