#pragma once

#include <cstdint>
#include <optional>

#include "apps/render/render_arguments.h"
#include "fathom/rendering/options.h"

namespace fathom::app {

/// The channels of a depth buffer that are added to a map.
struct DepthBufferPlan {
  Mapping mapping = Mapping::standard;
  Storage storage = Storage::float32;
  double c = 1;
  bool against_exact = false;
  /// Only the depth buffer needs channel id: it is not written.
  bool drops_id = false;

  /// How many channels it adds, at most.
  [[nodiscard]] std::size_t most_channels() const { return against_exact ? 6 : 3; }
};

/// The depth format with the camera's near and far. Fails with UsageError where they do not fit it.
DepthFormat format_for(const DepthBufferPlan& plan, const Camera& camera);

/// How an exact engine makes maps: the combined meaning of the arguments.
struct MapPlan {
  MapFormat format = MapFormat::exr;
  WriteOptions writing;
  StorageOptions storage;
  RenderOptions rendering;
  std::vector<MatteKind> mattes;
  std::optional<SamplePattern> samples;
  std::optional<DepthBufferPlan> depth_buffer;
  std::optional<std::uint64_t> verified_pixels;

  /// Whether the normals of files are interpolated.
  [[nodiscard]] bool needs_normals() const;
  /// Whether the map shows what triangles are called.
  [[nodiscard]] bool needs_segments() const;
};

/// How deep maps are made.
struct DeepMapPlan {
  Compression compression = Compression::zips;
  RenderOptions rendering;
};

/// Both fail with UsageError where the arguments contradict each other, before any work.
MapPlan plan_maps(const RenderArguments& arguments);
DeepMapPlan plan_deep_maps(const RenderArguments& arguments);

}  // namespace fathom::app
