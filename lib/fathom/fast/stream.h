#pragma once

#include <cstdint>

#include "fathom/camera/camera.h"
#include "fathom/image/depth_map.h"
#include "fathom/rendering/options.h"
#include "fathom/rendering/rendered.h"
#include "fathom/scene/streamed_scene.h"

namespace fathom {

/// How much is kept in memory at a time. The map does not depend on it.
struct StreamLimits {
  /// Triangles of a file.
  std::uint32_t triangles_at_once = 1U << 19;
  /// The approximate size of a triangle in bytes: twice its corners (the next triangles are read
  /// meanwhile), their images, and its places in tiles.
  static constexpr std::uint32_t bytes_per_triangle = 300;
  /// Memory for the tiles of the image in which surfaces were seen, up to 40 bytes per pixel
  /// (Tile::most_packed_bytes). If they need more, the files are read again for the rest of the
  /// image. At least one row of tiles, 64 rows of pixels, is kept.
  std::uint64_t tile_bytes = std::uint64_t{1} << 30;
  /// For channel A, memory for the triangles that these tiles need, about 200 bytes each. If there
  /// are more, they wait in a file without a name in the folder that TMPDIR names.
  std::uint64_t kept_bytes = std::uint64_t{1} << 30;
};

/// The fast engine on a scene that stays in its files: the map of render_fast() on the same files
/// read by read_scene(), bit for bit.
///
/// Memory   the requested channels, and as much as the limits allow. It does not grow with the
///          number of triangles (but see TriangleStream), except that for channel A all triangles
///          that meet one tile are in memory together.
/// Fails    as render_reference(); UsageError for limits that allow no triangle; InputError if a
///          file changes in the meantime; for channel A, OutputError if there is no disk space for
///          triangles that do not fit into the memory.
Rendered render_streamed(const StreamedScene& scene, const Camera& camera,
                         const RenderOptions& options, const StreamLimits& limits = {},
                         const RenderContext& context = {});

}  // namespace fathom
