#pragma once

#include <optional>
#include <vector>

#include "fathom/gltf/gltf_placement.h"
#include "fathom/mesh_files/gltf/gltf_accessor.h"
#include "fathom/text/json_value.h"

/// The places where a node shows its mesh, of the extension EXT_mesh_gpu_instancing. For this
/// room's .cpp files only.
/// Source   [EMGI19]
namespace fathom::mesh_files {

class GltfInstances {
 public:
  /// Nothing if the node has no such extension. No number has been read yet.
  /// Fails    InputError: attributes of other types, or of different lengths.
  static std::optional<GltfInstances> of(const text::JsonValue& node, GltfAccessors& accessors);

  [[nodiscard]] std::uint64_t count() const { return count_; }
  /// Each instance's transform is NODE·transform_of(placement). The parts of a quaternion that are
  /// stored as integers are rounded once.
  /// Fails    InputError: a number that is not finite.
  [[nodiscard]] std::vector<gltf::GltfPlacement> placements() const;

 private:
  std::shared_ptr<const GltfAccessor> translation_, rotation_, scale_;
  std::uint64_t count_ = 0;
};

}  // namespace fathom::mesh_files
