#include "apps/render/render_plan.h"

#include <fmt/core.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <exception>

#include "apps/options/depth_format_options.h"
#include "apps/options/map_arguments.h"
#include "apps/render/map_additions.h"
#include "apps/shell/failures.h"
#include "apps/shell/max_memory.h"
#include "fathom/depth_buffer/depth_buffer.h"
#include "fathom/failures/errors.h"
#include "fathom/image/deep_map.h"
#include "fathom/image/png_files.h"
#include "fathom/rendering/segment_channels.h"

namespace fathom::app {
namespace {

bool contains(const std::vector<Channel>& channels, Channel channel) {
  return std::find(channels.begin(), channels.end(), channel) != channels.end();
}

/// The requested channels, or depth and coverage; only depth if the format cannot hold coverage.
std::vector<Channel> channels_of(const RenderArguments& a, MapFormat format) {
  if (a.channels) return *a.channels;
  if (keeps_all_channels(format)) return {Channel::Z, Channel::A};
  return {Channel::Z};
}

RenderOptions rendering_of(const RenderArguments& a) {
  RenderOptions options;
  options.engine = a.engine == EngineName::reference ? Engine::reference : Engine::fast;
  options.cull = a.cull;
  options.normals = a.pipeline.normals();
  options.threads = a.scene.threads;
  return options;
}

/// Refuses options that a streamed scene does not support.
void check_stream(const RenderArguments& a, const std::vector<Channel>& channels) {
  if (!a.stream) return;
  if (a.engine != EngineName::fast) {
    throw UsageError("--stream is for the fast engine, not for reference");
  }
  if (contains(channels, Channel::Ns)) {
    throw UsageError("--stream does not keep the normals that channel Ns needs: leave out Ns");
  }
  if (!a.mattes().empty()) throw UsageError("--cryptomatte is not for --stream");
}

/// Refuses options that need more channels than the file format holds.
void check_single_channel(const RenderArguments& a, MapFormat format,
                          const std::vector<Channel>& channels) {
  if (format == MapFormat::exr) return;
  if (!a.mattes().empty()) throw UsageError("--cryptomatte is for .exr, not for " + a.output);
  if (holds_all_channels(format)) return;
  if (format == MapFormat::colmap && channels != std::vector{Channel::Z} &&
      channels != std::vector{Channel::Nc}) {
    throw UsageError(fmt::format("{}: a COLMAP map holds Z or Nc, not '{}'; {} hold all", a.output,
                                 text_of(channels), suffixes_of_complete_maps()));
  }
  if (a.samples || a.depth_buffer.storage) {
    throw UsageError(fmt::format("{} holds one channel; {} needs an {}", a.output,
                                 a.samples ? "--samples" : "--depth-format",
                                 suffixes_of_complete_maps(" or ")));
  }
  // The parts of one are an array of pixels with several.
  if (holds_parts(format) && channels.size() == 1) return;
  if (format == MapFormat::png && contents_of(channels, a.is_mask).are_normals()) return;
  if (count_parts(channels) != 1) {
    throw UsageError(fmt::format("{} holds one channel, not '{}'; {} hold them all", a.output,
                                 text_of(channels), suffixes_of_complete_maps()));
  }
  const bool has_codes = description_of(channels.front()).type != ChannelType::binary32;
  if (format == MapFormat::png && !has_codes) {
    throw UsageError(
        fmt::format("{}: a PNG holds depths, normals or numbers, not {}; there is .exr", a.output,
                    text_of(channels)));
  }
}

std::optional<DepthBufferPlan> depth_buffer_of(const DepthBufferArguments& a,
                                               const std::vector<Channel>& channels) {
  if (!a.storage) {
    if (!a.mapping && !a.c && !a.against_exact) return std::nullopt;
    throw UsageError("--mapping, --c and --against-exact belong to --depth-format");
  }
  DepthBufferPlan plan;
  plan.storage = *a.storage;
  plan.mapping = a.mapping.value_or(plan.mapping);
  require_constant_of(plan.mapping, a.c);
  plan.c = a.c.value_or(plan.c);
  plan.against_exact = a.against_exact;
  plan.drops_id = !contains(channels, Channel::id);
  return plan;
}

/// Refuses options that a deep map does not support.
void check_deep(const RenderArguments& a) {
  if (a.storage.format_of(a.output) != MapFormat::exr) {
    throw UsageError("--deep is for .exr, not for " + a.output);
  }
  if (a.stream) throw UsageError("--deep is not for --stream");
  const bool is_named = !a.outputs.empty() && a.outputs.front().contents;
  const char* other = is_named                           ? "NAME="
                      : a.channels                       ? "--channels"
                      : a.storage.background             ? "--background"
                      : !a.storage.channel_names.empty() ? "--channel-name"
                      : !a.mattes().empty()              ? "--cryptomatte"
                      : a.samples                        ? "--samples"
                      : a.depth_buffer.storage           ? "--depth-format"
                                                         : nullptr;
  if (other != nullptr) {
    throw UsageError(fmt::format(
        "--deep always has the channels A, Z, ZBack, area and id: {} needs another map", other));
  }
  if (a.verified_pixels || !a.statistics.empty()) {
    throw UsageError("--verify and --stats are not for --deep");
  }
}

/// The plan of arguments with a single output.
MapPlan plan_of_output(const RenderArguments& a) {
  MapPlan plan;
  plan.format = a.storage.format_of(a.output);
  std::vector<Channel> channels = channels_of(a, plan.format);
  check_stream(a, channels);
  check_single_channel(a, plan.format, channels);
  a.storage.check_pictures(a.output, plan.format, contents_of(channels, a.is_mask));
  plan.depth_buffer = depth_buffer_of(a.depth_buffer, channels);
  if (plan.depth_buffer && plan.depth_buffer->drops_id) channels.push_back(Channel::id);

  plan.writing = a.storage.write_options(a.scene.threads);
  plan.storage = a.storage;
  plan.rendering = rendering_of(a);
  plan.rendering.channels = channels;
  plan.channels_by_default = !a.channels;
  plan.rendering.depth_encoding = a.storage.encoding_for(plan.format);
  plan.is_mask = a.is_mask;
  plan.object = a.object;
  plan.mattes = a.mattes();
  plan.samples = a.samples;
  plan.verified_pixels = a.verified_pixels;
  return plan;
}

/// Refuses options that belong to one map, or that none of several outputs has.
void check_several(const RenderArguments& a, const std::vector<std::string>& patterns) {
  const char* const single = !a.mattes().empty()      ? "--cryptomatte"
                             : a.samples              ? "--samples"
                             : a.depth_buffer.storage ? "--depth-format"
                                                      : nullptr;
  if (single != nullptr) throw UsageError(std::string(single) + " is for a single -o");
  std::vector<StorageOptions> fitted;
  for (std::size_t number = 0; number < patterns.size(); ++number) {
    fitted.push_back(a.storage_of(number));
  }
  a.storage.require_effect(patterns, fitted);
}

bool has_depths(const MapPlan& plan) {
  return std::ranges::any_of(plan.rendering.channels, [](Channel channel) {
    return description_of(channel).type == ChannelType::encoded;
  });
}

/// Whether one rendering has the depths of both.
bool fit_together(const MapPlan& a, const MapPlan& b) {
  const DepthEncoding &x = a.rendering.depth_encoding, &y = b.rendering.depth_encoding;
  return !has_depths(a) || !has_depths(b) ||
         (x.type == y.type && x.scale == y.scale && x.beyond_is_none == y.beyond_is_none);
}

/// Adds those of `more` that are not there yet.
void add_missing(std::vector<Channel>& channels, const std::vector<Channel>& more) {
  for (const Channel channel : more) {
    if (!contains(channels, channel)) channels.push_back(channel);
  }
}

/// Adds an output to the first pass that it fits, or to a new one.
void add_to_passes(std::vector<RenderPass>& passes, OutputPlan output) {
  const auto pass = std::ranges::find_if(
      passes, [&](const RenderPass& each) { return fit_together(each.plan, output.plan); });
  if (pass == passes.end()) {
    passes.push_back({output.plan, {std::move(output)}});
    return;
  }
  RenderOptions& whole = pass->plan.rendering;
  if (!has_depths(pass->plan)) whole.depth_encoding = output.plan.rendering.depth_encoding;
  add_missing(whole.channels, output.plan.rendering.channels);
  pass->outputs.push_back(std::move(output));
}

}  // namespace

DepthFormat format_for(const DepthBufferPlan& plan, const Camera& camera) {
  return depth_format_of(camera, plan.mapping, plan.storage, plan.c);
}

RenderOptions MapPlan::rendering_for(const Camera& camera) const {
  RenderOptions options = rendering;
  if (!channels_by_default || !bends_rays(camera.projection)) return options;
  std::erase(options.channels, Channel::A);
  if (keeps_all_channels(format) && counts_distance(camera.projection))
    options.channels.push_back(Channel::distance);
  return options;
}

RenderOptions RenderPass::rendering_for(const Camera& camera) const {
  RenderOptions options = plan.rendering;
  options.channels.clear();
  for (const OutputPlan& output : outputs) {
    add_missing(options.channels, output.plan.rendering_for(camera).channels);
  }
  return options;
}

bool MapPlan::needs_normals() const {
  return rendering.normals == NormalSource::file && contains(rendering.channels, Channel::Ns);
}

bool MapPlan::needs_segments() const {
  const auto is_segmentation = [](const MatteKind& by) { return by.has_value(); };
  return !segmentations_of(rendering.channels).empty() ||
         std::ranges::any_of(mattes, is_segmentation);
}

MapPlan plan_maps(const RenderArguments& arguments) {
  arguments.refuse_pipeline_options();
  arguments.require_outputs_of_channels();
  return plan_of_output(arguments.of_output(0));
}

std::vector<RenderPass> plan_passes(const RenderArguments& arguments) {
  arguments.refuse_pipeline_options();
  arguments.require_outputs_of_channels();
  const std::vector<std::string> patterns = arguments.patterns();
  if (patterns.size() > 1) check_several(arguments, patterns);
  std::vector<RenderPass> passes;
  for (std::size_t number = 0; number < patterns.size(); ++number) {
    add_to_passes(passes, {number, plan_of_output(arguments.of_output(number))});
  }
  return passes;
}

std::vector<std::byte> encode_planned(const DepthMap& map, const MapPlan& plan,
                                      const std::string& name) {
  if (plan.is_mask) return encode_mask(map, name, plan.object);
  return encode_map(map, name, plan.format, plan.writing);
}

DeepMapPlan plan_deep_maps(const RenderArguments& a) {
  a.refuse_pipeline_options();
  check_deep(a);
  (void)depth_buffer_of(a.depth_buffer, {});
  DeepMapPlan plan;
  plan.compression = a.storage.compression.value_or(plan.compression);
  about_option("--compression", [&] { check_deep_compression(plan.compression); });
  plan.rendering = rendering_of(a);
  plan.rendering.channels = {Channel::Z, Channel::A};
  return plan;
}

namespace {

/// Bytes that the channels of a map take.
double size_of_map(const Camera& camera, const RenderOptions& options,
                   std::size_t more_channels = 0) {
  const auto channels = static_cast<double>(count_parts(options.channels) + more_channels);
  const double bytes_per_value =
      options.depth_encoding.type == DepthEncoding::Type::binary64 ? 8 : 4;
  return 1.0 * camera.width * camera.height * channels * bytes_per_value;
}

void require_room(const Camera& camera, double bytes) {
  require_memory(fmt::format("an image of {}x{} pixels", camera.width, camera.height), bytes,
                 memory_allowance());
}

void check_size(const Camera& camera, const MapPlan& plan) {
  const std::size_t more =
      (plan.depth_buffer ? plan.depth_buffer->most_channels() : 0) + (plan.samples ? 1 : 0);
  const double map = size_of_map(camera, plan.rendering, more);
  require_room(camera,
               map + memory_to_encode(plan.format, plan.writing.compression, camera.height, map));
}

/// Lenses bend the edges of triangles, and what is added to a map is computed on straight edges.
void check_lens(const Camera& camera, const MapPlan& plan) {
  if (adds_channels(plan)) require_straight(camera);
}

}  // namespace

void check_cameras(const std::vector<Camera>& cameras, const MapPlan& plan,
                   const std::string& output, bool in_bands) {
  const Camera* before = nullptr;
  for (const Camera& camera : cameras) {
    check_lens(camera, plan);
    require_size(plan.format, camera.width, camera.height, output);
    if (plan.format == MapFormat::tiff) require_place_in_world(camera, output);
    // Querying free memory is slower than reading a camera: skip it if the size is unchanged.
    const bool is_known =
        before != nullptr && before->width == camera.width && before->height == camera.height;
    if (!in_bands && !is_known) check_size(camera, plan);
    if (plan.depth_buffer) (void)format_for(*plan.depth_buffer, camera);
    before = &camera;
  }
}

void check_cameras(const std::vector<Camera>& cameras, const DeepMapPlan& plan,
                   const std::string& output) {
  for (const Camera& camera : cameras) {
    require_size(MapFormat::exr, camera.width, camera.height, output);
    require_room(camera, size_of_map(camera, plan.rendering));
  }
}

StreamLimits stream_limits(const Camera& camera, const RenderOptions& options) {
  const auto memory = static_cast<double>(memory_allowance().bytes);
  const double left = std::max(memory - size_of_map(camera, options), 0x1p28);
  StreamLimits limits;
  limits.tile_bytes = static_cast<std::uint64_t>(left / 4);
  limits.kept_bytes = static_cast<std::uint64_t>(left / 8);
  limits.triangles_at_once = static_cast<std::uint32_t>(
      std::min<double>(limits.triangles_at_once, left / 16 / StreamLimits::bytes_per_triangle));
  return limits;
}

struct ThreadLimit::Control {
  tbb::global_control control;
};

ThreadLimit::ThreadLimit(int threads) {
  if (threads == 0) return;
  control_.reset(new Control{
      {tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)}});
}

ThreadLimit::~ThreadLimit() {
  // A failure ends the program, and where TBB had no memory to set itself up, lifting the limit
  // would wait for ever.
  if (std::uncaught_exceptions() > 0) (void)control_.release();
}

}  // namespace fathom::app
