#pragma once

#include <cstdint>
#include <optional>

#include "fathom/camera/camera.h"
#include "fathom/scene/streamed_scene.h"
#include "validation/scenes/shapes.h"

/// Scenes of any number of triangles, which are made as they are drawn (generated_stream.h).
namespace fathom::bench {

enum class GeneratedKind { terrain, soup };

/// The name by which programs know it.
const char* name_of(GeneratedKind kind);

/// What is asked of a scene that is generated.
struct GeneratedArguments {
  GeneratedKind kind = GeneratedKind::terrain;
  /// At most 2³² − 2.
  std::uint32_t triangles = 1'000'000;
  /// Only for the soup: the edge of the cubes that contain its triangles. The default,
  /// 2 / √triangles, makes soups of any size cover about the same part of the image.
  std::optional<double> edge;
};

/// A scene of one object. Its source is called "generated:terrain:1000000".
/// Fails    UsageError where the edge is not above 0, or above 1; InputError for too many
///          triangles.
StreamedScene generated_scene(const GeneratedArguments& arguments);

/// A camera that looks obliquely down on such a scene, which fills its image: about half of the
/// triangles are outside of it.
Camera camera_of(GeneratedKind kind, const ImageSize& size);

}  // namespace fathom::bench
