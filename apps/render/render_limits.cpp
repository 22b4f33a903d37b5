#include "apps/render/render_limits.h"

#include <fmt/core.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <exception>

#include "apps/options/map_arguments.h"
#include "apps/render/map_additions.h"
#include "apps/shell/max_memory.h"

namespace fathom::app {
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
