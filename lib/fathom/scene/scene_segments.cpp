#include "fathom/scene/scene_segments.h"

#include <algorithm>
#include <string_view>

#include "fathom/failures/errors.h"

namespace fathom {
namespace {

/// Numbers names in the order of their first requests. The requested names must stay in place.
class NameNumbers {
 public:
  explicit NameNumbers(std::vector<std::string>& names) : names_(names) {}

  std::uint32_t operator()(const std::string& name) {
    const auto [known, is_new] =
        numbers_.try_emplace(name, static_cast<std::uint32_t>(names_.size()));
    if (is_new) names_.push_back(name);
    return known->second;
  }

 private:
  std::vector<std::string>& names_;
  std::unordered_map<std::string_view, std::uint32_t> numbers_;
};

/// The segment that an object sets for all its triangles.
const std::string* name_of_all(const Object& object, Segmentation by) {
  if (!object.segments) return nullptr;
  const auto found = object.segments->names.find(by);
  return found == object.segments->names.end() ? nullptr : &found->second;
}

std::uint32_t label_of_all(const Object& object) {
  return object.segments ? object.segments->label.value_or(unsegmented) : unsegmented;
}

const TriangleSegments* of_mesh(const TriangleSource& triangles, std::size_t mesh,
                                Segmentation by) {
  const Scene* scene = triangles.scene();
  return scene ? scene->meshes[mesh].segments_by(by) : nullptr;
}

[[noreturn]] void fail_beyond() {
  throw InputError("scene: a mesh has not a segment for each triangle, or one without a name");
}

}  // namespace

SceneSegments::SceneSegments(const TriangleSource& triangles,
                             const std::vector<Segmentation>& wanted)
    : triangles_(triangles) {
  for (const Segmentation by : wanted) add(by);
}

void SceneSegments::add(Segmentation by) {
  OneSegmentation& result = segmentations_[static_cast<std::size_t>(by)];
  if (!result.objects.empty()) return;
  NameNumbers number_of(result.names);
  for (const Object& object : triangles_.objects()) {
    OfObject of_object;
    if (by == Segmentation::label) {
      of_object.number = label_of_all(object);
      if (of_object.number == unsegmented) of_object.of_mesh = of_mesh(triangles_, object.mesh, by);
    } else if (const std::string* name = name_of_all(object, by)) {
      of_object.number = number_of(*name);
    } else if (const TriangleSegments* segments = of_mesh(triangles_, object.mesh, by)) {
      const auto [known, is_new] = result.of_meshes.try_emplace(object.mesh);
      if (is_new)
        for (const std::string& each : segments->names) known->second.push_back(number_of(each));
      of_object.of_mesh = segments;
      of_object.in_scene = known->second;
    }
    result.objects.push_back(of_object);
  }
}

std::uint32_t SceneSegments::number(Segmentation by, const TriangleOrigin& origin) const {
  const OneSegmentation& segmentation = of(by);
  if (segmentation.objects.empty()) return unsegmented;
  const OfObject& object = segmentation.objects.at(origin.object);
  if (object.number != unsegmented) return object.number;
  if (by == Segmentation::label && triangles_.streamed_scene()) return triangles_.label(origin);
  if (!object.of_mesh || object.of_mesh->numbers.empty()) return unsegmented;
  if (object.of_mesh->numbers.size() != 1 && origin.triangle >= object.of_mesh->numbers.size())
    fail_beyond();
  const std::uint32_t number = object.of_mesh->of(origin.triangle);
  if (number == unsegmented || by == Segmentation::label) return number;
  if (number >= object.in_scene.size()) fail_beyond();
  return object.in_scene[number];
}

std::uint32_t SceneSegments::number_of_object(Segmentation by, std::size_t object) const {
  const OneSegmentation& segmentation = of(by);
  if (segmentation.objects.empty()) return unsegmented;
  const OfObject& of_object = segmentation.objects.at(object);
  if (of_object.number != unsegmented || !of_object.of_mesh) return of_object.number;
  if (of_object.of_mesh->numbers.size() != 1) return unsegmented;
  return number(by, {static_cast<std::uint32_t>(object), 0, 0});
}

bool SceneSegments::is_empty(Segmentation by) const {
  if (by != Segmentation::label) return names(by).empty();
  return !triangles_.streamed_scene() &&
         std::ranges::none_of(of(by).objects, [](const OfObject& object) {
           return object.of_mesh || object.number != unsegmented;
         });
}

}  // namespace fathom
