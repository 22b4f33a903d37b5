#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/render/render_arguments.h"
#include "fathom/camera/camera.h"
#include "fathom/fast/stream.h"
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
  /// The object whose mask it is, if it is the mask of one object.
  std::optional<std::uint32_t> object;
  /// Whether no channels were requested, so that the channels depend on the camera.
  bool channels_by_default = false;
  std::vector<MatteKind> mattes;
  std::optional<SamplePattern> samples;
  std::optional<DepthBufferPlan> depth_buffer;
  std::optional<std::uint64_t> verified_pixels;

  /// `rendering`, with the default channels of a camera. A camera with a lens has Z without A, and
  /// also the ray distance if some of its rays may not go forwards.
  [[nodiscard]] RenderOptions rendering_for(const Camera& camera) const;
  /// Whether the normals of files are interpolated.
  [[nodiscard]] bool needs_normals() const;
  /// Whether the map shows materials, groups, parts or labels.
  [[nodiscard]] bool needs_segments() const;
};

/// One of the files of each camera: the number of its -o, and its plan as if it were the only file.
struct OutputPlan {
  std::size_t number = 0;
  MapPlan plan;
};

/// A rendering of each camera, and the files that are written from it. The plan has the channels of
/// all its outputs.
struct RenderPass {
  MapPlan plan;
  std::vector<OutputPlan> outputs;

  /// The plan's `rendering`, with the channels that each output has of this camera.
  [[nodiscard]] RenderOptions rendering_for(const Camera& camera) const;
};

/// The bytes of a map's file, or of its mask's file; `name` is its name for messages.
/// Fails    as encode_map().
std::vector<std::byte> encode_planned(const DepthMap& map, const MapPlan& plan,
                                      const std::string& name);

/// How to make deep maps.
struct DeepMapPlan {
  Compression compression = Compression::zips;
  RenderOptions rendering;
};

/// All fail with UsageError if the arguments contradict each other, before any work.
MapPlan plan_maps(const RenderArguments& arguments);
/// All outputs, in as few passes as possible. Depths of different types (binary32, binary64, codes)
/// are each rounded once, so each type needs a separate pass.
std::vector<RenderPass> plan_passes(const RenderArguments& arguments);
DeepMapPlan plan_deep_maps(const RenderArguments& arguments);

/// Refuses cameras, before the first is rendered, if the file or the depth format cannot hold their
/// maps, if they have a lens and the plan adds to or verifies the maps, or if a map and the memory
/// for writing it exceed available memory or --max-memory.
/// `output` is their name for messages. Fails with OutputError, InputError and UsageError.
/// `in_bands`: only a few rows of a map are in memory at a time.
void check_cameras(const std::vector<Camera>& cameras, const MapPlan& plan,
                   const std::string& output, bool in_bands = false);
/// The same for deep maps, whose size is known when they are there.
void check_cameras(const std::vector<Camera>& cameras, const DeepMapPlan& plan,
                   const std::string& output);

/// Divides the allowed memory that the map leaves free: a quarter for tiles, an eighth for the
/// triangles that channel A needs, a sixteenth for triangles that are read at a time.
StreamLimits stream_limits(const Camera& camera, const RenderOptions& options);

/// Limits TBB's threads during its lifetime (0: no limit). Also lets TBB use more threads than
/// processors, which it would otherwise refuse with a warning on standard error.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;
  ~ThreadLimit();

 private:
  struct Control;
  std::unique_ptr<Control> control_;
};

}  // namespace fathom::app
