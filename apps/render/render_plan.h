#pragma once

#include <cstddef>
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
  /// Whether the file is the mask of the map.
  bool is_mask = false;
  /// The mask is that of one object.
  std::optional<std::uint32_t> object;
  /// Whether nobody asked for channels, so that they are those that suit the camera.
  bool channels_by_default = false;
  std::vector<MatteKind> mattes;
  std::optional<SamplePattern> samples;
  std::optional<DepthBufferPlan> depth_buffer;
  std::optional<std::uint64_t> verified_pixels;

  /// `rendering`, with the default channels of a camera: with a lens, Z without A, and also the ray
  /// distance where its rays need not all go forwards.
  [[nodiscard]] RenderOptions rendering_for(const Camera& camera) const;
  /// Whether the normals of files are interpolated.
  [[nodiscard]] bool needs_normals() const;
  /// Whether the map shows what triangles are called.
  [[nodiscard]] bool needs_segments() const;
};

/// One of the files of each camera: which -o it is, and its plan as if it were the only one.
struct OutputPlan {
  std::size_t number = 0;
  MapPlan plan;
};

/// A rendering of each camera, and the files that are written from it. The plan's channels are
/// those of all its outputs.
struct RenderPass {
  MapPlan plan;
  std::vector<OutputPlan> outputs;

  /// The plan's `rendering`, with the channels that each output has of this camera.
  [[nodiscard]] RenderOptions rendering_for(const Camera& camera) const;
};

/// The file of a map, or of its mask; `name` is its name for messages.
/// Fails    as encode_map().
std::vector<std::byte> encode_planned(const DepthMap& map, const MapPlan& plan,
                                      const std::string& name);

/// How deep maps are made.
struct DeepMapPlan {
  Compression compression = Compression::zips;
  RenderOptions rendering;
};

/// All fail with UsageError where the arguments contradict each other, before any work.
MapPlan plan_maps(const RenderArguments& arguments);
/// All outputs, in as few passes as can be: depths of different types (binary32, binary64, codes)
/// are rounded once each, so each type takes a pass of its own.
std::vector<RenderPass> plan_passes(const RenderArguments& arguments);
DeepMapPlan plan_deep_maps(const RenderArguments& arguments);

}  // namespace fathom::app
