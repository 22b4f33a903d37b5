#pragma once

#include <cstdint>

#include "fathom/camera/camera.h"
#include "fathom/depth_format/depth_format.h"
#include "fathom/image/depth_map.h"
#include "fathom/rendering/options.h"
#include "fathom/scene/triangle_source.h"

/// The contents of a depth buffer for a rendered map (specification, section 9, the ideal model).
namespace fathom {

/// The depth format with the camera's near and far.
/// Fails    UsageError if they, or the combination, mean nothing.
DepthFormat depth_format_of(const Camera& camera, Mapping mapping, Storage storage, double c = 1);

struct DepthBufferOptions {
  /// The format, with the camera's near and far.
  DepthFormat format;
  /// Also compute how far the decoded depth is off, and which surface the format lets win.
  bool against_exact = false;
  /// The options of the rendered map; only engine, culling, threads and progress matter.
  RenderOptions render;
  /// For against_exact: which of equal stored depths wins.
  EqualDepths equal_depths = EqualDepths::first_wins;
};

/// How many stored depths were settled by which arithmetic, and what was found.
struct DepthBufferStatistics {
  std::uint64_t by_binary64 = 0, by_double_words = 0, by_exact_numbers = 0;
  /// Pixels where the format lets another surface win than the visible one.
  std::uint64_t fighting = 0;
};

/// Adds channels to a map. The value after the last semicolon is the value of pixels without a
/// surface.
///
///   Zwindow    the stored depth. unorm: UINT, the code. float16, float32: FLOAT, the value. A
///              float64 does not fit into a channel: UINT `Zwindow.high` and `Zwindow.low`, the
///              halves of its bits. Background: the clear value, i.e. the value of the farthest
///              depth.
///   Zdecoded   FLOAT: the depth that the stored value means, in scene units, rounded once; +∞.
/// against_exact:
///   Zerror     FLOAT: that depth minus the exact one, rounded once; 0.
///   Zwinner    UINT: number of the triangle that wins if the nearer stored depth wins and
///              triangles are drawn in the order of their numbers; of equal stored depths,
///              `equal_depths` says which wins; 4294967295.
///   Zfight     UINT: 1 where that is not the visible triangle, else 0; 0.
///
/// Exact    each value follows from the exact depth of the visible triangle and is rounded once.
///          Both engines give the same bits; the reference uses exact numbers alone.
/// Fails    UsageError for a format that means nothing or a map without `id`; InputError if map,
///          scene or camera has a fault (find_fault), or the map is of another size or scene.
/// Needs    depths of visible surfaces between the format's near and far,
///          which they are if these are the camera's.
DepthBufferStatistics add_depth_buffer(DepthMap& map, const TriangleSource& triangles,
                                       const Camera& camera, const DepthBufferOptions& options);

}  // namespace fathom
