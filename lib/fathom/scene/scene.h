#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fathom/files/source.h"
#include "fathom/mesh/mesh.h"
#include "fathom/mesh/object.h"

/// A scene: meshes, the objects that place them, and how a graphics pipeline draws the objects.
namespace fathom {

/// How a fragment's value is compared with the stored value.
/// Source   [GL46] 17.3.3, 17.3.4
enum class Comparison { never, less, equal, less_equal, greater, not_equal, greater_equal, always };

/// What becomes of a stencil value s of 8 bits.
/// Source   [GL46] 17.3.3
enum class StencilAction {
  keep,
  zero,
  replace,         ///< the reference value
  increment,       ///< s + 1, at most 255
  increment_wrap,  ///< s + 1, 0 after 255
  decrement,       ///< s − 1, at least 0
  decrement_wrap,  ///< s − 1, 255 after 0
  invert           ///< every bit
};

/// A fragment passes if (reference & mask) compares as `test` with (s & mask). The bits in
/// `write_mask` of s then change: by `fail` where the fragment does not pass, by `depth_fail` where
/// it fails the depth test, else by `pass`.
struct StencilState {
  Comparison test = Comparison::always;
  std::uint8_t reference = 0, mask = 255, write_mask = 255;
  StencilAction fail = StencilAction::keep, depth_fail = StencilAction::keep,
                pass = StencilAction::keep;
};

/// glPolygonOffset; see depth_format/depth_bias.h.
struct PolygonOffset {
  double factor = 0, units = 0;
};

/// How a graphics pipeline draws an object: the state that OpenGL, Vulkan and Direct3D keep for a
/// draw. Only the pipeline uses it; the exact engines ignore it.
struct DrawState {
  /// A fragment's stored depth compares so with the one in the depth buffer, which is cleared to
  /// the farthest one. None: the strictly nearer wins, and any fragment wins against a cleared one.
  std::optional<Comparison> depth_test;
  bool depth_write = true;
  bool colour_write = true;
  /// Empty: the setting of the whole scene.
  std::optional<PolygonOffset> polygon_offset;
  /// Opacity, 0 to 1: fragments that pass are blended over the picture. None: they replace it.
  std::optional<double> alpha;
  std::optional<StencilState> stencil;
};

/// Whether every setting is the default.
bool is_default(const DrawState& state);

/// The fault of a state that a caller filled in: numbers that are not finite, or an opacity outside
/// [0, 1].
std::optional<std::string> find_fault(const DrawState& state);

/// Everything that is rendered. Callers may fill it in; find_fault() checks whether it is valid.
/// Triangles are numbered from 0 over all objects in order (specification, section 3), at most
/// 2³² − 2 in all.
struct Scene {
  std::vector<Mesh> meshes;
  std::vector<Object> objects;
  std::vector<Source> sources;
  /// How a pipeline draws each object; empty if all objects have the default state.
  std::vector<DrawState> draw_states;
};

/// How a pipeline draws an object.
DrawState draw_state_of(const Scene& scene, std::size_t object);

/// The number of triangles in all objects.
/// Fails    InputError if an object names no mesh, or there are more than can be numbered.
std::uint64_t triangle_count(const Scene& scene);

/// Where triangle `number` of the scene comes from.
struct TriangleOrigin {
  std::uint32_t object = 0;
  /// Its number within its object's mesh.
  std::uint32_t triangle = 0;
  /// The number of its face within its file.
  std::uint32_t face = 0;
};
/// Cost     constructs a TriangleSource; for many triangles construct it once yourself.
/// Fails    std::out_of_range unless `number` is below triangle_count().
TriangleOrigin origin_of(const Scene& scene, std::uint32_t number);

}  // namespace fathom
