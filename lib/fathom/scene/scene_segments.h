#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "fathom/mesh/segmentation.h"
#include "fathom/scene/triangle_source.h"

namespace fathom {

/// The segments of a whole scene: what channels `material`, `group`, `part` and `label` have of
/// each triangle (specification, section 6), and the names that these numbers stand for.
///
/// Names are numbered from 0 through all objects in their order, and within a mesh as it lists
/// them: a name has one number, in however many files it stands. Labels are the numbers of their
/// files. Refers to the scene, which must outlive it unchanged. Several threads may ask at the
/// same time.
class SceneSegments {
 public:
  /// The segments of these segmentations.
  /// Fails    InputError if an object names no mesh.
  SceneSegments(const TriangleSource& triangles, const std::vector<Segmentation>& wanted);

  /// The number of the segment that a triangle belongs to, `unsegmented` if it belongs to no
  /// segment or the segmentation was not requested.
  /// Fails    InputError if a file of a StreamedScene has changed or cannot be read any more,
  ///          and where the scene has a fault there (scene_fault.h).
  [[nodiscard]] std::uint32_t number(Segmentation by, const TriangleOrigin& origin) const;
  /// The same of an object as a whole, where it is one segment for itself.
  [[nodiscard]] std::uint32_t number_of_object(Segmentation by, std::size_t object) const;

  /// Whether no triangle can belong to one; of labels of a StreamedScene, false.
  [[nodiscard]] bool is_empty(Segmentation by) const;
  /// names(by)[n] is the name of segment n; empty for labels.
  [[nodiscard]] const std::vector<std::string>& names(Segmentation by) const {
    return of(by).names;
  }

 private:
  /// Where the numbers of an object's triangles are.
  struct OfObject {
    /// The number of all triangles, if the mesh has no numbers for them.
    std::uint32_t number = unsegmented;
    const TriangleSegments* of_mesh = nullptr;
    /// The scene's number for each of the mesh's; empty for labels.
    std::span<const std::uint32_t> in_scene;
  };
  struct OneSegmentation {
    std::vector<OfObject> objects;
    std::vector<std::string> names;
    /// in_scene of the meshes, by their numbers.
    std::unordered_map<std::size_t, std::vector<std::uint32_t>> of_meshes;
  };
  [[nodiscard]] const OneSegmentation& of(Segmentation by) const {
    return segmentations_[static_cast<std::size_t>(by)];
  }
  void add(Segmentation by);

  TriangleSource triangles_;
  std::array<OneSegmentation, all_segmentations.size()> segmentations_;
};

}  // namespace fathom
